// CPU targets by name.
#include "equipoise/simulation/kernels/cpu_target.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/error.hpp"

namespace equipoise {

void require_cpu_target(const std::string& name, const std::string& where, const std::string& key) {
  const std::string before = cpu_target();
  if (use_cpu_target(name)) return;
  use_cpu_target(before);
  throw InputError(where, key, display_text(name),
                   fmt::format("must be one of those this program is built for and this machine has: {}",
                               fmt::join(cpu_targets(), ", ")));
}

ChosenCpuTarget::ChosenCpuTarget(const std::string& name) {
  const std::string before = cpu_target();
  if (name.empty() || name == before) return;
  require_cpu_target(name, "options", "cpu_target");
  before_ = before;
}

ChosenCpuTarget::~ChosenCpuTarget() {
  if (!before_.empty()) use_cpu_target(before_);
}

}  // namespace equipoise

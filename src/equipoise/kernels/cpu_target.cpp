// A CPU target for one call.
#include "equipoise/kernels/cpu_target.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/base/error.hpp"

namespace equipoise {

ChosenCpuTarget::ChosenCpuTarget(const std::string& name) {
  if (name.empty()) return;
  const std::string before = cpu_target();
  if (name == before) return;
  if (!use_cpu_target(name)) {
    use_cpu_target(before);
    throw InputError("options", "cpu_target", name,
                     fmt::format("must be one of those this machine has: {}", fmt::join(cpu_targets(), ", ")));
  }
  before_ = before;
}

ChosenCpuTarget::~ChosenCpuTarget() {
  if (!before_.empty()) use_cpu_target(before_);
}

}  // namespace equipoise

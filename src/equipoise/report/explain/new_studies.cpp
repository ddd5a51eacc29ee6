// Studies to begin with: files that the library carries inside itself.
#include "equipoise/report/explain/new_studies.hpp"

#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/embedded.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/nearest_name.hpp"

namespace equipoise::embedded {
extern const Archive new_studies;
}

namespace equipoise {

std::vector<std::string> new_machines() {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < embedded::new_studies.count; ++i) names.emplace_back(embedded::new_studies.files[i].name);
  return names;
}

std::string new_study(const std::string& machine, const std::string& argument) {
  const std::string_view text = embedded::new_studies.find(machine);
  const std::vector<std::string> names = new_machines();
  if (text.empty())
    throw InputError(argument, "", display_text(machine),
                     fmt::format("{}must be one of: {}", did_you_mean(machine, names), fmt::join(names, ", ")));
  return std::string(text);
}

}  // namespace equipoise

// What the study states, and what explain() finds.
#include "equipoise/report/html/given_machine.hpp"

#include <utility>

#include "equipoise/report/explain/explain.hpp"
#include "equipoise/report/html/given_keys.hpp"

namespace equipoise {

GivenMachine given_machine(const std::string& toml_text, const std::string& name,
                           const std::vector<std::string>& overrides, const StopFlag* stop) {
  const Study study = parse_study(toml_text, name, overrides);
  check_pages(study);
  StudyCheck checked = check_study(toml_text, name, overrides, stop);
  // A page's starts draw them.
  std::erase_if(checked.assumed, [](const std::string& text) { return text.starts_with(medians_assumed); });
  return {given_tables(toml_text, name, overrides), explain(study, stop), std::move(checked.assumed),
          std::move(checked.most)};
}

GivenMachine given_machine(const Study& study) {
  check_pages(study);
  return {given_tables(study), explain(study), {}, {}};
}

}  // namespace equipoise

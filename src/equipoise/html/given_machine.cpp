// What the study states, and what explain() finds.
#include "equipoise/html/given_machine.hpp"

#include "equipoise/explain/explain.hpp"
#include "equipoise/html/given_keys.hpp"
#include "equipoise/study/ball_details.hpp"

namespace equipoise {

GivenMachine given_machine(const std::string& toml_text, const std::string& name,
                           const std::vector<std::string>& overrides) {
  return {given_tables(toml_text, name, overrides),
          explain(parse_study(toml_text, name, overrides), parse_ball_details(toml_text, name, overrides))};
}

GivenMachine given_machine(const Study& study) { return {given_tables(study), explain(study)}; }

}  // namespace equipoise

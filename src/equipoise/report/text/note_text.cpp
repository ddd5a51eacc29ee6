// Numbers that follow known words.
#include "equipoise/report/text/note_text.hpp"

#include <regex>

#include <fmt/format.h>

#include "equipoise/core/base/read_number.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/report/words/reports.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise {

std::string note_text(const Study& study, const std::string& note) {
  static const std::regex speed(words::reports::speed_in_note), rates(words::reports::rates_in_note);
  std::string text = note;
  std::smatch m;
  if (std::regex_search(note, m, speed)) {
    const double value = number_in(m[1].str());
    text = m.prefix().str() +
           (study.scales ? fmt::format(words::reports::at_speed_of_machine, rotor_speed_text(study, value))
                         : fmt::format(words::reports::at_speed, value)) +
           m.suffix().str();
  }
  const std::string told = text;
  if (!study.scales || !std::regex_search(told, m, rates)) return text;
  const double scale = study::scale_of(study::Dimension::speed, *study.scales);
  const auto in_unit = [&](const std::string& rate) { return fmt::format("{:.3g}", number_in(rate) * scale); };
  const std::string second = m[3].matched ? fmt::format(words::reports::second_rate, in_unit(m[3].str())) : "";
  return m.prefix().str() + fmt::format(words::reports::rates_of_machine, m[1].str(), in_unit(m[2].str()), second) +
         m.suffix().str();
}

}  // namespace equipoise

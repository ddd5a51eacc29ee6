// Numbers that follow known words.
#include "equipoise/report/text/note_text.hpp"

#include <regex>

#include <fmt/format.h>

#include "equipoise/core/base/read_number.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise {

std::string note_text(const Study& study, const std::string& note) {
  static const std::regex speed("at speed (-?[0-9][0-9.e+-]*)"),
      rates("\\(growth (rates?) (-?[0-9][0-9.e+-]*)(?: to (-?[0-9][0-9.e+-]*))?\\)");
  std::string text = note;
  std::smatch m;
  if (std::regex_search(note, m, speed)) {
    const double value = number_in(m[1].str());
    text =
        m.prefix().str() +
        (study.scales ? fmt::format("at {}", rotor_speed_text(study, value)) : fmt::format("at speed {:.4g}", value)) +
        m.suffix().str();
  }
  const std::string told = text;
  if (!study.scales || !std::regex_search(told, m, rates)) return text;
  const double scale = study::scale_of(study::Dimension::speed, *study.scales);
  const auto in_unit = [&](const std::string& rate) { return fmt::format("{:.3g}", number_in(rate) * scale); };
  const std::string second = m[3].matched ? fmt::format(" to {}", in_unit(m[3].str())) : "";
  return m.prefix().str() + fmt::format("(growth {} {}{} 1/s)", m[1].str(), in_unit(m[2].str()), second) +
         m.suffix().str();
}

}  // namespace equipoise

// balancer.oil: a grade, and the temperature that it has in the machine.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "equipoise/core/base/nearest_name.hpp"
#include "equipoise/machine/datasheet/oils.hpp"
#include "equipoise/study/reading/machine_sheet.hpp"
#include "equipoise/study/words/machine.hpp"

namespace equipoise::study {

namespace {

constexpr double square_mm = 1e-6;  // mm^2/s in m^2/s

// Without blanks, and in small letters: "ISO VG32", "vg 32".
std::string plain_name(std::string text) {
  std::erase(text, ' ');
  return in_small_letters(text);
}

class OilReader {
 public:
  OilReader(const Study& machine, const Refuse& refuse)
      : machine_(machine), grade_(machine.sheet.oil_grade), kelvin_(machine.sheet.oil_at), refuse_(refuse) {}

  Oil read() const {
    constexpr std::string_view silicone = "silicone";
    return in_small_letters(grade_).starts_with(silicone) && grade_.size() > silicone.size()
               ? silicone_oil(grade_.substr(silicone.size()))
               : mineral_oil();
  }

 private:
  void fail(const std::string& key, const std::string& problem) const { refuse_("balancer.oil." + key, problem); }

  void check_temperature(double coldest, double hottest, const char* of) const {
    if (!(kelvin_ >= coldest && kelvin_ <= hottest))
      fail("at", fmt::format(words::machine::oil_temperature, coldest - model::celsius_zero,
                             hottest - model::celsius_zero, of));
  }

  Oil silicone_oil(const std::string& viscosity) const {
    check_temperature(model::coldest_silicone, model::hottest_silicone, "silicone oils");
    const Measured measured = measure(viscosity, {Dimension::kinematic_viscosity});
    const double at_25 = measured.value / square_mm;
    // Conversions round.
    if (!measured.problem.empty() || at_25 < model::thinnest_silicone * (1.0 - 1e-12) ||
        at_25 > model::thickest_silicone * (1.0 + 1e-12))
      fail("grade", fmt::format(words::machine::silicone_grade, model::thinnest_silicone, model::thickest_silicone));
    if (machine_.states("balancer.oil.viscosity_100"))
      fail("viscosity_100", words::machine::viscosity_of_silicone_is_known);
    return {model::silicone_viscosity(at_25, kelvin_) * square_mm, model::silicone_density};
  }

  // The viscosity in mm^2/s at 40 degC of a class named by the whole number nearest to it.
  double class_viscosity() const {
    const std::string given = plain_name(grade_);
    const std::string number = grade_.substr(std::min(grade_.find_last_not_of("0123456789.") + 1, grade_.size()));
    // A number of another system, such as SAE 10W-30, names no class.
    const bool of_iso = given.starts_with("iso") || given.starts_with("vg") || number == grade_;
    const double said = of_iso ? split_quantity(number).number : 0.0;
    double nearest = 0.0;
    for (const double middle : model::iso_viscosity_grades) {
      const std::string name = fmt::format("ISO VG {:.0f}", middle);
      if (given == plain_name(name) || "iso" + given == plain_name(name)) return middle;
      if (said > 0.0 && (nearest == 0.0 || std::abs(std::log(middle / said)) < std::abs(std::log(nearest / said))))
        nearest = middle;
    }
    fail("grade", fmt::format(words::machine::unknown_oil,
                              nearest == 0.0 ? "" : fmt::format(words::machine::did_you_mean_grade, nearest)));
    return 0.0;
  }

  Oil mineral_oil() const {
    const double at_40 = class_viscosity();
    check_temperature(model::coldest_mineral_oil, model::hottest_mineral_oil, "Ubbelohde and Walther");
    const std::optional<double> at_100 = machine_.states("balancer.oil.viscosity_100")
                                             ? machine_.sheet.oil_viscosity_100 / square_mm
                                             : model::viscosity_at_100(at_40, model::usual_viscosity_index);
    if (!at_100) fail("grade", words::machine::too_thin_for_index);
    if (!(*at_100 < at_40) || !(*at_100 > 0.5))
      fail("viscosity_100", fmt::format(words::machine::viscosity_at_100, at_40));
    return {model::mineral_oil_viscosity(at_40, *at_100, kelvin_) * square_mm, model::mineral_oil_density};
  }

  const Study& machine_;
  const std::string& grade_;
  const double kelvin_;
  const Refuse& refuse_;
};

}  // namespace

Oil oil_of(const Study& machine, const Refuse& refuse) { return OilReader(machine, refuse).read(); }

}  // namespace equipoise::study

// [balancer] in SI units: race, balls, drag, rolling and contact.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/nearest_name.hpp"
#include "equipoise/core/base/typed_numbers.hpp"
#include "equipoise/machine/datasheet/ball_drag.hpp"
#include "equipoise/machine/datasheet/materials.hpp"
#include "equipoise/machine/datasheet/oils.hpp"
#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/study/reading/machine_sheet.hpp"
#include "equipoise/study/reading/quantity_reader.hpp"
#include "equipoise/study/words/machine.hpp"

namespace equipoise::study {

namespace {

struct OilSheet {
  double kinematic_viscosity = 0.0, density = 0.0, kelvin = 0.0;  // m^2/s, kg/m^3, K
};

// balancer.oil: a grade, and the temperature that it has in the machine.
class OilReader : public QuantityReader {
 public:
  explicit OilReader(const StudyFile& file) : QuantityReader(file, "balancer.oil") {}

  OilSheet read() {
    const std::string wanted = words::machine::oil_grade;
    require("grade", wanted);
    grade_ = text("grade").value_or("");
    kelvin_ = quantity("at");
    constexpr std::string_view silicone = "silicone";
    const OilSheet oil = in_small_letters(grade_).starts_with(silicone) && grade_.size() > silicone.size()
                             ? silicone_oil(grade_.substr(silicone.size()))
                             : mineral_oil();
    finish();
    return oil;
  }

 private:
  static constexpr double square_mm = 1e-6;  // mm^2/s in m^2/s

  void check_temperature(double coldest, double hottest, const char* of) const {
    if (!(kelvin_ >= coldest && kelvin_ <= hottest))
      fail("at", fmt::format(words::machine::oil_temperature, coldest - model::celsius_zero,
                             hottest - model::celsius_zero, of));
  }

  OilSheet silicone_oil(const std::string& viscosity) {
    check_temperature(model::coldest_silicone, model::hottest_silicone, "silicone oils");
    const Measured measured = measure(viscosity, {Dimension::kinematic_viscosity});
    const double at_25 = measured.value / square_mm;
    // Conversions round.
    if (!measured.problem.empty() || at_25 < model::thinnest_silicone * (1.0 - 1e-12) ||
        at_25 > model::thickest_silicone * (1.0 + 1e-12))
      fail("grade", fmt::format(words::machine::silicone_grade, model::thinnest_silicone, model::thickest_silicone));
    if (has("viscosity_100")) fail("viscosity_100", words::machine::viscosity_of_silicone_is_known);
    return {model::silicone_viscosity(at_25, kelvin_) * square_mm, model::silicone_density, kelvin_};
  }

  // Without blanks, and in small letters: "ISO VG32", "vg 32".
  static std::string plain_name(std::string text) {
    std::erase(text, ' ');
    return in_small_letters(text);
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
  }

  OilSheet mineral_oil() {
    const double at_40 = class_viscosity();
    check_temperature(model::coldest_mineral_oil, model::hottest_mineral_oil, "Ubbelohde and Walther");
    std::optional<double> at_100 = optional_quantity("viscosity_100");
    if (at_100)
      *at_100 /= square_mm;
    else
      at_100 = model::viscosity_at_100(at_40, model::usual_viscosity_index);
    if (!at_100) fail("grade", words::machine::too_thin_for_index);
    const bool falls = *at_100<at_40&& * at_100> 0.5;
    if (!falls) fail("viscosity_100", fmt::format(words::machine::viscosity_at_100, at_40));
    return {model::mineral_oil_viscosity(at_40, *at_100, kelvin_) * square_mm, model::mineral_oil_density, kelvin_};
  }

  std::string grade_;
  double kelvin_ = 0.0;
};

class BalancerReader {
 public:
  explicit BalancerReader(const StudyFile& file) : file_(file), reader_(file, "balancer") {}

  BalancerSheet read() {
    b_.balls = static_cast<int>(reader_.integer("balls", 1, model::max_balls));
    const std::string from = reader_.exactly_one(
        {{"race_radius", words::machine::race_radius}, {"race_diameter", words::machine::race_diameter}});
    b_.radius = reader_.quantity(from) * (from == "race_diameter" ? 0.5 : 1.0);
    diameter_ = reader_.one_or_each("ball_diameter", b_.balls, "ball");
    for (const double d : diameter_)
      if (d >= 2.0 * b_.radius) reader_.fail("ball_diameter", words::machine::ball_fills_race);
    read_mass();
    read_drag();
    read_rolls();
    read_contact();
    b_.others = reader_.others(b_.balls);
    reader_.finish();
    b_.details.diameter = diameter_;
    return std::move(b_);
  }

 private:
  void need_diameter(const char* key) {
    if (diameter_.empty()) reader_.fail(key, words::machine::needs_diameter);
  }

  void read_mass() {
    b_.mass_from = reader_.exactly_one({{"mass", words::machine::mass},
                                        {"ball_density", "with balancer.ball_diameter"},
                                        {"ball_material", words::machine::ball_material}});
    if (b_.mass_from == "mass") {
      b_.mass = reader_.one_or_each("mass", b_.balls, "ball");
      return;
    }
    if (b_.mass_from == "ball_density")
      b_.mass = reader_.one_or_each("ball_density", b_.balls, "ball");
    else
      b_.mass.assign(static_cast<std::size_t>(b_.balls), density_of_material());
    need_diameter(b_.mass_from.c_str());
    for (std::size_t i = 0; i < b_.mass.size(); ++i)
      b_.mass[i] *= pi / 6.0 * diameter_[i] * diameter_[i] * diameter_[i];
  }

  double density_of_material() {
    const std::string name = reader_.text("ball_material").value_or("");
    if (const model::BallMaterial* material = model::find_ball_material(name)) return material->density;
    std::vector<std::string> names;
    for (const model::BallMaterial& known : model::ball_materials) names.emplace_back(known.name);
    reader_.fail_among("ball_material", names, words::machine::unknown_material);
  }

  void read_drag() {
    b_.drag_from = reader_.exactly_one({{"drag", words::machine::drag},
                                        {"oil_viscosity", "with balancer.ball_diameter"},
                                        {"oil", words::machine::oil}});
    if (b_.drag_from != "drag") {
      b_.drag_torque = drag_in_oil();
      return;
    }
    Dimension measured{};
    b_.drag_torque = reader_.one_or_each("drag", b_.balls, "ball", Dimension::damping, &measured);
    if (measured == Dimension::damping)
      for (double& d : b_.drag_torque) d *= b_.radius * b_.radius;
    for (const char* key : {"oil_density", "channel_diameter"})
      if (reader_.has(key)) reader_.fail(key, words::machine::only_with_oil);
  }

  void read_oil() {
    const auto density = reader_.optional_quantity("oil_density");
    if (b_.drag_from == "oil") {
      const OilSheet oil = OilReader(file_).read();
      b_.details.oil_density = density.value_or(oil.density);
      b_.details.oil_kelvin = oil.kelvin;
      b_.details.oil_viscosity = oil.kinematic_viscosity * *b_.details.oil_density;
      return;
    }
    Dimension measured{};
    double viscosity = reader_.quantity("oil_viscosity", Dimension::kinematic_viscosity, &measured);
    if (measured == Dimension::kinematic_viscosity) {
      if (!density) reader_.fail("oil_viscosity", words::machine::needs_oil_density);
      viscosity *= *density;
    }
    b_.details.oil_viscosity = viscosity;
    b_.details.oil_density = density;
  }

  std::vector<double> drag_in_oil() {
    read_oil();
    need_diameter(b_.drag_from.c_str());
    const auto channel = reader_.optional_quantity("channel_diameter");
    std::vector<double> drag_torque;
    for (const double d : diameter_) {
      if (channel && !at_most(d, model::widest_ball_in_channel * *channel))
        reader_.fail("channel_diameter",
                     fmt::format(words::machine::channel_too_narrow, 1000.0 * d / model::widest_ball_in_channel,
                                 model::widest_ball_in_channel));
      drag_torque.push_back(model::stokes_drag(*b_.details.oil_viscosity, d) *
                            (channel ? model::wall_correction(d / *channel) : 1.0) * b_.radius * b_.radius);
    }
    return drag_torque;
  }

  // Balls of known size roll, unless the study says otherwise.
  void read_rolls() {
    b_.rolls = reader_.flag("rolls", !diameter_.empty());
    if (!b_.rolls) {
      if (reader_.has("ball_radius")) reader_.fail("ball_radius", words::machine::only_of_balls_that_roll);
      return;
    }
    b_.radius_of_balls = reader_.one_or_each("ball_radius", b_.balls, "ball");
    b_.rolls_from = b_.radius_of_balls.empty() ? "ball_diameter" : "ball_radius";
    if (b_.radius_of_balls.empty()) {
      need_diameter("rolls");
      for (const double d : diameter_) b_.radius_of_balls.push_back(0.5 * d);
    } else if (!diameter_.empty()) {
      reader_.fail("ball_radius", words::machine::radius_or_diameter);
    }
    for (const double r : b_.radius_of_balls)
      if (r >= b_.radius) reader_.fail(b_.rolls_from, words::machine::ball_radius_too_large);
  }

  bool one_diameter() const {
    return std::all_of(diameter_.begin(), diameter_.end(), [&](double d) { return d == diameter_.front(); });
  }

  // Balls of known size touch; different sizes are not supported yet.
  void read_contact() {
    if (reader_.has("contact_angle")) {
      if (reader_.has("contact")) reader_.fail("contact", words::machine::contact_angle_or_contact);
      b_.contact_angle = reader_.optional_quantity("contact_angle");
      b_.contact_from = "contact_angle";
      return;
    }
    const bool given = reader_.has("contact");
    if (!reader_.flag("contact", !diameter_.empty() && one_diameter())) return;
    need_diameter("contact");
    if (!one_diameter()) reader_.fail("contact", words::machine::balls_of_one_diameter);
    if (b_.balls == 1) return;
    const double widest = 2.0 * b_.radius * std::sin(pi / b_.balls);
    if (diameter_.front() >= widest)
      reader_.fail("ball_diameter", fmt::format(words::machine::balls_fill_race, 1000.0 * widest, b_.balls));
    b_.contact_angle = 2.0 * std::asin(0.5 * diameter_.front() / b_.radius);
    b_.contact_from = given ? "contact" : "ball_diameter";
  }

  const StudyFile& file_;
  QuantityReader reader_;
  BalancerSheet b_;
  std::vector<double> diameter_;
};

}  // namespace

BalancerSheet read_balancer_sheet(const StudyFile& file) { return BalancerReader(file).read(); }

}  // namespace equipoise::study

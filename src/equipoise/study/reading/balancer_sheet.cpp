// [balancer]: race, masses, oil and drag, rolling and contact of balls.
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/nearest_name.hpp"
#include "equipoise/core/base/typed_numbers.hpp"
#include "equipoise/machine/datasheet/ball_drag.hpp"
#include "equipoise/machine/datasheet/materials.hpp"
#include "equipoise/machine/datasheet/oils.hpp"
#include "equipoise/study/reading/machine_sheet.hpp"

namespace equipoise::study {

namespace {

constexpr char needs_diameter[] = "needs balancer.ball_diameter, such as \"8 mm\"";

struct Oil {
  double kinematic_viscosity = 0.0, density = 0.0;  // m^2/s, kg/m^3
};

constexpr double square_mm = 1e-6;  // mm^2/s in m^2/s

// Without blanks, and in small letters: "ISO VG32", "vg 32".
std::string plain_name(std::string text) {
  std::erase(text, ' ');
  return in_small_letters(text);
}

// balancer.oil: a grade, and the temperature that it has in the machine.
struct GradedOil : Sheet {
  Oil oil() const {
    constexpr std::string_view silicone = "silicone";
    return in_small_letters(grade).starts_with(silicone) && grade.size() > silicone.size()
               ? silicone_oil(grade.substr(silicone.size()))
               : mineral_oil();
  }

  void fail(const std::string& key, const std::string& problem) const { refuse("balancer.oil." + key, problem); }

  void check_temperature(double coldest, double hottest, const char* of) const {
    if (!(kelvin >= coldest && kelvin <= hottest))
      fail("at",
           fmt::format(
               "must be from {:.6g} to {:.6g} degC: the law of {} holds there; beyond it give balancer.oil_viscosity",
               coldest - model::celsius_zero, hottest - model::celsius_zero, of));
  }

  Oil silicone_oil(const std::string& viscosity) const {
    check_temperature(model::coldest_silicone, model::hottest_silicone, "silicone oils");
    const Measured measured = measure(viscosity, {Dimension::kinematic_viscosity});
    const double at_25 = measured.value / square_mm;
    // Conversions round.
    if (!measured.problem.empty() || at_25 < model::thinnest_silicone * (1.0 - 1e-12) ||
        at_25 > model::thickest_silicone * (1.0 + 1e-12))
      fail("grade", fmt::format("must be \"silicone\" with its viscosity at 25 degC, from {:.0f} to {:.0f} cSt, such "
                                "as \"silicone 1000 cSt\"; for others give balancer.oil_viscosity",
                                model::thinnest_silicone, model::thickest_silicone));
    if (states("balancer.oil.viscosity_100"))
      fail("viscosity_100", "applies to mineral oils only; leave it out for a silicone oil");
    return {model::silicone_viscosity(at_25, kelvin) * square_mm, model::silicone_density};
  }

  // The viscosity in mm^2/s at 40 degC of a class named by the whole number nearest to it.
  double class_viscosity() const {
    const std::string named = plain_name(grade);
    const std::string number = grade.substr(std::min(grade.find_last_not_of("0123456789.") + 1, grade.size()));
    // A number of another system, such as SAE 10W-30, names no class.
    const bool of_iso = named.starts_with("iso") || named.starts_with("vg") || number == grade;
    const double said = of_iso ? split_quantity(number).number : 0.0;
    double nearest = 0.0;
    for (const double middle : model::iso_viscosity_grades) {
      const std::string name = fmt::format("ISO VG {:.0f}", middle);
      if (named == plain_name(name) || "iso" + named == plain_name(name)) return middle;
      if (said > 0.0 && (nearest == 0.0 || std::abs(std::log(middle / said)) < std::abs(std::log(nearest / said))))
        nearest = middle;
    }
    fail("grade", fmt::format("{}must be \"ISO VG\" with a class of ISO 3448 from 2 to 3200, such as \"ISO VG 32\", or "
                              "\"silicone\" with its viscosity at 25 degC, such as \"silicone 1000 cSt\"",
                              nearest == 0.0 ? "" : fmt::format("did you mean \"ISO VG {:.0f}\"? ", nearest)));
    return 0.0;
  }

  Oil mineral_oil() const {
    const double at_40 = class_viscosity();
    check_temperature(model::coldest_mineral_oil, model::hottest_mineral_oil, "Ubbelohde and Walther");
    const std::optional<double> at_100 = states("balancer.oil.viscosity_100")
                                             ? given.oil_viscosity_100 / square_mm
                                             : model::viscosity_at_100(at_40, model::usual_viscosity_index);
    if (!at_100)
      fail("grade", "is thinner than viscosity indices are defined for; give viscosity_100, such as \"1.1 cSt\"");
    if (!(*at_100 < at_40) || !(*at_100 > 0.5))
      fail("viscosity_100",
           fmt::format("must be at least 0.5 cSt and less than the viscosity at 40 degC, {:.6g} cSt", at_40));
    return {model::mineral_oil_viscosity(at_40, *at_100, kelvin) * square_mm, model::mineral_oil_density};
  }

  const std::string& grade = given.oil_grade;
  const double kelvin = *given.oil_at;
};

struct Balls : Sheet {
  void put() {
    const std::vector<double> mass = masses(), drag = drag_torques();
    for (std::size_t i = 0; i < mass.size(); ++i) {
      p.mass[i] = mass[i] / study.scales->mass;
      p.drag[i] = drag[i] / study.scales->ball_drag(mass[i]);
    }
    if (!states("stiction")) p.stiction = p.rolling;
    put_contact();
  }

  bool states(const std::string& key) const { return Sheet::states("balancer." + key); }
  void fail(const std::string& key, const std::string& problem) const { refuse("balancer." + key, problem); }
  void need_diameter(std::string_view key) const {
    if (diameters.empty()) fail(std::string(key), needs_diameter);
  }

  std::vector<double> masses() const {
    const std::string_view from = way("balancer.mass");
    const auto& stated = in_si.mass;
    std::vector<double> mass(stated.begin(), stated.begin() + p.balls);
    if (from == "mass") return mass;
    need_diameter(from);
    if (from == "ball_material") mass.assign(mass.size(), model::find_ball_material(given.material)->density);
    for (std::size_t i = 0; i < mass.size(); ++i) {
      const double d = diameters[i];
      mass[i] *= pi / 6.0 * d * d * d;
    }
    return mass;
  }

  // Torque per rate relative to the race.
  std::vector<double> drag_torques() const {
    const std::string_view from = way("balancer.drag");
    if (from != "drag") return drag_in_oil(from);
    const auto& stated = in_si.drag;
    std::vector<double> drag(stated.begin(), stated.begin() + p.balls);
    if (given.drag_of_force)
      for (double& d : drag) d *= radius * radius;
    for (const char* key : {"oil_density", "channel_diameter"})
      if (states(key)) fail(key, "has a meaning only with balancer.oil_viscosity or balancer.oil");
    return drag;
  }

  void put_oil(std::string_view from) const {
    DataSheet& known = study.sheet;
    if (from == "oil") {
      const Oil oil = GradedOil{*this}.oil();
      known.oil_density = given.oil_density.value_or(oil.density);
      known.oil_viscosity = oil.kinematic_viscosity * *known.oil_density;
      return;
    }
    if (!given.kinematic) return;
    if (!given.oil_density)
      fail("oil_viscosity", "is a kinematic viscosity and needs balancer.oil_density, such as \"900 kg/m3\"");
    known.oil_viscosity = *given.oil_viscosity * *given.oil_density;
  }

  std::vector<double> drag_in_oil(std::string_view from) const {
    put_oil(from);
    need_diameter(from);
    const bool in_channel = states("channel_diameter");
    std::vector<double> drag;
    for (const double d : diameters) {
      if (in_channel && !at_most(d, model::widest_ball_in_channel * given.channel))
        fail("channel_diameter",
             fmt::format("must be at least {:.6g} mm: the wall correction holds for balls up to {} of the channel; "
                         "in a closer fit measure the drag and state balancer.drag",
                         1000.0 * d / model::widest_ball_in_channel, model::widest_ball_in_channel));
      drag.push_back(model::stokes_drag(*study.sheet.oil_viscosity, d) *
                     (in_channel ? model::wall_correction(d / given.channel) : 1.0) * radius * radius);
    }
    return drag;
  }

  // Balls of known size touch; different sizes are not supported yet.
  void put_contact() {
    if (states("contact_angle")) {
      if (states("contact")) fail("contact", "give either balancer.contact_angle or balancer.contact, not both");
      return;
    }
    const bool one_size =
        std::all_of(diameters.begin(), diameters.end(), [&](double d) { return d == diameters.front(); });
    if (!(states("contact") ? given.contact : !diameters.empty() && one_size)) return;
    need_diameter("contact");
    if (!one_size) fail("contact", "needs balls of one diameter");
    if (p.balls == 1) return;
    const double widest = 2.0 * radius * std::sin(pi / p.balls);
    if (diameters.front() >= widest)
      fail("ball_diameter", fmt::format("must be less than {:.6g} mm: at that size {} touching balls fill the race",
                                        1000.0 * widest, p.balls));
    p.contact_angle = 2.0 * std::asin(0.5 * diameters.front() / radius);
  }

  const double radius = study.scales->length;
  const std::span<const double> diameters = machine.ball_diameters();
};

}  // namespace

double put_race(const Sheet& sheet) {
  const Refuse& refuse = sheet.refuse;
  const bool stated = sheet.states("balancer.ball_radius");
  const double race = sheet.given.race * (sheet.way("balancer.race_radius") == "race_diameter" ? 0.5 : 1.0);
  const std::span<const double> diameter = sheet.machine.ball_diameters();
  for (const double d : diameter)
    if (d >= 2.0 * race) refuse("balancer.ball_diameter", "must be less than the diameter of the race");
  if (!sheet.in_si.rolls) return race;
  if (stated && !diameter.empty())
    refuse("balancer.ball_radius", "give either balancer.ball_radius or balancer.ball_diameter, not both");
  if (!stated && diameter.empty()) refuse("balancer.rolls", needs_diameter);
  for (std::size_t i = 0; i < diameter.size(); ++i) sheet.p.ball_radius[i] = 0.5 * diameter[i];
  for (const double radius : sheet.p.ball_radius)
    if (radius >= race) refuse("balancer.ball_radius", "must be less than the radius of the race");
  return race;
}

void put_balls(const Sheet& sheet) {
  if (sheet.in_si.balls > 0) Balls{sheet}.put();
}

}  // namespace equipoise::study

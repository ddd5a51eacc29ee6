// [balancer]: race, masses, drag, rolling and contact of balls.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/typed_numbers.hpp"
#include "equipoise/machine/datasheet/ball_drag.hpp"
#include "equipoise/machine/datasheet/materials.hpp"
#include "equipoise/study/reading/machine_sheet.hpp"
#include "equipoise/study/reading/ways.hpp"
#include "equipoise/study/words/machine.hpp"

namespace equipoise::study {

namespace {

class Balls {
 public:
  Balls(const Study& machine, Study& study, const Refuse& refuse)
      : machine_(machine),
        d_(machine.sheet),
        radius_(study.scales->length),
        study_(study),
        p_(study.parameters),
        details_(study.ball_details),
        refuse_(refuse) {}

  void put() {
    const std::vector<double> mass = masses(), drag = drag_torques();
    for (std::size_t i = 0; i < mass.size(); ++i) {
      p_.mass[i] = mass[i] / study_.scales->mass;
      p_.drag[i] = drag[i] / study_.scales->ball_drag(mass[i]);
    }
    if (!states("stiction")) p_.stiction = p_.rolling;
    put_contact();
  }

 private:
  bool states(const std::string& key) const { return machine_.states("balancer." + key); }
  void refuse(const std::string& key, const std::string& problem) const { refuse_("balancer." + key, problem); }
  void need_diameter(std::string_view key) const {
    if (details_.diameter.empty()) refuse(std::string(key), words::machine::needs_diameter);
  }

  std::vector<double> masses() const {
    const std::string_view from = way_of(machine_, "balancer.mass", refuse_);
    std::vector<double> mass(d_.mass_of_balls.begin(), d_.mass_of_balls.begin() + p_.balls);
    if (from == "mass") return mass;
    need_diameter(from);
    if (from == "ball_material") mass.assign(mass.size(), model::find_ball_material(d_.material)->density);
    for (std::size_t i = 0; i < mass.size(); ++i) {
      const double d = details_.diameter[i];
      mass[i] *= pi / 6.0 * d * d * d;
    }
    return mass;
  }

  // Torque per rate relative to the race.
  std::vector<double> drag_torques() const {
    const std::string_view from = way_of(machine_, "balancer.drag", refuse_);
    if (from != "drag") return drag_in_oil(from);
    std::vector<double> drag(d_.drag.begin(), d_.drag.begin() + p_.balls);
    if (d_.drag_of_force)
      for (double& d : drag) d *= radius_ * radius_;
    for (const char* key : {"oil_density", "channel_diameter"})
      if (states(key)) refuse(key, words::machine::only_with_oil);
    return drag;
  }

  void put_oil(std::string_view from) const {
    if (states("oil_density")) details_.oil_density = d_.oil_density;
    if (from == "oil") {
      const Oil oil = oil_of(machine_, refuse_);
      details_.oil_density = details_.oil_density.value_or(oil.density);
      details_.oil_kelvin = d_.oil_at;
      details_.oil_viscosity = oil.kinematic_viscosity * *details_.oil_density;
      return;
    }
    if (d_.kinematic && !details_.oil_density) refuse("oil_viscosity", words::machine::needs_oil_density);
    details_.oil_viscosity = d_.kinematic ? d_.oil_viscosity * *details_.oil_density : d_.oil_viscosity;
  }

  std::vector<double> drag_in_oil(std::string_view from) const {
    put_oil(from);
    need_diameter(from);
    const bool in_channel = states("channel_diameter");
    std::vector<double> drag;
    for (const double d : details_.diameter) {
      if (in_channel && !at_most(d, model::widest_ball_in_channel * d_.channel))
        refuse("channel_diameter",
               fmt::format(words::machine::channel_too_narrow, 1000.0 * d / model::widest_ball_in_channel,
                           model::widest_ball_in_channel));
      drag.push_back(model::stokes_drag(*details_.oil_viscosity, d) *
                     (in_channel ? model::wall_correction(d / d_.channel) : 1.0) * radius_ * radius_);
    }
    return drag;
  }

  // Balls of known size touch; different sizes are not supported yet.
  void put_contact() {
    if (states("contact_angle")) {
      if (states("contact")) refuse("contact", words::machine::contact_angle_or_contact);
      return;
    }
    const std::vector<double>& diameter = details_.diameter;
    const bool one_size =
        std::all_of(diameter.begin(), diameter.end(), [&](double d) { return d == diameter.front(); });
    if (!(states("contact") ? d_.contact : !diameter.empty() && one_size)) return;
    need_diameter("contact");
    if (!one_size) refuse("contact", words::machine::balls_of_one_diameter);
    if (p_.balls == 1) return;
    const double widest = 2.0 * radius_ * std::sin(pi / p_.balls);
    if (diameter.front() >= widest)
      refuse("ball_diameter", fmt::format(words::machine::balls_fill_race, 1000.0 * widest, p_.balls));
    p_.contact_angle = 2.0 * std::asin(0.5 * diameter.front() / radius_);
  }

  const Study& machine_;
  const DataSheet& d_;
  const double radius_;
  Study& study_;
  model::Parameters& p_;
  BallDetails& details_;
  const Refuse& refuse_;
};

}  // namespace

double put_race(const Study& machine, Study& study, const Refuse& refuse) {
  const bool stated = machine.states("balancer.ball_radius");
  const double race =
      machine.sheet.race * (way_of(machine, "balancer.race_radius", refuse) == "race_diameter" ? 0.5 : 1.0);
  std::vector<double>& diameter = study.ball_details.diameter;
  if (machine.states("balancer.ball_diameter"))
    diameter.assign(machine.sheet.diameter.begin(), machine.sheet.diameter.begin() + machine.parameters.balls);
  for (const double d : diameter)
    if (d >= 2.0 * race) refuse("balancer.ball_diameter", words::machine::ball_fills_race);
  if (!machine.parameters.rolls) return race;
  if (stated && !diameter.empty()) refuse("balancer.ball_radius", words::machine::radius_or_diameter);
  if (!stated && diameter.empty()) refuse("balancer.rolls", words::machine::needs_diameter);
  for (std::size_t i = 0; i < diameter.size(); ++i) study.parameters.ball_radius[i] = 0.5 * diameter[i];
  for (const double radius : study.parameters.ball_radius)
    if (radius >= race) refuse("balancer.ball_radius", words::machine::ball_radius_too_large);
  return race;
}

void put_balls(const Study& machine, Study& study, const Refuse& refuse) {
  if (machine.parameters.balls > 0) Balls(machine, study, refuse).put();
}

}  // namespace equipoise::study

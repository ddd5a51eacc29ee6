// [rotor] and [[place]]: supports, unbalance and inertia, each in the one way in which a study states it.
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/datasheet/vibration_data.hpp"
#include "equipoise/study/contents/keys.hpp"
#include "equipoise/study/reading/machine_sheet.hpp"

namespace equipoise::study {

namespace {

// What is smaller than this, relative to what it is a sum of, is rounding.
constexpr double nothing = 1e-12;

using Supports = std::array<model::SupportMatrix, 2>;  // in X and Y

Supports sum_of(const std::vector<model::Bearing>& bearings, std::array<double, 2> model::Bearing::*member) {
  Supports sums;
  for (const model::Bearing& bearing : bearings)
    for (const std::size_t d : {0, 1}) sums[d].add((bearing.*member)[d], bearing.at);
  return sums;
}

using Complex = std::complex<double>;

// Mass times radius at an angle, added over the shaft; and its moment about the centre of mass.
struct Unbalance {
  Complex force, couple;                       // kg m, kg m^2
  double all_forces = 0.0, all_couples = 0.0;  // their sizes added

  void add(Complex one, double at) {
    force += one;
    couple += at * one;
    all_forces += std::abs(one);
    all_couples += std::abs(at * one);
  }
};

// From the axes of the machine to those of the model, whose x points along the unbalance.
void turn_back(std::array<double, 2>& offset, double turn) {
  if (turn == 0.0) return;
  const Complex turned = Complex(offset[0], offset[1]) * std::polar(1.0, -turn);
  offset = {turned.real(), turned.imag()};
}

struct Rotor : Sheet {
  void put() {
    put_damping();
    if (machine.parameters.tilts()) put_supports();
    put_unbalance();
    put_inertia();
    if (!states("balancer.race_offset")) return;
    p.race_offset = in_si.race_offset;
    turn_back(p.race_offset, study.direction_of_x);
    for (double& v : p.race_offset) v /= scales.length;
  }

  void put_damping() {
    if (!given.bearings.empty()) {
      const Supports dampers = sum_of(given.bearings, &model::Bearing::damping);
      p.damping = {dampers[0].centre / scales.damping(), dampers[1].centre / scales.damping()};
      return;
    }
    const std::string_view from = way("rotor.damping");
    for (const std::size_t i : {0, 1}) {
      double zeta = in_si.damping[i];
      if (from == "logarithmic_decrement") zeta = model::ratio_of_decrement(zeta);
      if (from == "quality_factor") zeta = model::ratio_of_quality(zeta);
      if (from == "loss_factor") zeta = model::ratio_of_loss(zeta);
      p.damping[i] = from == "damping" ? zeta / scales.damping() : 2.0 * zeta * std::sqrt(p.stiffness[i]);
    }
  }

  // Of a tilting rotor: {k12, k22} and {c12, c22} of the supports, and of the bearings what does not follow from
  // them.
  void put_supports() {
    const Supports springs = sum_of(given.bearings, &model::Bearing::stiffness),
                   dampers = sum_of(given.bearings, &model::Bearing::damping);
    const double force = scale_of(Dimension::force, scales), across = scale_of(Dimension::tilt_damping, scales);
    const bool stated = given.bearings.empty();
    const model::Tilt& t = in_si.tilt;
    for (const std::size_t d : {0, 1}) {
      p.tilt.stiffness[d] = {(stated ? t.stiffness[d][0] : springs[d].across) / force,
                             (stated ? t.stiffness[d][1] : springs[d].tilt) / scales.torque()};
      p.tilt.damping[d] = {(stated ? t.damping[d][0] : dampers[d].across) / across,
                           (stated ? t.damping[d][1] : dampers[d].tilt) / scales.gain()};
    }
    // Of two, stiffness and damping of each follow from the supports.
    const bool each = given.bearings.size() > 2 && given.bearings.size() <= model::most_bearings;
    for (const model::Bearing& bearing : given.bearings) {
      study.bearings.push_back(bearing.at / scales.length);
      for (const std::size_t d : {0, 1}) {
        if (!each) continue;
        study.bearings_stiffness.push_back(bearing.stiffness[d] / scales.stiffness());
        study.bearings_damping.push_back(bearing.damping[d] / scales.damping());
      }
    }
  }

  void put_unbalance() {
    const bool in_planes = !given.unbalances.empty();
    const bool alone = given.places.empty() && !in_planes;
    const std::string_view from = way("rotor.eccentricity", alone);
    const bool product = from == "unbalance";
    const double own = from.empty()              ? 0.0
                       : from == "balance_grade" ? model::eccentricity_of_grade(given.grade, given.grade_at)
                                                 : in_si.eccentricity;
    if (alone) {
      p.eccentricity = own / (product ? scales.unbalance() : scales.length);
      return;
    }
    Unbalance places;
    double mass = 0.0;
    for (const DataSheet::Place& place : given.places) {
      places.add(std::polar(place.mass * place.radius, place.angle), place.at);
      mass += place.mass;
    }
    if (!(mass < given.mass))
      refuse("rotor.mass", fmt::format("must be greater than that of all places, {:.6g} kg: it includes them", mass));
    const double own_force = product ? own : own * given.mass;
    if (!in_si.tilts()) {
      const Complex resultant = own_force + places.force;
      study.direction_of_x = std::arg(resultant);
      p.eccentricity = std::abs(resultant) / scales.unbalance();
      return;
    }
    const double slender = in_si.tilt.transverse_inertia - in_si.tilt.polar_inertia;
    const double misalignment = in_si.tilt.misalignment;
    Unbalance sum;
    for (const DataSheet::Plane& plane : given.unbalances) sum.add(std::polar(plane.size, plane.angle), plane.at);
    sum.add(std::polar(own_force, in_si.eccentricity_angle), 0.0);
    sum.force += places.force;
    sum.couple += places.couple + misalignment * slender;
    sum.all_forces += places.all_forces;
    sum.all_couples += places.all_couples + std::abs(misalignment * slender);
    put_resultant(sum, slender);
  }

  // x of the model points along the couple unbalance, if there is any.
  void put_resultant(Unbalance sum, double slender) {
    if (std::abs(sum.force) <= nothing * sum.all_forces) sum.force = 0.0;
    if (std::abs(sum.couple) <= nothing * sum.all_couples) sum.couple = 0.0;
    const double couple = std::abs(sum.couple);
    study.direction_of_x = couple > 0.0 ? std::arg(sum.couple) : 0.0;
    p.eccentricity = std::abs(sum.force) / scales.unbalance();
    p.eccentricity_angle = std::abs(sum.force) > 0.0 ? wrapped(std::arg(sum.force) - study.direction_of_x) : 0.0;
    // The model has the couple as an angle times this difference.
    p.tilt.misalignment = couple > 0.0 ? couple / slender : 0.0;
    if (!(std::abs(p.tilt.misalignment) <= largest_misalignment))
      refuse("rotor.tilt.polar_inertia",
             fmt::format("is so near to transverse_inertia that the couple unbalance of {:.4g} kg m2 would turn the "
                         "principal axis by more than 0.5 rad; must differ more",
                         couple));
  }

  // With that of the motor, which turns with the rotor.
  void put_inertia() {
    const std::string_view from = way("rotor.inertia", false);
    double inertia = in_si.inertia;
    if (from == "radius_of_gyration") inertia = model::inertia_of_gyration(given.mass, inertia);
    if (from == "gd2") inertia = model::inertia_of_gd2(given.gd2_of_weight ? inertia / standard_gravity : inertia);
    p.inertia = from.empty() ? usual_inertia(p) : inertia / scales.inertia();
    const double motor = given.gear_ratio * given.gear_ratio * given.motor_inertia;
    if (motor > 0.0 && (!from.empty() || p.tilts())) p.inertia = p.inertia + motor / scales.inertia();
  }

  static constexpr double largest_misalignment = 0.5;  // rad: beyond, the linear model's angle means nothing

  const model::Scales& scales = *study.scales;
};

}  // namespace

double put_stiffness(const Sheet& sheet) {
  const DataSheet& given = sheet.given;
  std::array<double, 2>& k = sheet.p.stiffness;
  if (!given.bearings.empty()) {
    const Supports springs = sum_of(given.bearings, &model::Bearing::stiffness);
    for (const model::SupportMatrix& s : springs)
      if (!(s.determinant() > s.rounding()))
        sheet.refuse(
            "rotor.tilt.bearings",
            "must have a stiffness greater than 0 at two places at least, in x and in y: one place holds no tilt");
    k = {springs[0].centre, springs[1].centre};
  } else {
    const std::string_view from = sheet.way("rotor.stiffness");
    const double g = sheet.in_si.gravity > 0.0 ? sheet.in_si.gravity : standard_gravity;
    k = sheet.in_si.stiffness;
    for (double& v : k) {
      if (from == "natural_frequency") v = model::stiffness_of_frequency(given.mass, v);
      if (from == "static_sag") v = model::stiffness_of_sag(given.mass, g, v);
      if (!(v >= smallest_si && v <= largest_si))
        sheet.refuse(fmt::format("rotor.{}", from),
                     fmt::format("makes a stiffness of {:.3g} N/m; must make one from {} to {} N/m", v, smallest_si,
                                 largest_si));
    }
  }
  const double mean = k[0] + 0.5 * (k[1] - k[0]);  // exact for equal stiffnesses
  for (double& v : k) v /= mean;
  return mean;
}

void put_rotor(const Sheet& sheet) { Rotor{sheet}.put(); }

}  // namespace equipoise::study

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

class Rotor {
 public:
  Rotor(const Study& machine, Study& study, const Refuse& refuse)
      : machine_(machine),
        d_(machine.sheet),
        in_si_(machine.parameters),
        study_(study),
        p_(study.parameters),
        scales_(*study.scales),
        refuse_(refuse) {}

  void put() {
    put_damping();
    if (machine_.parameters.tilts()) put_supports();
    put_unbalance();
    put_inertia();
    if (!machine_.states("balancer.race_offset")) return;
    p_.race_offset = in_si_.race_offset;
    turn_back(p_.race_offset, study_.direction_of_x);
    for (double& v : p_.race_offset) v /= scales_.length;
  }

 private:
  void put_damping() {
    if (!d_.bearings.empty()) {
      const Supports dampers = sum_of(d_.bearings, &model::Bearing::damping);
      p_.damping = {dampers[0].centre / scales_.damping(), dampers[1].centre / scales_.damping()};
      return;
    }
    const std::string_view from = way_of(machine_, "rotor.damping", refuse_);
    for (const std::size_t i : {0, 1}) {
      double zeta = in_si_.damping[i];
      if (from == "logarithmic_decrement") zeta = model::ratio_of_decrement(zeta);
      if (from == "quality_factor") zeta = model::ratio_of_quality(zeta);
      if (from == "loss_factor") zeta = model::ratio_of_loss(zeta);
      p_.damping[i] = from == "damping" ? zeta / scales_.damping() : 2.0 * zeta * std::sqrt(p_.stiffness[i]);
    }
  }

  // Of a tilting rotor: {k12, k22} and {c12, c22} of the supports, and of the bearings what does not follow from
  // them.
  void put_supports() {
    const Supports springs = sum_of(d_.bearings, &model::Bearing::stiffness),
                   dampers = sum_of(d_.bearings, &model::Bearing::damping);
    const double force = scale_of(Dimension::force, scales_), across = scale_of(Dimension::tilt_damping, scales_);
    const bool stated = d_.bearings.empty();
    const model::Tilt& t = in_si_.tilt;
    for (const std::size_t d : {0, 1}) {
      p_.tilt.stiffness[d] = {(stated ? t.stiffness[d][0] : springs[d].across) / force,
                              (stated ? t.stiffness[d][1] : springs[d].tilt) / scales_.torque()};
      p_.tilt.damping[d] = {(stated ? t.damping[d][0] : dampers[d].across) / across,
                            (stated ? t.damping[d][1] : dampers[d].tilt) / scales_.gain()};
    }
    // Of two, stiffness and damping of each follow from the supports.
    const bool each = d_.bearings.size() > 2 && d_.bearings.size() <= model::most_bearings;
    for (const model::Bearing& bearing : d_.bearings) {
      study_.bearings.push_back(bearing.at / scales_.length);
      for (const std::size_t d : {0, 1}) {
        if (!each) continue;
        study_.bearings_stiffness.push_back(bearing.stiffness[d] / scales_.stiffness());
        study_.bearings_damping.push_back(bearing.damping[d] / scales_.damping());
      }
    }
  }

  void put_unbalance() {
    const bool in_planes = !d_.unbalances.empty();
    const bool alone = d_.places.empty() && !in_planes;
    const std::string_view from = way_of(machine_, "rotor.eccentricity", refuse_, alone);
    const bool product = from == "unbalance";
    const double own = from.empty()              ? 0.0
                       : from == "balance_grade" ? model::eccentricity_of_grade(d_.grade, d_.grade_at)
                                                 : in_si_.eccentricity;
    if (alone) {
      p_.eccentricity = own / (product ? scales_.unbalance() : scales_.length);
      return;
    }
    Unbalance places;
    double mass = 0.0;
    for (const DataSheet::Place& place : d_.places) {
      places.add(std::polar(place.mass * place.radius, place.angle), place.at);
      mass += place.mass;
    }
    if (!(mass < d_.mass))
      refuse_("rotor.mass", fmt::format("must be greater than that of all places, {:.6g} kg: it includes them", mass));
    const double own_force = product ? own : own * d_.mass;
    if (!in_si_.tilts()) {
      const Complex resultant = own_force + places.force;
      study_.direction_of_x = std::arg(resultant);
      p_.eccentricity = std::abs(resultant) / scales_.unbalance();
      return;
    }
    const double slender = in_si_.tilt.transverse_inertia - in_si_.tilt.polar_inertia;
    const double misalignment = in_si_.tilt.misalignment;
    Unbalance sum;
    for (const DataSheet::Plane& plane : d_.unbalances) sum.add(std::polar(plane.size, plane.angle), plane.at);
    sum.add(std::polar(own_force, in_si_.eccentricity_angle), 0.0);
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
    study_.direction_of_x = couple > 0.0 ? std::arg(sum.couple) : 0.0;
    p_.eccentricity = std::abs(sum.force) / scales_.unbalance();
    p_.eccentricity_angle = std::abs(sum.force) > 0.0 ? wrapped(std::arg(sum.force) - study_.direction_of_x) : 0.0;
    // The model has the couple as an angle times this difference.
    p_.tilt.misalignment = couple > 0.0 ? couple / slender : 0.0;
    if (!(std::abs(p_.tilt.misalignment) <= largest_misalignment))
      refuse_("rotor.tilt.polar_inertia",
              fmt::format("is so near to transverse_inertia that the couple unbalance of {:.4g} kg m2 would turn the "
                          "principal axis by more than 0.5 rad; must differ more",
                          couple));
  }

  // With that of the motor, which turns with the rotor.
  void put_inertia() {
    const std::string_view from = way_of(machine_, "rotor.inertia", refuse_, false);
    double inertia = in_si_.inertia;
    if (from == "radius_of_gyration") inertia = model::inertia_of_gyration(d_.mass, inertia);
    if (from == "gd2") inertia = model::inertia_of_gd2(d_.gd2_of_weight ? inertia / standard_gravity : inertia);
    p_.inertia = from.empty() ? usual_inertia(p_) : inertia / scales_.inertia();
    const double motor = d_.gear_ratio * d_.gear_ratio * d_.motor_inertia;
    if (motor > 0.0 && (!from.empty() || p_.tilts())) p_.inertia = p_.inertia + motor / scales_.inertia();
  }

  static constexpr double largest_misalignment = 0.5;  // rad: beyond, the linear model's angle means nothing

  const Study& machine_;
  const DataSheet& d_;
  const model::Parameters& in_si_;
  Study& study_;
  model::Parameters& p_;
  const model::Scales& scales_;
  const Refuse& refuse_;
};

}  // namespace

double put_stiffness(const Study& machine, Study& study, const Refuse& refuse) {
  const DataSheet& d = machine.sheet;
  std::array<double, 2>& k = study.parameters.stiffness;
  if (!d.bearings.empty()) {
    const Supports springs = sum_of(d.bearings, &model::Bearing::stiffness);
    for (const model::SupportMatrix& s : springs)
      if (!(s.determinant() > s.rounding()))
        refuse("rotor.tilt.bearings",
               "must have a stiffness greater than 0 at two places at least, in x and in y: one place holds no tilt");
    k = {springs[0].centre, springs[1].centre};
  } else {
    const std::string_view from = way_of(machine, "rotor.stiffness", refuse);
    const double g = machine.parameters.gravity > 0.0 ? machine.parameters.gravity : standard_gravity;
    k = machine.parameters.stiffness;
    for (double& v : k) {
      if (from == "natural_frequency") v = model::stiffness_of_frequency(d.mass, v);
      if (from == "static_sag") v = model::stiffness_of_sag(d.mass, g, v);
      if (!(v >= smallest_si && v <= largest_si))
        refuse(fmt::format("rotor.{}", from),
               fmt::format("makes a stiffness of {:.3g} N/m; must make one from {} to {} N/m", v, smallest_si,
                           largest_si));
    }
  }
  const double mean = k[0] + 0.5 * (k[1] - k[0]);  // exact for equal stiffnesses
  for (double& v : k) v /= mean;
  return mean;
}

void put_rotor(const Study& machine, Study& study, const Refuse& refuse) { Rotor(machine, study, refuse).put(); }

}  // namespace equipoise::study

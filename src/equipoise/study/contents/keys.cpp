// The table of keys.
#include "equipoise/study/contents/keys.hpp"

#include <algorithm>

#include "equipoise/core/base/angles.hpp"

namespace equipoise::study {

namespace {
using enum Key::Trait;
using D = Dimension;
using P = model::Parameters;
using R = RampSetting;
using S = SpeedSetting;
using T = TorqueSetting;
using W = ReleaseSetting;
using I = InitialState;
using Q = LoadSetting;
using A = Sampling;
using B = SamplingBox;
using N = Numerics;
using X = model::Tilt;
using L = Limits;
using M = DataSheet;
constexpr auto par = &Study::parameters;
constexpr auto speed = &Study::speed;
constexpr auto torque = &SpeedSetting::torque;
constexpr auto load = &SpeedSetting::load;
constexpr auto release = &Study::release;
constexpr auto start = &Study::initial;
constexpr auto draws = &Study::sampling;
constexpr auto box = &Sampling::box;
constexpr auto num = &Study::numerics;
constexpr auto tilt = &P::tilt;
constexpr auto lim = &Study::limits;
constexpr auto norms = &Study::standards;

template <auto... path>
Member at(Study& study, std::size_t) {
  return &(study.*....*path);
}
// Of [speed], or of a motor's target, which is also such a table.
template <auto member>
Member of_ramp(Study& study, std::size_t entry) {
  RampSetting& ramp = entry == of_target ? study.speed.torque.target : study.speed;
  return &(ramp.*member);
}
template <auto scale>
Member scale_at(Study& study, std::size_t) {
  return &((*study.scales).*scale);
}
// What the data sheet of a machine states, and an entry of its arrays.
template <auto member>
Member in_sheet(Study& study, std::size_t) {
  return &(study.sheet.*member);
}
template <auto entries, auto member>
Member in_each(Study& study, std::size_t entry) {
  auto& all = study.sheet.*entries;
  return entry < all.size() ? Member(&(all[entry].*member)) : Member();
}
Member nowhere(Study&, std::size_t) { return {}; }

constexpr Range up_to_one{0.0, 1.0}, below_one{0.0, 1.0, false, true}, below_turn{0.0, two_pi, false, true};
constexpr Range tolerances{1e-14, 1e-2}, horizons{1.0, 1e7}, shares{0.0, 1.0, true, true}, up_to_ten{0.0, 10.0, true},
    from_one{1.0, 10.0, true}, counts{0.0, model::max_balls}, exponents{1.0, 50.0};
constexpr Range ratio{0.0, largest_si}, quality{0.0, largest_si, true},
    si_size{smallest_si, largest_si};  // products of three such sizes stay finite
constexpr unsigned nameplate = physical | characteristic;
constexpr Range any = any_number;
constexpr std::nullopt_t bare = std::nullopt;  // no quantity

// Of race and balls only features in use are echoed: a rotor without them reads as it always did.
bool tilts(const Study& study) { return study.parameters.tilts(); }
bool has_bearings(const Study& study) { return !study.bearings.empty(); }
bool has_bearing_supports(const Study& study) { return !study.bearings_stiffness.empty(); }
bool has_inertia(const Study& study) { return study.parameters.inertia != usual_inertia(study.parameters); }
bool off_centre(const Study& study) { return !study.parameters.race_is_centred(); }
bool resisted(const Study& study) {
  const P& p = study.parameters;
  const auto on = [](double v) { return v != 0.0; };
  const auto balls = std::clamp(p.balls, 0, model::max_balls);
  return std::any_of(p.rolling.begin(), p.rolling.begin() + balls, on) ||
         std::any_of(p.stiction.begin(), p.stiction.begin() + balls, on);
}
bool has_class(const Study& study) { return study.standards.severity_class.has_value(); }
bool is_hand_held(const Study& study) { return study.standards.hand_held; }
bool rolls(const Study& study) { return study.parameters.rolls; }
bool touches(const Study& study) { return study.parameters.contact_angle != 0.0; }
bool rebounds(const Study& study) { return touches(study) || study.parameters.restitution != P{}.restitution; }

}  // namespace

std::vector<Key> all_keys() {
  return {
      // Supports and rotor.
      {"rotor.mass", in_sheet<&M::mass>, positive, D::mass, required | physical,
       "M: all that vibrates, every `[[place]]` included, without the balls"},
      Key{"rotor.eccentricity", at<par, &P::eccentricity>, not_negative, D::length, required | replaceable,
          "lambda = eps/R"}
          .in_units("of the rotor's centre of mass")
          .one_way("eccentricity", "a length of 0 or more, such as \"0.2 mm\""),
      Key{"rotor.unbalance", at<par, &P::eccentricity>, not_negative, D::unbalance, physical,
          "or this: M times the eccentricity"}
          .one_way("eccentricity", "mass times eccentricity, such as \"300 g mm\""),
      Key{"rotor.balance_grade", nowhere, any, bare, physical,
          "or this, a table: `{ grade = \"G 6.3\", at = \"3000 rpm\" }`; the eccentricity is grade/speed [ISO "
          "21940-11]"}
          .one_way("eccentricity", "a table such as { grade = \"G 6.3\", at = \"3000 rpm\" }"),
      Key{"rotor.damping", at<par, &P::damping>, not_negative, D::damping, required | replaceable, "zeta = c/sqrt(k M)"}
          .in_units("of the supports")
          .one_way("damping", "a damping coefficient of 0 or more, such as \"200 N s/m\""),
      Key{"rotor.damping_ratio", at<par, &P::damping>, ratio, bare, physical,
          "or this: c/(2 sqrt(k M)) with each direction's own stiffness; half of zeta; `\"5 %\"` is 0.05"}
          .one_way("damping", "a plain number or \"5 %\", c/(2 sqrt(k M))"),
      Key{"rotor.logarithmic_decrement", at<par, &P::damping>, ratio, bare, physical,
          "or this, d of the free vibration: the ratio is d/sqrt(4 pi^2 + d^2)"}
          .one_way("damping", "a plain number, per cycle of free vibration, such as 0.3"),
      Key{"rotor.quality_factor", at<par, &P::damping>, quality, bare, physical,
          "or this, Q = sqrt(k M)/c: the ratio is 1/(2 Q)"}
          .one_way("damping", "a plain number, sqrt(k M)/c, such as 8"),
      Key{"rotor.loss_factor", at<par, &P::damping>, ratio, bare, physical, "or this, eta = 1/Q: the ratio is eta/2"}
          .one_way("damping", "a plain number, c/sqrt(k M), such as 0.1"),
      Key{"rotor.stiffness", at<par, &P::stiffness>, positive, D::stiffness, none, "kappa, in k"}
          .in_units("of the supports; k is the mean")
          .one_way("stiffness", "a stiffness greater than 0, such as \"48 kN/m\""),
      Key{"rotor.natural_frequency", at<par, &P::stiffness>, positive, D::speed, physical,
          "or this: of the rotor without balls on its supports; k = M omega^2"}
          .one_way("stiffness", "of the rotor without balls, such as \"8 Hz\" or \"480 rpm\""),
      Key{"rotor.static_sag", at<par, &P::stiffness>, positive, D::length, physical,
          "or this: of the rotor without balls under its weight; k = M g/sag, g of `gravity` or 9.80665 m/s2"}
          .one_way("stiffness", "under its own weight, such as \"3 mm\""),
      Key{"rotor.gravity", at<par, &P::gravity>, not_negative, D::acceleration, none, "G = g/(R omega_c^2), along -Y"}
          .in_units("across the shaft"),
      Key{"rotor.inertia", at<par, &P::inertia>, not_negative, D::inertia, nonzero,
          "iota = I_C/(M R^2), about the centre of mass; for motors, and the work of a change of speed", nullptr,
          has_inertia}
          .in_units("J, as in a dimensionless study")
          .one_way("inertia", "a moment of inertia greater than 0, such as \"0.02 kg m2\""),
      Key{"rotor.radius_of_gyration", at<par, &P::inertia>, positive, D::length, physical, "or this, r: J = M r^2"}
          .one_way("inertia", "sqrt(J/M), such as \"60 mm\""),
      Key{"rotor.gd2", at<par, &P::inertia>, positive, D::inertia, physical,
          "or this, GD^2 = 4 J; also as a weight times a diameter squared, `\"0.3 kgf m2\"`"}
          .or_as(D::weight_inertia, &M::gd2_of_weight)
          .one_way("inertia", "4 J, such as \"0.3 kgf m2\""),
      {"rotor.eccentricity_angle", at<par, &P::eccentricity_angle>, any, D::angle, none,
       "beta_0, of the centre of mass from angle 0, that of the couple unbalance; only with `tilt`", nullptr, tilts},
      {"rotor.tilt", nowhere, any, bare, none, "a table: how the rotor tilts"},
      {"rotor.tilt.transverse_inertia", at<par, tilt, &X::transverse_inertia>, positive, D::inertia, required,
       "Jt/(M R^2), about a diameter"},
      {"rotor.tilt.polar_inertia", at<par, tilt, &X::polar_inertia>, not_negative, D::inertia, required,
       "Jp/(M R^2), about the shaft's axis; at most 2 Jt"},
      {"rotor.tilt.misalignment", at<par, tilt, &X::misalignment>, any, D::angle, none,
       "chi, in rad, of the principal axis from the shaft; the couple unbalance is chi (Jt - Jp)"},
      Key{"rotor.tilt.stiffness", at<par, tilt, &X::stiffness>, any, bare, required | replaceable,
          "`[k12, k22]` of the supports, or `{ x = [..], y = [..] }`; with `rotor.stiffness` positive definite"}
          .in_units("`[\"0 N\", \"900 N m\"]`: `[k12, k22]`, or `{ x = [..], y = [..] }`, with `rotor.stiffness`; "
                    "or `bearings`"),
      Key{"rotor.tilt.damping", at<par, tilt, &X::damping>, any, bare, required | replaceable,
          "in the same way `[c12, c22]`; with `rotor.damping` not negative in any motion"}
          .in_units("`[\"0 N s\", \"18 N m s\"]`: `[c12, c22]`, with `rotor.damping`; or `bearings`"),
      {"rotor.tilt.bearings_at", at<&Study::bearings>, any, D::length, none,
       "places of bearings along the shaft from the centre of mass, where displacements are reported, and forces where "
       "they are all supports; by default none",
       nullptr, has_bearings},
      {"rotor.tilt.bearings_stiffness", at<&Study::bearings_stiffness>, not_negative, D::stiffness, none,
       "of each bearing, or of each in X and Y in turn, in k; by default each is known if two are all supports",
       nullptr, has_bearing_supports},
      {"rotor.tilt.bearings_damping", at<&Study::bearings_damping>, not_negative, D::damping, none,
       "in M omega_c, in the same form; default: as for the stiffness", nullptr, has_bearing_supports},
      {"rotor.tilt.bearings", nowhere, any, bare, physical,
       "a table for each bearing; these are the supports, without `stiffness` and `damping` here and in `[rotor]`"},
      {"rotor.tilt.unbalance", nowhere, any, bare, physical,
       "a table for each plane that has one; two planes hold all that a rigid rotor has [ISO 21940-11]; adds to its "
       "own"},
      {"rotor.balance_grade.grade", in_sheet<&M::grade>, positive, D::velocity, required | physical,
       "`\"G 6.3\"`, or the velocity that it means, `\"6.3 mm/s\"`"},
      {"rotor.balance_grade.at", in_sheet<&M::grade_at>, positive, D::speed, required | physical,
       "the speed that it holds at"},
      {"rotor.tilt.bearings.at", in_each<&M::bearings, &model::Bearing::at>, any, D::length, required | physical,
       "its place along the shaft from the rotor's centre of mass"},
      {"rotor.tilt.bearings.stiffness", in_each<&M::bearings, &model::Bearing::stiffness>, not_negative, D::stiffness,
       required | physical, "or `[x, y]`; greater than 0 at two places at least"},
      {"rotor.tilt.bearings.damping", in_each<&M::bearings, &model::Bearing::damping>, not_negative, D::damping,
       required | physical, "or `[x, y]`"},
      {"rotor.tilt.unbalance.at", in_each<&M::unbalances, &M::Plane::at>, any, D::length, required | physical,
       "the plane's place along the shaft from the rotor's centre of mass"},
      {"rotor.tilt.unbalance.size", in_each<&M::unbalances, &M::Plane::size>, not_negative, D::unbalance,
       required | physical, "mass times radius"},
      {"rotor.tilt.unbalance.angle", in_each<&M::unbalances, &M::Plane::angle>, any, D::angle, required | physical,
       "from the rotor's angle 0"},
      {"place.mass", in_each<&M::places, &M::Place::mass>, positive, D::mass, required | physical,
       "at this place; part of `rotor.mass`"},
      {"place.radius", in_each<&M::places, &M::Place::radius>, positive, D::length, required | physical,
       "from the shaft"},
      {"place.angle", in_each<&M::places, &M::Place::angle>, any, D::angle, required | physical,
       "from the rotor's own unbalance"},
      {"place.at", in_each<&M::places, &M::Place::at>, any, D::length, physical,
       "along the shaft from the rotor's centre of mass; required with `rotor.tilt`"},
      {"place.name", in_each<&M::places, &M::Place::name>, any, bare, physical, "a text, for the reader"},
      {"balancer.balls", at<par, &P::balls>, counts, bare, required,
       "n, how many; 0: the rotor alone, for `simulate`, `basin`, `report` and `explain`"},
      Key{"balancer.race_radius", in_sheet<&M::race>, positive, D::length, physical, "R: of the circle of ball centres"}
          .one_way("race_radius", "a length greater than 0, such as \"60 mm\""),
      Key{"balancer.race_diameter", in_sheet<&M::race>, positive, D::length, physical, "or this: 2 R"}.one_way(
          "race_radius", "such as \"120 mm\""),
      {"balancer.ball_diameter", in_sheet<&M::diameter>, positive, D::length, physical,
       "balls whose size is given roll, and touch"},
      Key{"balancer.mass", at<par, &P::mass>, positive, D::mass, required | replaceable, "mu = m/M"}
          .in_units("of a ball")
          .one_way("mass", "a mass greater than 0, such as \"5 g\""),
      Key{"balancer.ball_density", at<par, &P::mass>, positive, D::density, physical, "or this, with `ball_diameter`"}
          .one_way("mass", "with balancer.ball_diameter"),
      Key{"balancer.ball_material", in_sheet<&M::material>, any, bare, physical,
          "or this, with `ball_diameter`: `steel`, `stainless steel`, `tungsten carbide`, `ceramic`, `glass`"}
          .one_way("mass", "such as \"steel\", with balancer.ball_diameter"),
      Key{"balancer.drag", at<par, &P::drag>, not_negative, D::gain, required | replaceable, "beta = D/(m R^2 omega_c)"}
          .in_units("torque for a rate relative to the race, or force for a speed along it (`\"0.01 N s/m\"`)")
          .or_as(D::damping, &M::drag_of_force)
          .one_way("drag",
                   "a torque for a rate, such as \"1e-6 N m s\", or a force for a velocity, such as \"0.01 N s/m\""),
      Key{"balancer.oil_viscosity", in_sheet<&M::oil_viscosity>, positive, D::viscosity, physical,
          "or this, of the oil in the race (`\"100 cSt\"` with `oil_density`); needs `ball_diameter`"}
          .or_as(D::kinematic_viscosity, &M::kinematic)
          .one_way("drag", "with balancer.ball_diameter"),
      Key{"balancer.oil", nowhere, any, bare, physical,
          "or this, a table: `{ grade = \"ISO VG 32\", at = \"40 degC\" }`; needs `ball_diameter`"}
          .one_way("drag", "such as { grade = \"ISO VG 32\", at = \"40 degC\" }"),
      {"balancer.oil_density", in_sheet<&M::oil_density>, positive, D::density, physical,
       "for kinematic viscosities and the Reynolds number of `explain`; of an `oil` 870, of silicone 970 kg/m3"},
      {"balancer.channel_diameter", in_sheet<&M::channel>, positive, D::length, physical,
       "of the race's cross-section, for the drag of its walls; balls of at most 0.8 of it"},
      {"balancer.oil.grade", in_sheet<&M::oil_grade>, any, bare, required | physical,
       "`\"ISO VG 32\"`, a class of ISO 3448; or `\"silicone 1000 cSt\"`, at 25 degC"},
      {"balancer.oil.at", in_sheet<&M::oil_at>, positive, D::temperature, required | physical,
       "in the running machine"},
      {"balancer.oil.viscosity_100", in_sheet<&M::oil_viscosity_100>, positive, D::kinematic_viscosity, physical,
       "of a mineral oil at 100 degC, `\"5.4 cSt\"`; left out, that of viscosity index 95"},
      {"balancer.contact", in_sheet<&M::contact>, any, bare, physical,
       "`false`: balls pass through each other; by default two or more of one `ball_diameter` touch"},
      {"balancer.plane", at<par, tilt, &X::plane>, any, D::length, none,
       "of each ball's race: its place along the shaft from the rotor's centre of mass, in R; with `rotor.tilt`, and "
       "then without a default",
       nullptr, tilts},
      {"balancer.race_offset", at<par, &P::race_offset>, any, D::length, pair,
       "e/R, the race's centre from the shaft's, in the rotating frame", nullptr, off_centre},
      {"balancer.rolling", at<par, &P::rolling>, not_negative, bare, none,
       "resistance of a moving ball over its normal force", nullptr, resisted},
      {"balancer.stiction", at<par, &P::stiction>, not_negative, bare, none,
       "the largest at rest: `rolling` (default) or more", nullptr, resisted},
      {"balancer.rolls", at<par, &P::rolls>, any, bare, none,
       "balls are solid spheres that do not slip; else point masses that slide, as in Wright and Peng", nullptr, rolls},
      {"balancer.ball_radius", at<par, &P::ball_radius>, below_one, D::length, none,
       "of a ball that rolls, over R; plays a part only while the speed changes", nullptr, rolls},
      {"balancer.contact_angle", at<par, &P::contact_angle>, below_turn, D::angle, none,
       "between touching balls, below 2 pi/n; 0: balls pass each other", nullptr, touches},
      {"balancer.restitution", at<par, &P::restitution>, up_to_one, bare, none, "of ball on ball", nullptr, rebounds},
      // The variants of [speed] are its profiles, those of speed.torque the laws of motors.
      {"speed.profile", of_ramp<&R::profile>, any, bare, required, "names the ramp function Omega(t)"},
      {"speed.law", at<speed, &S::law>, any, bare, none, "how the rotor follows it"},
      {"speed.speed", of_ramp<&R::speed>, any, D::speed, required | constant, "Omega"},
      {"speed.initial", of_ramp<&R::initial>, any, D::speed, ramp | trapezoid | driven, "at t = 0", "initial speed"},
      {"speed.peak", of_ramp<&R::peak>, any, D::speed, required | trapezoid, "from `rise_until` to `hold_until`",
       "peak speed"},
      {"speed.final", of_ramp<&R::final>, any, D::speed, required | ramp | trapezoid | hill,
       "at last; `hill`: Omega_max"},
      {"speed.duration", of_ramp<&R::duration>, positive, D::time, required | ramp, "of the ramp"},
      {"speed.rise_until", of_ramp<&R::rise_until>, positive, D::time, required | trapezoid, "T0"},
      {"speed.hold_until", of_ramp<&R::hold_until>, positive, D::time, required | trapezoid, "T1, after T0"},
      {"speed.fall_until", of_ramp<&R::fall_until>, positive, D::time, required | trapezoid, "T2, after T1"},
      {"speed.half_time", of_ramp<&R::half_time>, positive, D::time, required | hill,
       "t_half, when half of `final` is reached"},
      {"speed.exponent", of_ramp<&R::exponent>, exponents, bare, required | hill, "n"},
      {"speed.until", of_ramp<&R::until>, positive, D::time, hill,
       "at least `half_time`; then along the tangent to `final`; by default when 99.9 % of `final` is reached"},
      {"speed.times", of_ramp<&R::times>, not_negative, D::time, required | points, "increasing, the first 0"},
      {"speed.speeds", of_ramp<&R::speeds>, any, D::speed, required | points, "one per time"},
      {"speed.stalled_below", at<speed, &S::stalled_below>, any, D::speed, driven, "a mean speed that is stalled"},
      {"speed.torque", nowhere, any, bare, driven, "a table: the motor"},
      {"speed.load", nowhere, any, bare, driven, "a table: what the machine takes of the motor's torque"},
      {"speed.gear_ratio", in_sheet<&M::gear_ratio>, si_size, bare, driven | physical,
       "motor speed over rotor speed; `torque` is then at the motor's shaft"},
      {"speed.motor_inertia", in_sheet<&M::motor_inertia>, not_negative, D::inertia, driven | physical,
       "of the motor's rotor, at its own shaft; added to `rotor.inertia`"},
      {"speed.run_up", of_ramp<&R::duration>, positive, D::time, physical,
       "instead of a profile: a linear ramp to `final` that takes this long"},
      {"speed.torque.stall", at<speed, torque, &T::stall>, any, D::torque, required | stall, "torque at rest"},
      {"speed.torque.no_load_speed", at<speed, torque, &T::no_load_speed>, positive, D::speed, required | stall,
       "where it has fallen to 0"},
      {"speed.torque.times", at<speed, torque, &T::times>, not_negative, D::time, required | curve, "increasing"},
      {"speed.torque.speeds", at<speed, torque, &T::speeds>, any, D::speed, required | characteristic,
       "increasing: points of the motor's curve"},
      {"speed.torque.values", at<speed, torque, &T::values>, any, D::torque, required | curve | characteristic,
       "one per time, or one per speed"},
      {"speed.torque.power", in_sheet<&M::power>, positive, D::power, nameplate,
       "rated power of an induction motor, by its nameplate"},
      {"speed.torque.rated_torque", in_sheet<&M::rated_torque>, positive, D::torque, nameplate,
       "or this, with `power` or instead of it"},
      {"speed.torque.rated_speed", in_sheet<&M::rated_speed>, positive, D::speed, nameplate, "at the rated power"},
      {"speed.torque.breakdown_ratio", in_sheet<&M::breakdown_ratio>, from_one, bare, nameplate,
       "breakdown torque over rated torque"},
      {"speed.torque.locked_rotor_ratio", in_sheet<&M::locked_rotor_ratio>, up_to_ten, bare, nameplate,
       "torque at rest over rated torque; by default what Kloss's formula gives"},
      {"speed.torque.synchronous_speed", in_sheet<&M::synchronous_speed>, positive, D::speed, nameplate,
       "by default the next one of a motor at 50 or 60 Hz"},
      {"speed.torque.gain", at<speed, torque, &T::gain>, not_negative, D::gain, required | control,
       "torque for a speed error of 1"},
      {"speed.torque.integral", at<speed, torque, &T::integral>, not_negative, D::torque, control,
       "torque a unit of time for a speed error of 1"},
      {"speed.torque.limit", at<speed, torque, &T::limit>, positive, D::torque, control, "of the torque, either way"},
      {"speed.torque.target", nowhere, any, bare, control, "a table as `[speed]`: a ramp function"},
      {"speed.torque.constant", at<speed, torque, &T::constant>, any, D::torque, required | linear, "torque at rest"},
      {"speed.torque.slope", at<speed, torque, &T::slope>, any, D::gain, linear, "torque for a speed, added"},
      {"speed.torque.until", at<speed, torque, &T::until>, not_negative, D::time, linear, "no torque from then on"},
      {"speed.load.constant", at<speed, load, &Q::constant>, not_negative, D::torque, none,
       "torque taken at every speed"},
      {"speed.load.linear", at<speed, load, &Q::linear>, not_negative, D::torque, none,
       "torque that grows with the speed, as it is at speed `at`"},
      {"speed.load.quadratic", at<speed, load, &Q::quadratic>, not_negative, D::torque, none,
       "torque that grows with the square of the speed, as a fan's, as it is at speed `at`"},
      {"speed.load.at", at<speed, load, &Q::at>, positive, D::speed, none,
       "where `linear` and `quadratic` have these values"},
      {"release.speed", at<release, &W::speed>, any, D::speed, none, "when it is first reached", "at speed"},
      {"release.time", at<release, &W::time>, not_negative, D::time, none, "at this time", "at time"},
      {"initial.psi", at<start, &I::psi>, any, D::angle, none, "of the rotor", "rotor angle"},
      {"initial.x", at<start, &I::x>, any, D::length, none, "of the rotor, in the rotating frame"},
      {"initial.y", at<start, &I::y>, any, D::length, none, "likewise"},
      {"initial.x_dot", at<start, &I::x_dot>, any, D::velocity, none, "rate of `x`"},
      {"initial.y_dot", at<start, &I::y_dot>, any, D::velocity, none, "rate of `y`"},
      {"initial.tilt_x", at<start, &I::tilt_x>, any, D::angle, none,
       "slope of the shaft along the rotating x axis; with `rotor.tilt`", nullptr, tilts},
      {"initial.tilt_y", at<start, &I::tilt_y>, any, D::angle, none, "likewise", nullptr, tilts},
      {"initial.tilt_x_dot", at<start, &I::tilt_x_dot>, any, D::speed, none, "rate of `tilt_x`", nullptr, tilts},
      {"initial.tilt_y_dot", at<start, &I::tilt_y_dot>, any, D::speed, none, "rate of `tilt_y`", nullptr, tilts},
      {"initial.phi", at<start, &I::phi>, any, D::angle, none, "by default spread evenly, the first at 0",
       "ball angles", states_angles},
      {"initial.phi_dot", at<start, &I::phi_dot>, any, D::speed, none, "0 where balls are clamped at first",
       "ball rates"},
      {"sampling.box", nowhere, any, bare, none, "a table: what is drawn in addition to ball angles"},
      {"sampling.method", at<draws, &A::method>, any, bare, none, "how starts are drawn"},
      {"sampling.starts", at<draws, &A::starts>, {1.0, 1e12}, bare, none, "how many; of a grid 2 or more"},
      {"sampling.seed", at<draws, &A::seed>, {0.0, 0x1p63}, bare, none, "of the random numbers"},
      {"sampling.box.x", at<draws, box, &B::x>, any, D::length, none, "as in `[initial]`"},
      {"sampling.box.y", at<draws, box, &B::y>, any, D::length, none, "as in `[initial]`"},
      {"sampling.box.x_dot", at<draws, box, &B::x_dot>, any, D::velocity, none, "as in `[initial]`"},
      {"sampling.box.y_dot", at<draws, box, &B::y_dot>, any, D::velocity, none, "as in `[initial]`"},
      {"sampling.box.phi_dot", at<draws, box, &B::phi_dot>, any, D::speed, none, "of every ball", "ball rates"},
      {"numerics.tolerance", at<num, &N::tolerance>, tolerances, bare, none,
       "error allowed a step; by default 1e-6 for `basin`, 1e-12 for `simulate`"},
      {"numerics.horizon", at<num, &N::horizon>, horizons, D::time, none,
       "time after the last branch begins (and release) until a start counts as undecided; by default chosen"},
      {"numerics.decide", at<num, &N::decide>, any, bare, none, "grounds on which an outcome is known early"},
      {"limits.displacement", at<lim, &L::displacement>, positive, D::length, none,
       "radial, of the rotor from where it rests under its weight, in R"},
      {"limits.force", at<lim, &L::force>, positive, D::force, none,
       "on the supports, or for a tilting rotor on each known bearing, weight included, in M R omega_c^2"},
      {"limits.velocity", at<lim, &L::velocity>, positive, D::velocity, none,
       "root mean square of both directions together, of the centre of the race, in R omega_c"},
      {"limits.velocity_one_direction", at<lim, &L::velocity_one_direction>, positive, D::velocity, none,
       "the same in X or in Y, whichever has more, as standards of severity have it, in R omega_c"},
      {"limits.dynamic_force", at<lim, &L::dynamic_force>, positive, D::force, none,
       "as `force`, without what carries the weight at rest, in M R omega_c^2"},
      {"limits.settling_time", at<lim, &L::settling_time>, positive, D::time, none,
       "from release until the displacement stays below `settled`, which it needs, in 1/omega_c"},
      {"limits.hand_arm", at<lim, &L::hand_arm>, positive, D::acceleration, none,
       "root mean square acceleration in the end, weighted for hands by ISO 5349-1, of both directions together; only "
       "in a study in physical units or with `[units]`"},
      {"limits.share", at<lim, &L::share>, shares, bare, none,
       "of starts that have to keep all of these limits, for the verdict; by default 0.95"},
      {"limits.settled", at<lim, &L::settled>, positive, D::length, none,
       "displacement below which the rotor counts as settled, in R"},
      {"limits.residual", at<lim, &L::residual>, positive, D::unbalance, none,
       "unbalance left in the end, U/M in R; in a physical study also a grade, `\"G 6.3\"`, which sets `grade`"},
      {"limits.grade", at<lim, &L::grade>, positive, D::velocity, none,
       "e omega in the end: unbalance left over the rotor's mass times the speed, in R omega_c"},
      {"limits.clearance", at<lim, &L::clearance>, positive, D::length, none,
       "radial, between rotor and housing, all around where the rotor rests, in R"},
      {"standards.severity_class", at<norms, &Standards::severity_class>, any, bare, none,
       "of ISO 10816-1:1995, for zones of severity (by default none are given): I small machines, up to 15 kW; II up "
       "to "
       "75 kW; III large ones, rigid; IV large ones, on soft supports",
       nullptr, has_class},
      {"standards.hand_held", at<norms, &Standards::hand_held>, any, bare, none,
       "`true`: the machine is held by hand; daily exposure by ISO 5349-1 and Directive 2002/44/EC", nullptr,
       is_hand_held},
      {"standards.standing_mass", at<norms, &Standards::standing_mass>, positive, D::mass, none,
       "of all that stands on its feet; shows whether the machine may slide"},
      {"standards.friction", at<norms, &Standards::friction>, up_to_ten, bare, none,
       "coefficient between feet and floor"},
      {"sweep.over", at<&Study::sweep, &SweepSetting::over>, any, bare, none,
       "as of `--over`: `[\"speed.final=1.5:6:0.1\", \"balancer.drag=0.01,0.05\"]`"},
      {"sweep.zip", at<&Study::sweep, &SweepSetting::zip>, any, bare, none,
       "they vary together, not in all combinations"},
      {"design", nowhere, any, bare, none, "analyses/design/problem.cpp reads this table"},
      {"units.mass", scale_at<&model::Scales::mass>, si_size, bare, required, "M, kg"},
      {"units.length", scale_at<&model::Scales::length>, si_size, bare, required, "R, m"},
      {"units.frequency", scale_at<&model::Scales::frequency>, si_size, bare, required, "omega_c, rad/s"},
  };
}

}  // namespace equipoise::study

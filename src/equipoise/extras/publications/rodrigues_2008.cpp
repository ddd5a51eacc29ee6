// Their first rotor: time histories and charts of stability.
#include <algorithm>
#include <cmath>

#include "equipoise/extras/publications/measures.hpp"
#include "equipoise/extras/publications/rodrigues.hpp"

namespace equipoise {

namespace rodrigues {

PublicationRow of_long_rotor(const char* place, const char* quantity, KnownBy known_by, Estimate published,
                             Settings settings, Estimate (*computed)(const Study&, const RunOptions&),
                             const char* reason) {
  return {place, quantity, "", known_by, published, std::move(settings), computed, reason, nullptr, "long-rotor"};
}

Settings static_alone(Settings more) {
  more.insert(more.begin(), {"rotor.eccentricity=0.01", "rotor.tilt.misalignment=0"});
  return more;
}

}  // namespace rodrigues

namespace {

using enum KnownBy;
using namespace measures;
using namespace rodrigues;

constexpr const char* geometry =
    "their charts keep what the balls' motion along the shaft does as it tilts, of the order of a ball's mass times "
    "the "
    "tilt; this model leaves it out";

constexpr const char* by_rounding =
    "where the balls come to depends on rounding: in another program's eight runs, of different steps, two to four "
    "balls "
    "lag in the end, never one";
constexpr const char* first_swing =
    "balls that begin together part by rounding alone, and it is not on record whether the first swing counts: that "
    "reaches 0.071 here";

void all_masses(Study& study, double mass) { std::fill_n(study.parameters.mass.begin(), study.parameters.balls, mass); }
void eccentricity(Study& study, double value) { study.parameters.eccentricity = value; }
// Of each of two bearings, three race radii from the middle.
void damping_a_bearing(Study& study, double c) {
  study.parameters.damping = {2.0 * c, 2.0 * c};
  study.parameters.tilt.damping = {{{0.0, 18.0 * c}, {0.0, 18.0 * c}}};
}

// What a rotor shows that does not tilt. Reading: 2 % of the axis, as noted when the plots were read.
std::vector<PublicationRow> figure_11() {
  const std::vector<std::string> third{"speed.speed=4", "rotor.eccentricity=0.01", "balancer.mass=0.01"};
  const std::vector<std::string> fourth{"speed.speed=1.5", "rotor.eccentricity=0.025", "balancer.mass=0.05"};
  const auto alone = [](const Study& s, const RunOptions&) { return settled_without_balls(s); };
  return {
      {"fig. 11 (i)",
       "highest deflection to t = 800",
       "",
       plot,
       {0.048, 0.001},
       {},
       [](const Study& s, const RunOptions&) { return highest(s, 0.0, 800.0); }},
      {"fig. 11 (i)", "deflection without balls", "", plot, {0.0133, 0.001}, {}, alone},
      {"fig. 11 (iii)",
       "highest deflection from t = 750 to 800",
       "",
       plot,
       {0.0, 0.001},
       third,
       [](const Study& s, const RunOptions&) { return highest(s, 750.0, 800.0); }},
      {"fig. 11 (iii)", "deflection without balls", "", plot, {0.0107, 0.001}, third, alone},
      {"fig. 11 (iv)",
       "highest deflection of an irregular motion to t = 800",
       "",
       plot,
       {0.39, 0.01},
       fourth,
       [](const Study& s, const RunOptions&) { return highest_of_irregular(s, 0.0, 800.0); }},
      {"fig. 11 (iv)", "deflection without balls", "", plot, {0.045, 0.001}, fourth, alone},
  };
}

// Charts of stability. Reading: 0.01 in Omega, as noted; else half a unit of the last digit.
std::vector<PublicationRow> charts_of_2008() {
  const Settings wide = static_alone({"balancer.mass=0.04"}), at_3 = static_alone({"speed.speed=3"});
  const Settings at_5 = static_alone({"balancer.mass=0.025", "speed.speed=5"});
  return {
      of_long_rotor("fig. 5 (a)", "speed at which balance turns stable", plot, {2.11, 0.01}, wide,
                    [](const Study& s, const RunOptions&) { return boundary(s, 2.0, 2.2); }),
      of_long_rotor(
          "fig. 5 (a)", "at which it turns unstable again", plot, {2.43, 0.01}, wide,
          [](const Study& s, const RunOptions&) { return boundary(s, 2.2, 3.0); }, geometry),
      of_long_rotor(
          "fig. 5 (a)", "at which it turns stable for good", plot, {5.54, 0.01}, wide,
          [](const Study& s, const RunOptions&) { return boundary(s, 4.0, 6.0); }, geometry),
      of_long_rotor(
          "fig. 5 (d)", "speed up to which balance is unstable, at the right end of a narrow strip", plot,
          {4.167, 0.01}, static_alone({"balancer.mass=0.003545"}),
          [](const Study& s, const RunOptions&) { return boundary(s, 3.5, 4.8); }, geometry),
      of_long_rotor("fig. 5 (e)", "mass of a ball at which balance turns unstable", plot, {0.0034, 5e-5}, at_3,
                    [](const Study& s, const RunOptions&) { return boundary(s, 0.003, 0.0036, all_masses); }),
      of_long_rotor("fig. 5 (e)", "at which it turns stable again", plot, {0.0038, 5e-5}, at_3,
                    [](const Study& s, const RunOptions&) { return boundary(s, 0.0036, 0.0045, all_masses); }),
      of_long_rotor("fig. 5 (e)", "at which it turns unstable once more", plot, {0.0054, 5e-5}, at_3,
                    [](const Study& s, const RunOptions&) { return boundary(s, 0.0045, 0.007, all_masses); }),
      of_long_rotor(
          "fig. 6 (a)", "eccentricity at which balance turns unstable", plot, {0.05, 5e-4}, at_5,
          [](const Study& s, const RunOptions&) { return boundary(s, 0.02, 0.06, eccentricity); }, geometry),
      of_long_rotor(
          "fig. 6 (b)", "damping of a bearing at which it turns unstable", plot, {0.023, 5e-4}, at_5,
          [](const Study& s, const RunOptions&) { return boundary(s, 0.01, 0.05, damping_a_bearing); }, geometry),
      of_long_rotor(
          "fig. 6 (b)", "at which it turns stable again", plot, {0.139, 5e-4}, at_5,
          [](const Study& s, const RunOptions&) { return boundary(s, 0.05, 0.2, damping_a_bearing); }, geometry),
      of_long_rotor(
          "fig. 6 (b)", "at which it turns unstable once more", plot, {0.33, 0.005}, at_5,
          [](const Study& s, const RunOptions&) { return boundary(s, 0.2, 0.5, damping_a_bearing); }, geometry),
      of_long_rotor(
          "fig. 6 (c)", "speed at which balance turns stable for good", plot, {4.06, 0.01},
          static_alone({"balancer.mass=0.025", "balancer.drag=0.1"}),
          [](const Study& s, const RunOptions&) { return boundary(s, 3.0, 5.0); }, geometry),
      of_long_rotor(
          "fig. 10 (b)", "speed at which balance turns stable for good", plot, {3.85, 0.01},
          {"balancer.mass=0.025", "balancer.drag=0.1"},
          [](const Study& s, const RunOptions&) { return boundary(s, 3.0, 5.0); }, geometry),
  };
}

// Time histories with both unbalances; of balls that settle to t = 1200.
std::vector<PublicationRow> figure_12() {
  const Settings a{"balancer.mass=0.005"};
  const Settings b{"balancer.mass=0.005",
                   "initial.phi=[1.0471975511965976, -1.0471975511965976, 2.0943951023931953, -2.0943951023931953]"};
  return {
      of_long_rotor("fig. 11 (ii)", "highest deflection from t = 700 to 800, with a tilt of 1e-6 at first", plot,
                    {0.143, 0.003}, static_alone({"balancer.mass=0.005", "speed.speed=2.5", "initial.tilt_x=1e-6"}),
                    [](const Study& s, const RunOptions&) { return highest_of_irregular(s, 700.0, 800.0); }),
      of_long_rotor("fig. 12 (a)", "highest deflection", plot, {0.0255, 5e-4}, a,
                    [](const Study& s, const RunOptions&) { return highest(s, 0.0, 1200.0); }),
      of_long_rotor("fig. 12 (a)", "deflection without balls", plot, {0.0084, 5e-4}, a,
                    [](const Study& s, const RunOptions&) { return settled_without_balls(s); }),
      of_long_rotor("fig. 12 (a)", "angle of the first ball in the end", plot, {2.5, 0.05}, a,
                    [](const Study& s, const RunOptions&) { return last_angle(s, 0, 1200.0); }),
      of_long_rotor("fig. 12 (a)", "of the second", plot, {-1.7, 0.05}, a,
                    [](const Study& s, const RunOptions&) { return last_angle(s, 1, 1200.0); }),
      of_long_rotor("fig. 12 (a)", "of the third", plot, {4.2, 0.05}, a,
                    [](const Study& s, const RunOptions&) { return last_angle(s, 2, 1200.0); }),
      of_long_rotor("fig. 12 (a)", "of the fourth", plot, {0.5, 0.05}, a,
                    [](const Study& s, const RunOptions&) { return last_angle(s, 3, 1200.0); }),
      of_long_rotor("fig. 12 (b)", "rate of the one ball that lags in the end", plot, {-1.73, 0.005}, b, nullptr,
                    by_rounding),
      of_long_rotor("fig. 12 (b)", "deflection in the end", plot, {0.0165, 3.5e-4}, b, nullptr, by_rounding),
      of_long_rotor("fig. 12 (c)", "highest deflection of an irregular motion", plot, {0.065, 0.0013},
                    {"balancer.mass=0.005", "initial.phi=[0, 0, 3.141592653589793, 3.141592653589793]"}, nullptr,
                    first_swing),
  };
}

void append(std::vector<PublicationRow>& rows, const std::vector<PublicationRow>& more) {
  rows.insert(rows.end(), more.begin(), more.end());
}

}  // namespace

Publication rodrigues_2008() {
  Publication p{
      "rodrigues-2008",
      "Rodrigues, Champneys, Friswell and Wilson 2008",
      "D. J. Rodrigues, A. R. Champneys, M. I. Friswell, R. E. Wilson. Automatic two-plane balancing for rigid "
      "rotors. International Journal of Non-Linear Mechanics 43 (2008), 527",
      "the preprint of 2007",
      "rodrigues-2008",
      {{"m/M, of each of four balls",
        "long-rotor: balancer.mass; else 2 m/M: both planes move alike, (9)-(13) with chi = 0"},
       {"beta, phase of the unbalance; chi", "rotor.eccentricity_angle; rotor.tilt.misalignment"},
       {"k_22, c_22; J_t, J_p", "rotor.tilt: stiffness, damping, transverse_inertia, polar_inertia"},
       {"z_i", "balancer.plane"},
       {"epsilon/R", "rotor.eccentricity"},
       {"c = 0.01 per bearing, (20)", "rotor.damping = 2 c = 0.02"},
       {"c_b bar = 0.01, (20)", "balancer.drag"},
       {"Omega", "speed.speed"},
       {"alpha_1, alpha_2 = pi/2, -pi/2, at rest", "initial.phi"},
       {"A bar, (23)", "mean distance of the shaft from the axis at z = 1 and -1; without tilt of the rotor's centre"}},
      figure_11()};
  p.rows.push_back({"(22)",
                    "critical mass of a ball, 2 m_c/M",
                    "",
                    formula,
                    {},
                    {},
                    [](const Study& s, const RunOptions&) { return least_mass(s); },
                    "",
                    [](const Study& s) { return exactly(2.0 * s.parameters.eccentricity / 4.0); }});
  p.rows.push_back(of_long_rotor("(22)", "critical mass m_c/M for epsilon = chi = 0.005, beta = 1", print,
                                 {0.00261, 5e-6}, {}, [](const Study& s, const RunOptions&) { return least_mass(s); }));
  // Number 3: after X, Y and backward whirl.
  p.rows.push_back({"(19)",
                    "critical speed, conical",
                    "",
                    formula,
                    {},
                    {},
                    [](const Study& s, const RunOptions&) { return critical_speed(s, 3); },
                    "",
                    [](const Study& s) {
                      const model::Tilt& t = s.parameters.tilt;
                      return exactly(std::sqrt(t.stiffness[0][1] / (t.transverse_inertia - t.polar_inertia)));
                    },
                    "long-rotor"});
  append(p.rows, figure_12());
  append(p.rows, charts_of_2008());
  return p;
}

}  // namespace equipoise

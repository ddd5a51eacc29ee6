// The table: an entry a publication. To add one, add its entry, its study and its reference.
#include <algorithm>

#include <fmt/format.h>

#include "equipoise/literature/paper_files.hpp"
#include "equipoise/publications/measures.hpp"
#include "equipoise/publications/publication.hpp"

namespace equipoise {

namespace {

using enum KnownBy;
using namespace measures;

constexpr const char* tilts = "needs a rotor that tilts, with balls in two planes";
constexpr const char* tilts_here = "needs a rotor that tilts";
constexpr const char* reversed =
    "their code has the ball's coupling to the rotor's acceleration with the wrong sign, which runs the balls' creep "
    "backwards";

Estimate by_formula(double value) { return {value, 0.0}; }

// Figures of 11: axes and reading, 2 % of the axis, as noted when the plots were read.
std::vector<PublicationRow> figure_11() {
  const std::vector<std::string> second{"speed.speed=2.5", "rotor.eccentricity=0.01", "balancer.mass=0.01"};
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
      {"fig. 11 (ii)",
       "highest deflection at the end",
       "",
       plot,
       {0.143, 0.003},
       second,
       nullptr,
       "balance breaks up by a conical motion, which grows from rounding: needs a rotor that tilts"},
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

Publication jeffcott() {
  Publication p{"jeffcott-1919",
                "Jeffcott's rotor",
                "H. H. Jeffcott. The lateral vibration of loaded shafts in the neighbourhood of a whirling speed. "
                "Philosophical Magazine (6) 37 (1919), 304-314",
                "nothing; the formula is in every textbook: r = lambda Omega^2/|kappa - Omega^2 + i zeta Omega|",
                "jeffcott-1919",
                {{"eccentricity e, stiffness k, damping c, mass M",
                  "rotor.eccentricity, units in which k = M = 1, rotor.damping = c/sqrt(k M)"},
                 {"spin speed omega/sqrt(k/M)", "speed.speed"}},
                {}};
  for (const char* speed : {"0.5", "0.9", "1", "1.1", "2", "5"})
    p.rows.push_back({"formula",
                      "deflection without balls",
                      "",
                      formula,
                      {},
                      {std::string("speed.speed=") + speed},
                      [](const Study& s, const RunOptions&) { return settled_without_balls(s); },
                      "",
                      [](const Study& s) { return by_formula(jeffcott_radius(s.parameters, s.speed.speed)); }});
  return p;
}

Publication sommerfeld() {
  return {
      "sommerfeld-1902",
      "Sommerfeld's effect",
      "A. Sommerfeld. Beitraege zum dynamischen Ausbau der Festigkeitslehre. Zeitschrift des Vereins deutscher "
      "Ingenieure 46 (1902), 391-394; V. O. Kononenko. Vibrating Systems with a Limited Power Supply. Iliffe (1969)",
      "neither of them; the balance of torques of a rotor that circles evenly: tau(w) = zeta w r(w)^2, with Jeffcott's "
      "r",
      "sommerfeld-1902",
      {{"motor's torque L(w)", "speed.torque: stall - stall w/no_load_speed"}, {"vibration torque", "zeta w r^2"}},
      {{"balance of torques",
        "speed at which a weak motor hangs, below the critical speed",
        "",
        formula,
        {},
        {},
        [](const Study& s, const RunOptions&) { return settled_speed(s, 6000.0); },
        "",
        [](const Study& s) { return by_formula(sommerfeld_speed(s, 0.0, 1.0)); }},
       {"balance of torques",
        "the same, with six tenths of the torque",
        "",
        formula,
        {},
        {"speed.torque={stall=0.0006, no_load_speed=3.0}"},
        [](const Study& s, const RunOptions&) { return settled_speed(s, 6000.0); },
        "",
        [](const Study& s) { return by_formula(sommerfeld_speed(s, 0.0, 1.0)); }},
       {"balance of torques",
        "speed of a stronger motor, above it",
        "",
        formula,
        {},
        {"speed.torque={stall=0.01, no_load_speed=3.0}"},
        [](const Study& s, const RunOptions&) { return settled_speed(s, 6000.0); },
        "",
        [](const Study& s) { return by_formula(sommerfeld_speed(s, 1.5, 3.0)); }}}};
}

Publication rodrigues_2008() {
  Publication p{
      "rodrigues-2008",
      "Rodrigues, Champneys, Friswell and Wilson 2008",
      "D. J. Rodrigues, A. R. Champneys, M. I. Friswell, R. E. Wilson. Automatic two-plane balancing for rigid "
      "rotors. International Journal of Non-Linear Mechanics 43 (2008), 527",
      "the preprint of 2007",
      "rodrigues-2008",
      {{"m/M, of each of four balls", "balancer.mass = 2 m/M: both planes move alike, (9)-(13) with chi = 0"},
       {"epsilon/R", "rotor.eccentricity"},
       {"c = 0.01 per bearing, (20)", "rotor.damping = 2 c = 0.02"},
       {"c_b bar = 0.01, (20)", "balancer.drag"},
       {"Omega", "speed.speed"},
       {"alpha_1, alpha_2 = pi/2, -pi/2, at rest", "initial.phi"},
       {"A bar, (23), without tilt", "distance of the rotor's centre"}},
      figure_11()};
  p.rows.push_back({"(22)",
                    "critical mass of a ball, 2 m_c/M",
                    "",
                    formula,
                    {},
                    {},
                    [](const Study& s, const RunOptions&) { return least_mass(s); },
                    "",
                    [](const Study& s) { return by_formula(2.0 * s.parameters.eccentricity / 4.0); }});
  p.rows.push_back({"(22)",
                    "critical mass m_c/M for epsilon = chi = 0.005, beta = 1",
                    "",
                    print,
                    {0.00261, 5e-6},
                    {},
                    nullptr,
                    tilts});
  p.rows.push_back({"fig. 12 (a)",
                    "highest deflection, epsilon = chi = 0.005, Omega = 3.5",
                    "",
                    plot,
                    {0.0255, 0.0005},
                    {},
                    nullptr,
                    tilts});
  return p;
}

Publication rodrigues_enoc() {
  return {"rodrigues-enoc",
          "Rodrigues and others, ENOC 2008: supports that differ",
          "D. J. Rodrigues, A. R. Champneys, M. I. Friswell, R. E. Wilson. A consideration of support asymmetry in an "
          "automatic ball balancing system. ENOC 2008",
          "the paper",
          "rodrigues-2011",
          {{"K_X = diag(1, 9), K_Y = diag(5, 45), (7)", "rotor.stiffness = [1, 5]: what does not tilt"},
           {"C = 0.02 K, (4)", "rotor.damping = [0.02, 0.1]"}},
          {{"(7)",
            "first critical speed, without tilt",
            "",
            print,
            {1.0, 0.005},
            {},
            [](const Study& s, const RunOptions&) { return resonance(s, 0.5, 1.5); }},
           {"(7)",
            "third critical speed, without tilt",
            "",
            print,
            {2.24, 0.005},
            {},
            [](const Study& s, const RunOptions&) { return resonance(s, 1.6, 3.0); }},
           {"(7)",
            "second critical speed, conical",
            "",
            print,
            {1.81, 0.005},
            {},
            nullptr,
            "needs a rotor that tilts; theirs leave the gyroscopic coupling out"},
           {"(7)",
            "fourth critical speed, conical",
            "",
            print,
            {4.05, 0.005},
            {},
            nullptr,
            "needs a rotor that tilts; theirs leave the gyroscopic coupling out"}}};
}

Publication rodrigues_virm() {
  return {
      "rodrigues-virm",
      "Rodrigues and others, VIRM 9: device asymmetries and run-up",
      "D. J. Rodrigues, A. R. Champneys, M. I. Friswell, R. E. Wilson. Device asymmetries and the effect of the rotor "
      "run-up in a two-plane automatic ball balancing system. VIRM 9, Exeter",
      "the paper",
      "",
      {{"Omega = Omega_max t^n/(t_half^n + t^n), (8)", "speed.profile = \"hill\": final, half_time, exponent"}},
      {{"fig. 5", "highest deflection, Hill (3, 10, 3)", "", plot, {3.4e-4, 7e-6}, {}, nullptr, tilts},
       {"fig. 5", "hump near t = 405", "", plot, {2.35e-4, 7e-6}, {}, nullptr, tilts},
       {"fig. 5", "least rate of a ball", "", plot, {-2.45, 0.05}, {}, nullptr, tilts}}};
}

Publication rodrigues_2010() {
  return {
      "rodrigues-2010",
      "Rodrigues and others 2010: experiment",
      "D. J. Rodrigues, A. R. Champneys, M. I. Friswell, R. E. Wilson. Experimental investigation of a single-plane "
      "automatic balancing mechanism for a rigid rotor",
      "the preprint; table 3's stiffness is half of what its figures follow from",
      "",
      {{"c_b bar = c_b/(m R^2 Omega_cyl)", "balancer.drag"}},
      {{"fig. 7",
        "critical speed, cylindrical along Y, measured",
        "rpm",
        print,
        {1415.0, 0.5},
        {},
        nullptr,
        tilts_here},
       {"fig. 7",
        "critical speed, cylindrical along X, measured",
        "rpm",
        print,
        {1675.0, 0.5},
        {},
        nullptr,
        tilts_here},
       {"fig. 7", "critical speed, conical along Y, measured", "rpm", print, {1944.0, 0.5}, {}, nullptr, tilts_here},
       {"fig. 7", "critical speed, conical along X, measured", "rpm", print, {2310.0, 0.5}, {}, nullptr, tilts_here},
       {"fig. 8",
        "critical speed, cylindrical along Y, simulated",
        "rpm",
        print,
        {1455.0, 0.5},
        {},
        nullptr,
        tilts_here},
       {"fig. 8",
        "critical speed, cylindrical along X, simulated",
        "rpm",
        print,
        {1700.0, 0.5},
        {},
        nullptr,
        tilts_here},
       {"fig. 8", "critical speed, conical along Y, simulated", "rpm", print, {1920.0, 0.5}, {}, nullptr, tilts_here},
       {"fig. 8", "critical speed, conical along X, simulated", "rpm", print, {2280.0, 0.5}, {}, nullptr, tilts_here},
       {"fig. 13", "deflection at 1200 rpm, two balls", "mm", plot, {0.11, 0.005}, {}, nullptr, tilts_here},
       {"fig. 13", "deflection at 3000 rpm, two balls", "mm", plot, {0.0135, 0.0005}, {}, nullptr, tilts_here}}};
}

Publication rodrigues_2011() {
  return {
      "rodrigues-2011",
      "Rodrigues and others 2011: symmetry breaking",
      "D. J. Rodrigues, A. R. Champneys, M. I. Friswell, R. E. Wilson. Two-plane automatic balancing: a symmetry "
      "breaking analysis. International Journal of Non-Linear Mechanics 46 (2011), 1139-1154",
      "the accepted manuscript",
      "rodrigues-2011",
      {{"supports of (43): K_X = diag(1, 9), K_Y = diag(5, 45)", "rotor.stiffness = [1, 5]: what does not tilt"},
       {"C = 0.02 K", "rotor.damping = [0.02, 0.1]"},
       {"Omega = Omega_max t^n/(t_half^n + t^n), (45)", "speed.profile = \"hill\": final, half_time, exponent"}},
      {{"(43)",
        "first peak of the response, without tilt",
        "",
        print,
        {1.0, 0.005},
        {},
        [](const Study& s, const RunOptions&) { return resonance(s, 0.5, 1.5); }},
       {"(43)",
        "third peak of the response, without tilt",
        "",
        print,
        {2.24, 0.005},
        {},
        [](const Study& s, const RunOptions&) { return resonance(s, 1.6, 3.0); }},
       {"(43)", "second peak of the response, conical", "", print, {1.65, 0.005}, {}, nullptr, tilts_here},
       {"(43)", "fourth peak of the response, conical", "", print, {3.79, 0.005}, {}, nullptr, tilts_here},
       {"fig. 14 (c)", "speed from which balance is stable", "", print, {3.387, 5e-4}, {}, nullptr, tilts},
       {"fig. 14 (d)", "period of the limit cycle at Omega = 3.386", "", print, {7.081, 0.0055}, {}, nullptr, tilts},
       {"fig. 14 (d)", "period of the limit cycle at Omega = 3.127", "", print, {9.856, 0.0033}, {}, nullptr, tilts},
       {"fig. 16", "highest deflection, Hill (3.6, 200, 3)", "", plot, {8e-4, 2e-5}, {}, nullptr, tilts},
       {"fig. 16", "least rate of a ball", "", plot, {-1.07, 0.02}, {}, nullptr, tilts}}};
}

Publication mirkov() {
  const auto share = [](const Study& s, const RunOptions& o) { return balanced_percent(s, o); };
  const auto fate = [&](const char* quantity, double percent, std::vector<std::string> settings) {
    constexpr double wilson = 6.1;  // 95 % of 60 pairs that all go one way
    return PublicationRow{"random pairs of balls", quantity, "%",     code, {percent, wilson},
                          std::move(settings),     share,    reversed};
  };
  const std::vector<std::string> thin{"balancer.drag=0.0001 N m s"};
  return {
      "mirkov-2026",
      "Mirkov and others 2026",
      "N. Mirkov, L. Pezo, J. Jovanovic, S. Balac, J. Pekovic. Global dynamics and stability of automatic ball "
      "balancers "
      "under anisotropy and non-ideal excitation. Modelling 7 (2026), 135",
      "only its code, abb_system.py at commit 9c90368; neither text nor figures were seen. Its numbers here are those "
      "of that code, run with its defaults on 60 random pairs of ball angles",
      "mirkov-2026",
      {{"M_tot + m_un = 10 kg + 0.05 kg", "rotor.mass"},
       {"m_un e", "rotor.unbalance"},
       {"I_rot + m_un e^2 - (m_un e)^2/M", "rotor.inertia"},
       {"kx = ky, bx = by", "rotor.stiffness, rotor.damping"},
       {"m_b, r, D", "balancer.mass, balancer.race_radius, balancer.drag"},
       {"prescribed speed", "speed.speed"},
       {"a - b psi'", "speed.torque: constant, slope"}},
      {{"without balls",
        "deflection at 12 rad/s",
        "um",
        code,
        {106.9, 0.05},
        {},
        [](const Study& s, const RunOptions&) { return settled_without_balls_um(s); }},
       fate("starts that end balanced at 12 rad/s", 0.0, {}),
       fate("the same, D = 0.0001 N m s", 0.0, thin),
       fate("the same, with a motor of 5 N m - 0.5 N m s psi'", 0.0,
            {"speed={profile='torque', torque={constant='5 N m', slope='-0.5 N m s'}}", "numerics.horizon=30000 s"}),
       fate("the same at 3 rad/s, below the critical speed", 100.0,
            {"speed.speed=3 rad/s", "sampling.starts=8", "numerics.horizon=1000 s"}),
       {"linearised",
        "slowest rate near balance at 12 rad/s",
        "1/s",
        code,
        {0.0015294, 5e-8},
        {},
        [](const Study& s, const RunOptions&) { return rate_near_balance(s, 0); },
        reversed},
       {"linearised",
        "second rate near balance at 12 rad/s",
        "1/s",
        code,
        {0.012229, 5e-7},
        {},
        [](const Study& s, const RunOptions&) { return rate_near_balance(s, 1); },
        reversed},
       {"linearised",
        "balance stable above (theirs: below), D = 0.0001 N m s",
        "rad/s",
        code,
        {2.79, 0.01},
        thin,
        [](const Study& s, const RunOptions&) { return stable_from(s, 2.0, 6.0); },
        reversed}}};
}

}  // namespace

const std::vector<Publication>& publications() {
  static const std::vector<Publication> all{jeffcott(),       sommerfeld(),     rodrigues_2008(), rodrigues_enoc(),
                                            rodrigues_virm(), rodrigues_2010(), rodrigues_2011(), mirkov()};
  return all;
}

const Publication* find_publication(std::string_view name) {
  const auto found =
      std::find_if(publications().begin(), publications().end(), [&](const Publication& p) { return p.name == name; });
  return found == publications().end() ? nullptr : &*found;
}

Study study_of(const Publication& publication, const PublicationRow& row) {
  const std::string file = fmt::format("publications/{}.toml", publication.study);
  return parse_study(std::string(embedded::paper_files.find(file)), "studies/" + file, row.settings);
}

}  // namespace equipoise

// The table: an entry a publication. To add one, add its entry, its study and its reference.
#include <algorithm>

#include <fmt/format.h>

#include "equipoise/extras/literature/paper_files.hpp"
#include "equipoise/extras/publications/measures.hpp"
#include "equipoise/extras/publications/publication.hpp"
#include "equipoise/extras/publications/rodrigues.hpp"

namespace equipoise {

namespace {

using enum KnownBy;
using namespace measures;

constexpr const char* reversed =
    "their code has the ball's coupling to the rotor's acceleration with the wrong sign, which runs the balls' creep "
    "backwards";

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
                      [](const Study& s) { return exactly(jeffcott_radius(s.parameters, s.speed.speed)); }});
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
        [](const Study& s) { return exactly(sommerfeld_speed(s, 0.0, 1.0)); }},
       {"balance of torques",
        "the same, with six tenths of the torque",
        "",
        formula,
        {},
        {"speed.torque={stall=0.0006, no_load_speed=3.0}"},
        [](const Study& s, const RunOptions&) { return settled_speed(s, 6000.0); },
        "",
        [](const Study& s) { return exactly(sommerfeld_speed(s, 0.0, 1.0)); }},
       {"balance of torques",
        "speed of a stronger motor, above it",
        "",
        formula,
        {},
        {"speed.torque={stall=0.01, no_load_speed=3.0}"},
        [](const Study& s, const RunOptions&) { return settled_speed(s, 6000.0); },
        "",
        [](const Study& s) { return exactly(sommerfeld_speed(s, 1.5, 3.0)); }}}};
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
      "of that code, run with its defaults on 60 random pairs of ball angles. With nothing to drive it that system "
      "makes energy: 12 % of its own in a second, from balls that run at 5 and -3 rad/s, and 136 % with balls of 1 kg",
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
  const std::string file = fmt::format("publications/{}.toml", row.study ? row.study : publication.study);
  return parse_study(std::string(embedded::paper_files.find(file)), "studies/" + file, row.settings);
}

}  // namespace equipoise

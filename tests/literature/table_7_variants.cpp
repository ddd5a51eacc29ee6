// The list: laws by release first, then values other than the stated ones.
#include "table_7_variants.hpp"

#include <fmt/format.h>

namespace equipoise::table_7 {

namespace {

const char* name_of(BranchLaw law) {
  return law == BranchLaw::kinematic ? "kinematic" : law == BranchLaw::published ? "published" : "own-time";
}

std::string release_name(const Table7Protocol& p) {
  switch (p.release) {
    case Table7Release::at_hold_end:
      return "T1";
    case Table7Release::at_settling:
      return "T2";
    case Table7Release::at_fall_speed:
      return fmt::format("falling-{}", p.release_speed);
    case Table7Release::at_rise_speed:
      break;
  }
  if (p.release_speed == p.peak) return "T0";
  return p.release_speed == 0.0 ? "start" : fmt::format("rising-{}", p.release_speed);
}

class List {
 public:
  void add(Table7Protocol p, const std::string& departure = {}) {
    std::string name = fmt::format("rise {}, fall {}, released {}", name_of(p.rise), name_of(p.fall), release_name(p));
    if (!departure.empty()) name += ", " + departure;
    found.push_back({std::move(name), p});
  }

  // Two laws of the rise by two of the fall, released at the peak and on the way to it.
  void add_laws(Table7Protocol p, const std::string& departure) {
    for (BranchLaw rise : {BranchLaw::kinematic, BranchLaw::published})
      for (BranchLaw fall : {BranchLaw::kinematic, BranchLaw::own_time})
        for (double speed : {p.peak, 2.0, 0.0}) {
          p.rise = rise;
          p.fall = fall;
          p.release_speed = speed;
          add(p, departure);
        }
  }

  std::vector<Variant> found;
};

// The stated values under every law of either piece.
void add_stated(List& list) {
  for (BranchLaw rise : {BranchLaw::kinematic, BranchLaw::published})
    for (BranchLaw fall : {BranchLaw::kinematic, BranchLaw::own_time, BranchLaw::published}) {
      Table7Protocol p;
      p.rise = rise;
      p.fall = fall;
      // 1 and 1.5: psi' = 2 Omega then reaches the final 2 and the peak 3 under the published law.
      for (double speed : {0.0, 1.0, 1.5, 2.0, 2.2, 2.4, 2.6, 2.8, 2.9, 3.0}) {
        p.release_speed = speed;
        list.add(p);
      }
      p.release = Table7Release::at_hold_end;
      list.add(p);
      p.release = Table7Release::at_fall_speed;
      for (double speed : {2.8, 2.6, 2.4, 2.2}) {
        p.release_speed = speed;
        list.add(p);
      }
      p.release = Table7Release::at_settling;
      list.add(p);
    }
}

}  // namespace

std::vector<Variant> variants() {
  List list;
  add_stated(list);
  Table7Protocol p;
  p.durations = true;
  list.add_laws(p, "T0 T1 T2 lengths");
  p = {};
  for (auto [peak, final] : {std::pair{3.0, 2.2},
                             {3.0, 2.4},
                             {3.0, 2.6},
                             {2.4, 2.0},
                             {2.6, 2.0},
                             {4.0, 2.0},
                             {5.0, 2.0},
                             {4.0, 3.0},
                             {5.0, 3.0},
                             {3.0, 1.9}}) {
    p.peak = peak;
    p.final = final;
    list.add_laws(p, fmt::format("speeds {} and {}", peak, final));
  }
  p = {};
  for (double drag : {0.01, 0.03, 0.1, 0.25}) {
    p.drag = drag;
    list.add_laws(p, fmt::format("beta {}", drag));
  }
  p = {};
  for (double damping : {0.02, 0.25, 1.0}) {
    p.damping = damping;
    list.add_laws(p, fmt::format("zeta {}", damping));
  }
  p = {};
  for (double mass : {0.01, 0.025, 0.1}) {
    p.mass = mass;
    list.add_laws(p, fmt::format("mu {}", mass));
  }
  p = {};
  for (double eccentricity : {0.001, 0.005, 0.02, 0.05}) {
    p.eccentricity = eccentricity;
    list.add_laws(p, fmt::format("lambda {}", eccentricity));
  }
  return list.found;
}

}  // namespace equipoise::table_7

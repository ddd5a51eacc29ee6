// Halving cells, a trial ensemble in each.
#include "equipoise/discovery/family_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "equipoise/base/parallel.hpp"
#include "equipoise/discovery/drawn_source.hpp"
#include "equipoise/kernels/lane_kernels.hpp"

namespace equipoise {

namespace {

// Starts by which cells are judged: their own, the same for all.
constexpr std::uint64_t judging_seed = 0xa0761d6478bd642f;
constexpr std::size_t judged = 1024;
constexpr int most_halvings = 4;
// To follow a start that a cell's rule does not know costs as much as to decide so many.
constexpr double dear = 1000.0;
// Less is not worth another search.
constexpr double worth_it = 0.85;
// A cell that costs less is good enough; one that knows so little of what starts come to, halves would not know either.
constexpr double good_enough = 2.0, too_little_known = 0.05;

// What a start costs in a cell, in starts that are known at once, by halves of every axis too.
struct Judgement {
  double cost = 0.0, unknown = 0.0;  // unknown: the share of what its rule does not list
  std::vector<double> unlike;  // how much fates of its lower half differ from those of its upper half
};

struct Tried {
  FamilyCell cell;
  Judgement judgement;
};

class MeshMaker {
 public:
  MeshMaker(const StudyFamily& family, const DiscoverySettings& settings) : family_(family), settings_(settings) {}

  FamilyMesh run() {
    for (const FamilyBox& part : family_.parts()) {
      std::optional<Tried> whole = tried(part, nullptr);
      if (!whole || !divide(*std::move(whole), 0)) return stopped();
    }
    for (FamilyCell& cell : mesh_.cells) list(cell);
    return std::move(mesh_);
  }

 private:
  FamilyMesh stopped() {
    mesh_.stopped = true;
    return std::move(mesh_);
  }

  std::optional<Tried> tried(const FamilyBox& box, const FamilyCell* parent) {
    DiscoverySettings settings = settings_;
    if (parent) {
      settings.informed = true;
      settings.seeds.clear();
      for (const Attractor& a : parent->discovery.catalogue.attractors())
        if (a.id != balanced_id && a.motion.state.size() > 0)
          settings.seeds.emplace_back(a.motion.state.begin(), a.motion.state.end());
      settings.hints = parent->discovery.hints;
    }
    Discovery found = discover(family_, box, settings);
    if (found.stopped) return std::nullopt;
    Tried result{{box, family_.at(family_.values_at(box.centre())).system(), std::move(found), {}}, {}};
    if (!judge(result)) return std::nullopt;
    return result;
  }

  // Halves while it pays, along the axis whose halves differ most.
  bool divide(Tried whole, int depth) {
    const Judgement& judgement = whole.judgement;
    if (depth < most_halvings && judgement.cost > good_enough && judgement.unknown < too_little_known) {
      const std::size_t axis = axis_of(whole);
      std::array<std::optional<Tried>, 2> halves;
      for (int side = 0; side < 2; ++side) {
        FamilyBox box = whole.cell.box;
        (side ? box.low : box.high)[axis] = 0.5 * (box.low[axis] + box.high[axis]);
        halves[side] = tried(box, &whole.cell);
        if (!halves[side]) return false;
      }
      const double both = 0.5 * (halves[0]->judgement.cost + halves[1]->judgement.cost);
      if (both < worth_it * whole.judgement.cost) {
        for (auto& half : halves)
          if (!divide(*std::move(half), depth + 1)) return false;
        return true;
      }
    }
    mesh_.cells.push_back(std::move(whole.cell));
    return true;
  }

  std::size_t axis_of(const Tried& whole) const {
    const std::vector<double>& unlike = whole.judgement.unlike;
    return static_cast<std::size_t>(std::max_element(unlike.begin(), unlike.end()) - unlike.begin());
  }

  // Decides starts of the cell by its rule.
  bool judge(Tried& result) {
    FamilyCell& cell = result.cell;
    const DrawnSource source(family_, cell.box, settings_.stop);
    SpunUp starts;
    if (!source.make(judging_seed, 0, judged, starts)) return false;
    const double horizon = *source.middle().numerics.horizon;
    std::vector<const OwnRotor*> own;
    std::vector<double> begins;
    for (std::size_t i = 0; i < judged; ++i) {
      cell.discovery.place(starts.rotors[i]);
      own.push_back(&starts.rotors[i]);
    }
    LaneTask task = source.last_task();
    task.end = source.settled() + horizon;
    task.count = judged;
    task.states = starts.states.data();
    task.begins = starts.begins.data();
    task.own = own.data();
    task.stop = settings_.stop;
    std::vector<Fate> fates(judged);
    if (!decide_lanes(task, cell.discovery.rule, fates, nullptr)) return false;
    double time = 0.0, unknown = 0.0;
    for (std::size_t i = 0; i < judged; ++i) {
      time += fates[i].time - starts.begins[i];
      unknown += fates[i].outcome == Outcome::attracted && fates[i].attractor == 0;
    }
    // Ones that are known at once take about this long.
    constexpr double soon = 200.0;
    result.judgement.unknown = unknown / judged;
    result.judgement.cost = time / judged / soon + dear * result.judgement.unknown;
    for (std::size_t k = 0; k < family_.size(); ++k) result.judgement.unlike.push_back(unlikeness(fates, source, k));
    return true;
  }

  // By the study's order of draws: which half of the box's axis `k` a start drew.
  double unlikeness(const std::vector<Fate>& fates, const DrawnSource& source, std::size_t k) const {
    std::array<double, 2> count{}, time{};
    for (std::size_t i = 0; i < fates.size(); ++i) {
      const int side = source.place(i)[k] >= 0.5;
      ++count[side];
      time[side] += fates[i].time + (fates[i].attractor == 0 ? dear : 0.0);
    }
    return std::fabs(std::log((time[0] / count[0] + 1.0) / (time[1] / count[1] + 1.0)));
  }

  // Gives the cell's attractors their identifiers in the mesh's catalogue.
  void list(FamilyCell& cell) {
    for (const Attractor& a : cell.discovery.catalogue.attractors()) {
      const MotionName name{a.name, a.alias, a.id < first_free_id ? a.id : 0};
      const int id = mesh_.catalogue.add(name, a.motion, a.continuum);
      cell.ids.resize(std::max(cell.ids.size(), static_cast<std::size_t>(a.id) + 1));
      cell.ids[static_cast<std::size_t>(a.id)] = id;
    }
  }

  const StudyFamily& family_;
  const DiscoverySettings& settings_;
  FamilyMesh mesh_;
};

}  // namespace

std::size_t FamilyMesh::index(std::span<const double> fractions) const {
  for (std::size_t c = 0; c + 1 < cells.size(); ++c)
    if (cells[c].box.holds(fractions)) return c;
  return cells.size() - 1;
}

std::optional<double> FamilyMesh::largest_radius(const StudyFamily& family, int attractor,
                                                 std::span<const double> fractions) const {
  const FamilyCell& cell = cells[index(fractions)];
  const auto own = std::find(cell.ids.begin(), cell.ids.end(), attractor);
  if (attractor <= 0 || own == cell.ids.end()) return std::nullopt;
  const auto features = cell.discovery.trends.features(static_cast<int>(own - cell.ids.begin()),
                                                       family.coordinates(cell.box, fractions));
  return features ? std::optional((*features)[equipoise::largest_radius]) : std::nullopt;
}

FamilyMesh discover_mesh(const StudyFamily& family, const DiscoverySettings& settings) {
  return MeshMaker(family, settings).run();
}

}  // namespace equipoise

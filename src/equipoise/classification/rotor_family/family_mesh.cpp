// Halves cells and runs a trial ensemble in each.
#include "equipoise/classification/rotor_family/family_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <optional>
#include <utility>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/attractors/periodic_orbits/stroboscopic_section.hpp"
#include "equipoise/classification/attractor_search/search.hpp"
#include "equipoise/classification/rotor_family/drawn_source.hpp"
#include "equipoise/core/running/parallel.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"

namespace equipoise {

namespace {

// Starts that judge cells: from a seed of their own, the same for all cells.
constexpr std::uint64_t judging_seed = 0xa0761d6478bd642f;
constexpr std::size_t judged = 1024;
constexpr int most_halvings = 10;
// Costs are in starts that the rule knows at once, each of about this many time units.
constexpr double soon = 200.0;
// The cost of a start that a cell's rule does not know, and of searching a cell.
constexpr double dear = 2000.0, a_search = 3e5;
// Of one rotor's starts, this many on average pay that cost.
constexpr double met_by_a_rotor = 2.0;
// Cells are halved while two more searches cost less than this share of what their starts cost.
constexpr double worth_two_searches = 0.5;
// Halves must be better by this factor, except in the first halvings: a part that knows almost nothing must become
// small before it knows more.
constexpr double better = 0.85, much_to_gain = 25.0;
constexpr int at_first = 3;
// This many of the starts left open by the horizon are followed one by one, for the horizon's time again but at most
// for lasting_chaos. If fewer than half end in a motion, all stay open. Otherwise followed_on starts are followed on
// together.
constexpr std::size_t looked_at = 8, followed_on = 64;

// The mean cost of a start in a cell, and by halves of every axis.
struct Judgement {
  double cost = 0.0;
  std::vector<double> unlike;  // how much costs of the lower and upper half differ
  bool follows_open = true;    // see FamilyCell::follows_open
};

template <class Bytes, Like<Judgement> T>
void members(Bytes& b, T& j) {
  b(j.cost, j.unlike, j.follows_open);
}

struct Tried {
  FamilyCell cell;
  Judgement judgement;
};

class MeshMaker {
 public:
  MeshMaker(const StudyFamily& family, const FamilyStarts& starts, const AttractorSearchSettings& settings)
      : family_(family), starts_(starts), settings_(settings) {
    settings_.starts = std::min(settings.starts, starts.count);
    if (settings.progress)
      settings_.progress = [this, &settings](const Progress& progress) {
        const std::lock_guard lock(telling_);
        settings.progress(progress);
      };
  }

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
    AttractorSearchSettings settings = settings_;
    if (parent) {
      settings.mode = SearchMode::warm;
      settings.warm_start_states = parent->search.warm_start_states;
      settings.warm_start_levels = parent->search.warm_start_levels;
    }
    const model::System middle = family_.at(family_.values_at(box.centre())).system();
    AttractorSearch found = search_attractors(family_, box, settings);
    if (found.stopped) return std::nullopt;
    Tried result{{box, std::move(found), {}}, {}};
    if (SearchPlan(middle, settings, true).balance_alone) return result;
    NotePage notes(settings_.notes, "judging\n" + search_key(box, settings));
    result.judgement = notes.answer("cost", settings_.stop, [&] { return judge(result.cell); });
    if (is_set(settings_.stop)) return std::nullopt;
    notes.finish();
    result.cell.follows_open = result.judgement.follows_open;
    return result;
  }

  // Halves a cell while it pays, along the axis whose halves differ most.
  bool divide(Tried whole, int depth) {
    const double starts = starts_.count * volume(whole.cell.box), to_gain = starts * whole.judgement.cost / a_search;
    if (depth < most_halvings && 2.0 < worth_two_searches * to_gain) {
      const std::size_t axis = axis_of(whole);
      std::array<std::optional<Tried>, 2> halves;
      in_parallel(settings_.threads, 2, [&](std::size_t side) {
        FamilyBox box = whole.cell.box;
        (side ? box.low : box.high)[axis] = 0.5 * (box.low[axis] + box.high[axis]);
        halves[side] = tried(box, &whole.cell);
      });
      if (!halves[0] || !halves[1]) return false;
      const double both = 0.5 * (halves[0]->judgement.cost + halves[1]->judgement.cost);
      if (both < better * whole.judgement.cost || (depth < at_first && to_gain > much_to_gain)) {
        for (auto& half : halves)
          if (!divide(*std::move(half), depth + 1)) return false;
        return true;
      }
    }
    mesh_.cells.push_back(std::move(whole.cell));
    return true;
  }

  static double volume(const FamilyBox& box) {
    double volume = 1.0;
    for (std::size_t k = 0; k < box.low.size(); ++k) volume *= box.high[k] - box.low[k];
    return volume;
  }

  std::size_t axis_of(const Tried& whole) const {
    const std::vector<double>& unlike = whole.judgement.unlike;
    return static_cast<std::size_t>(std::max_element(unlike.begin(), unlike.end()) - unlike.begin());
  }

  // Decides starts of the cell by its rule. Worthless if stopped.
  Judgement judge(const FamilyCell& cell) const {
    Judgement judgement;
    const DrawnSource source(family_, cell.box, settings_.stop);
    SpunUp starts;
    if (!source.make(judging_seed, 0, judged, starts)) return judgement;
    const double horizon = *source.middle().numerics.horizon;
    for (OwnRotor& rotor : starts.rotors) cell.search.place(rotor);
    const std::vector<const OwnRotor*> own = pointers_to(starts.rotors);
    BatchTask task = source.last_task();
    task.end = source.settled() + horizon;
    task.take(starts.states, own, starts.begins);
    task.stop = settings_.stop;
    std::vector<Outcome> outcomes(judged);
    if (!classify_batch(task, cell.search.rule, outcomes, nullptr)) return judgement;
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < judged; ++i)
      if (outcomes[i].kind == OutcomeKind::undecided) open.push_back(i);
    judgement.follows_open = settle(starts, outcomes, open, std::min(horizon, lasting_chaos));
    if (is_set(settings_.stop)) return judgement;
    if (judgement.follows_open && !follow_on(task, open, cell, starts, outcomes)) return judgement;
    const double unknown = dear * std::min(1.0, met_by_a_rotor * starts_.rotors / starts_.count);
    std::vector<double> costs;
    for (std::size_t i = 0; i < judged; ++i) {
      const bool is_open = outcomes[i].kind == OutcomeKind::undecided;
      const bool followed =
          is_open ? judgement.follows_open : outcomes[i].kind == OutcomeKind::attracted && outcomes[i].attractor == 0;
      costs.push_back((outcomes[i].time - starts.begins[i]) / soon + (followed ? unknown : 0.0));
      judgement.cost += costs.back() / judged;
    }
    for (std::size_t k = 0; k < family_.size(); ++k) judgement.unlike.push_back(unlikeness(costs, source, k));
    return judgement;
  }

  // Whether starts left open by the horizon mostly end in a motion soon, judged by the first of them.
  bool settle(const SpunUp& starts, const std::vector<Outcome>& outcomes, const std::vector<std::size_t>& open,
              double patience) const {
    const std::size_t count = std::min(open.size(), looked_at);
    std::vector<char> settles(count);
    in_parallel(settings_.threads, count, [&](std::size_t k) {
      const OwnRotor& own = starts.rotors[open[k]];
      const int size = own.system.dimension();
      const Eigen::Map<const Eigen::VectorXd> z(&starts.states[open[k] * static_cast<std::size_t>(size)], size);
      const auto on_section = at_next_section(own.system, z, own.segment.psi_at(outcomes[open[k]].time));
      const auto motion = motion_from(own.system, on_section.value_or(z), patience, settings_.stop);
      settles[k] = motion && motion->stable;
    });
    return 2 * std::count(settles.begin(), settles.end(), 1) >= static_cast<std::ptrdiff_t>(count);
  }

  // Follows open starts on, as the cell will.
  bool follow_on(BatchTask task, const std::vector<std::size_t>& open, const FamilyCell& cell, const SpunUp& starts,
                 std::vector<Outcome>& outcomes) const {
    const std::size_t count = std::min(open.size(), followed_on), size = starts.states.size() / judged;
    if (count == 0) return true;
    std::vector<double> states;
    std::vector<OwnRotor> rotors;
    for (std::size_t k = 0; k < count; ++k) {
      states.insert(states.end(), &starts.states[open[k] * size], &starts.states[open[k] * size] + size);
      rotors.push_back(starts.rotors[open[k]]);
    }
    const double horizon = task.end;
    task.end += FamilyCell::further;
    for (OwnRotor& rotor : rotors) rotor.end = task.end;
    const std::vector<const OwnRotor*> own = pointers_to(rotors);
    const std::vector<double> begins(count, horizon);
    task.take(states, own, begins);
    std::vector<Outcome> later(count);
    if (!classify_batch(task, cell.search.rule, later, nullptr)) return false;
    // These outcomes represent those of all open starts.
    for (std::size_t k = 0; k < open.size(); ++k) outcomes[open[k]] = later[k % count];
    return true;
  }

  // How much the costs of starts in the two halves of axis `k` differ.
  static double unlikeness(const std::vector<double>& costs, const DrawnSource& source, std::size_t k) {
    std::array<double, 2> count{}, sum{};
    for (std::size_t i = 0; i < costs.size(); ++i) {
      const int side = source.place(i)[k] >= 0.5;
      ++count[side];
      sum[side] += costs[i];
    }
    return std::fabs(std::log((sum[0] / count[0] + 1.0) / (sum[1] / count[1] + 1.0)));
  }

  // Gives the cell's attractors their identifiers in the mesh's catalogue.
  void list(FamilyCell& cell) {
    for (const Attractor& a : cell.search.catalogue.attractors()) {
      const MotionName name{a.name, a.alias, a.id < first_free_id ? a.id : 0};
      const int id = mesh_.catalogue.add(name, a.motion, a.continuum);
      cell.ids.resize(std::max(cell.ids.size(), static_cast<std::size_t>(a.id) + 1));
      cell.ids[static_cast<std::size_t>(a.id)] = id;
    }
  }

  const StudyFamily& family_;
  const FamilyStarts starts_;
  AttractorSearchSettings settings_;
  std::mutex telling_;  // for progress: two searches run at once
  FamilyMesh mesh_;
};

}  // namespace

std::size_t FamilyMesh::index(std::span<const double> fractions) const {
  for (std::size_t c = 0; c + 1 < cells.size(); ++c)
    if (cells[c].box.holds(fractions)) return c;
  return cells.size() - 1;
}

FamilyMesh search_attractor_mesh(const StudyFamily& family, const FamilyStarts& starts,
                                 const AttractorSearchSettings& settings) {
  return MeshMaker(family, starts, settings).run();
}

}  // namespace equipoise

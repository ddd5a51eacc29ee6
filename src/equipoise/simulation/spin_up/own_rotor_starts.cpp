// Takes starts in groups whose drives have the same pieces, piece by piece on lanes.
#include "equipoise/simulation/spin_up/spin_up.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "equipoise/machine/model/held_state.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"
#include "equipoise/simulation/spin_up/start_source.hpp"

namespace equipoise {

namespace {

struct Prescribed {
  std::size_t place;  // among all starts
  const OwnRotorStart* own;
  std::vector<model::Segment> segments;
  std::vector<model::System> systems{};  // over each segment
  std::size_t free = 0;                  // first segment that is not clamped

  double tolerance() const { return own->study.numerics.tolerance.value_or(default_basin_tolerance); }
  double settled() const { return segments.back().begin; }
  OwnRotor rotor(std::size_t k) const { return {systems[k], segments[k], segments[k].end}; }
};

using Shape = std::pair<std::size_t, std::size_t>;  // segments, and clamped ones: starts with equal numbers run side by
                                                    // side

bool advance(std::vector<Prescribed*>& group, std::size_t k, bool held, std::vector<double>& states,
             std::vector<Fate>& fates, TransientTable* table, const StopFlag* stop) {
  std::vector<OwnRotor> rotors;
  for (const Prescribed* p : group) rotors.push_back(p->rotor(k));
  const std::vector<const OwnRotor*> own = pointers_to(rotors);
  const model::System& first = rotors.front().system;
  BatchTask task = batch_task(first);
  task.segment = rotors.front().segment;
  task.end = rotors.front().end;
  task.held = held;
  if (held) task.system = &first;
  // Clamped balls cost little to follow, and the state at release decides much.
  constexpr double held_tolerance = 1e-3;
  task.tolerance = group.front()->tolerance() * (held ? held_tolerance : 1.0);
  task.take(states, own, {});
  task.transients = table;
  task.stop = stop;
  return advance_batch(task, fates);
}

class PrescribedGroup {
 public:
  PrescribedGroup(std::vector<Prescribed*> group, SpunUp& spun, TransientTable* transients, const StopFlag* stop)
      : group_(std::move(group)), spun_(spun), transients_(transients), stop_(stop), fates_(group_.size()) {
    if (transients) table_ = {transients->settings, {}, {}};
    for (const Prescribed* p : group_)
      if (transients) table_.own.push_back(transients->own[p->place]);
  }

  bool run() {
    const std::size_t size = group_.front()->systems.front().dimension();
    std::vector<double> states(group_.size() * size);
    if (group_.front()->free > 0 && (transients_ || group_.front()->systems.front().tilts())) return run_alone();
    if (!set_off(states)) return false;
    const std::size_t pieces = group_.front()->segments.size();
    for (std::size_t k = group_.front()->free; k + 1 < pieces; ++k) {
      if (!advance(group_, k, false, states, fates_, transients_ ? &table_ : nullptr, stop_)) return false;
      for (std::size_t j = 0; j < group_.size(); ++j) cross(j, k, &states[j * size]);
    }
    for (std::size_t j = 0; j < group_.size(); ++j) {
      const Prescribed& p = *group_[j];
      std::copy_n(&states[j * size], size, &spun_.states[p.place * size]);
      finish(p, fates_[j]);
      if (transients_) transients_->rows[p.place] = table_.rows[j];
    }
    return true;
  }

 private:
  void finish(const Prescribed& p, const Fate& fate) {
    spun_.fates[p.place] = fate;
    spun_.begins[p.place] = p.settled();
    spun_.rotors[p.place] = p.rotor(p.segments.size() - 1);
    spun_.rotors[p.place].end = p.settled() + *p.own->study.numerics.horizon;
  }

  // One rotor at a time: transients of held balls come from superposition, and held balls load a tilting rotor by a
  // couple too.
  bool run_alone() {
    for (const Prescribed* p : group_) {
      const std::size_t size = p->systems.front().dimension();
      StartSource source(p->own->study, stop_);
      TransientTable one;
      if (transients_) {
        one.settings = transients_->own[p->place];
        source.watch(one.settings);
      }
      SpunUp spun;
      if (!source.follow({&p->own->start, 1}, spun, transients_ ? &one : nullptr)) return false;
      std::copy_n(spun.states.begin(), size, &spun_.states[p->place * size]);
      finish(*p, spun.fates.front());
      if (transients_) transients_->rows[p->place] = one.rows.front();
    }
    return true;
  }

  // Follows the group up to its release.
  bool set_off(std::vector<double>& states) {
    const std::size_t size = group_.front()->systems.front().dimension();
    for (std::size_t j = 0; j < group_.size(); ++j) {
      const Prescribed& p = *group_[j];
      const model::System& system = p.systems.front();
      initial_state(p.own->start, system.balls(), p.segments.front().speed, &states[j * size], system.layout().tilt);
      if (transients_) table_.rows.emplace_back();
    }
    if (group_.front()->free == 0) return true;
    const std::size_t held_size = model::held_layout(group_.front()->systems.front()).size;
    std::vector<double> held(group_.size() * held_size);
    for (std::size_t j = 0; j < group_.size(); ++j)
      model::hold_balls(group_[j]->systems.front(), &states[j * size], &held[j * held_size]);
    for (std::size_t k = 0; k < group_.front()->free; ++k) {
      if (!advance(group_, k, true, held, fates_, nullptr, stop_)) return false;
      for (std::size_t j = 0; j < group_.size(); ++j) cross(j, k, &held[j * held_size]);
    }
    for (std::size_t j = 0; j < group_.size(); ++j)
      model::release_balls(group_[j]->systems.front(), &held[j * held_size], &states[j * size]);
    return true;
  }

  void cross(std::size_t j, std::size_t k, double* state) {
    const std::vector<model::Segment>& segments = group_[j]->segments;
    const double jump = segments[k + 1].speed - segments[k].speed_at(segments[k].end);
    model::apply_speed_jump(jump, state);
    if (const int tilt = group_[j]->systems[k].layout().tilt; tilt >= 0) model::apply_speed_jump(jump, state + tilt);
    if (transients_ && k >= group_[j]->free && segments[k].acceleration != segments[k + 1].acceleration)
      table_.rows[j].work.end_piece();
  }

  std::vector<Prescribed*> group_;
  SpunUp& spun_;
  TransientTable* transients_;
  const StopFlag* stop_;
  TransientTable table_;
  std::vector<Fate> fates_;
};

bool spin_up_prescribed(std::span<const OwnRotorStart> starts, const StopFlag* stop, SpunUp& spun,
                        TransientTable* transients) {
  std::vector<Prescribed> all;
  all.reserve(starts.size());
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const Study& s = starts[i].study;
    all.push_back({i, &starts[i], model::segments(s.speed_profile(), s.release_time())});
    Prescribed& p = all.back();
    for (const model::DrivePiece& piece : model::prescribed_drive(p.segments).pieces)
      p.systems.emplace_back(s.parameters, piece);
    while (p.segments[p.free].clamped) ++p.free;
  }
  std::map<Shape, std::vector<Prescribed*>> groups;
  for (Prescribed& p : all) groups[{p.segments.size(), p.free}].push_back(&p);
  for (auto& [shape, group] : groups)
    if (is_set(stop) || !PrescribedGroup(std::move(group), spun, transients, stop).run()) return false;
  return true;
}

}  // namespace

bool spin_up_own_rotors(std::span<const OwnRotorStart> starts, const StopFlag* stop, SpunUp& spun,
                        TransientTable* transients) {
  spun = {};
  if (starts.empty()) return true;
  const model::System last = starts.front().study.system();
  for (const OwnRotorStart& own : starts)
    spun.phi.insert(spun.phi.end(), own.start.phi.begin(), own.start.phi.begin() + last.balls());
  const std::size_t count = starts.size();
  spun.states.assign(count * static_cast<std::size_t>(last.dimension()), 0.0);
  spun.begins.assign(count, 0.0);
  spun.fates.assign(count, Fate{});
  spun.rotors.assign(count, own_rotor(last));
  if (transients) transients->rows.assign(count, TransientSums{});
  if (starts.front().study.speed.driven()) return spin_up_motors(starts, stop, spun, transients);
  return spin_up_prescribed(starts, stop, spun, transients);
}

}  // namespace equipoise

// One draw after the other.
#include "equipoise/fates/drawn_runner.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "equipoise/discovery/horizon.hpp"
#include "equipoise/fates/followed_start.hpp"
#include "equipoise/fates/transient_tally.hpp"
#include "equipoise/spin_up/initial_state.hpp"
#include "equipoise/spin_up/spin_up.hpp"
#include "equipoise/traps/balanced_analysis.hpp"

namespace equipoise {

namespace {

// With more uncertain values each end is tried by itself: the reader has done so.
constexpr std::size_t most_tried_together = 6;

std::string words(const Uncertainty& uncertain, const std::vector<double>& values) {
  std::string text;
  for (std::size_t k = 0; k < values.size(); ++k)
    text += fmt::format("{}{} = {}", k ? ", " : "", uncertain.values[k].key, uncertain.values[k].text(values[k]));
  return text;
}

void check_corner(const Study& study, const std::vector<double>& values, bool by_kinds, bool transients) {
  const std::string with = "; with " + words(study.uncertain, values);
  try {
    const Study corner = drawn_study(study, values);
    check_runnable(corner, transients);
    if (followed_one_by_one(corner.system()) != by_kinds)
      throw InputError(
          study.name, study.uncertain.values.front().key, "",
          "makes rotors that are told by kinds and rotors that are told by their attractors; must be one of "
          "the two");
  } catch (const InputError& e) {
    throw InputError(e.place(), e.key(), e.value(), e.problem() + with);
  }
}

// From dimensionless figures of one rotor to those of another.
void change_units(const model::Scales& from, const model::Scales& to, Fate& fate, TransientRow* row) {
  if (from.mass == to.mass && from.length == to.length && from.frequency == to.frequency) return;
  const double time = from.time() / to.time(), length = from.length / to.length, force = from.force() / to.force();
  const double velocity = from.velocity() / to.velocity(), unbalance = from.unbalance() / to.unbalance();
  const auto scale = [](float& value, double by) { value = static_cast<float>(value * by); };
  fate.time *= time;
  scale(fate.mean_speed, 1.0 / time);
  scale(fate.unbalance, unbalance);
  if (!row) return;
  for (float TransientRow::*column :
       {&TransientRow::peak_radial, &TransientRow::peak_radial_after_release, &TransientRow::peak_radial_at_end})
    scale(row->*column, length);
  for (float TransientRow::*column : {&TransientRow::peak_force, &TransientRow::rms_force}) scale(row->*column, force);
  scale(row->rms_velocity, velocity);
  scale(row->energy, from.torque() / to.torque());
  scale(row->residual_unbalance, unbalance);
  for (float TransientRow::*column :
       {&TransientRow::time_above, &TransientRow::settling_time, &TransientRow::followed_until})
    scale(row->*column, time);
}

}  // namespace

void check_drawable(const Study& study, bool transients) {
  check(study);
  if (study.numerics.decide != DecideMode::validated)
    throw InputError(
        study.name, "numerics.decide", decide_mode_names[static_cast<std::size_t>(study.numerics.decide)],
        "with uncertain values every start is followed to a motion of its own rotor; must be \"validated\"");
  const Study medians = with_medians(study);
  check_runnable(medians, transients);
  const bool by_kinds = followed_one_by_one(medians.system());
  const std::vector<UncertainValue>& uncertain = study.uncertain.values;
  if (uncertain.size() > most_tried_together) return;
  for (std::size_t corner = 0; corner < std::size_t{1} << uncertain.size(); ++corner) {
    std::vector<double> values;
    for (std::size_t k = 0; k < uncertain.size(); ++k) values.push_back(uncertain[k].ends()[(corner >> k) & 1]);
    check_corner(study, values, by_kinds, transients);
  }
}

DrawnRunner::DrawnRunner(const Study& study, const StopFlag* stop)
    : study_(with_horizon(study)), stop_(stop), sampler_(sampler_of(study)) {
  const Study medians = with_medians(study_);
  if (followed_one_by_one(medians.system())) by_kinds_ = std::make_unique<MachineRunner>(medians, stop);
  settled_ = by_kinds_ ? by_kinds_->settled() : make_spin_up(medians, stop)->settled();
}

std::vector<double> DrawnRunner::values_of(std::uint64_t index) const {
  return drawn_values(study_, sampler_, study_.sampling.seed, index);
}

bool DrawnRunner::follow_alone(const Study& draw, std::uint64_t index, DrawnStart& result, TransientRow* row) const {
  const std::unique_ptr<SpinUp> source = make_spin_up(draw, stop_);
  const model::System system = draw.system();
  TransientTable table{transient_settings(draw), {}, {}};
  if (row) source->watch(table.settings);
  SpunUp start;
  if (!source->make(draw.sampling.seed, index, 1, start, row ? &table : nullptr)) return false;
  FollowedStart followed = follow_start(draw, system, *source, start, {}, stop_);
  result.fate = followed.fate;
  if (row) *row = followed_transients(draw, *source, start, followed, table, stop_);
  if (is_set(stop_)) return false;
  if (result.fate.outcome != Outcome::attracted) return true;
  result.name = motion_name(draw.parameters, *followed.settling.motion);
  result.motion = std::move(followed.settling.motion);
  return true;
}

bool DrawnRunner::follow_by_kinds(const Study& draw, std::uint64_t index, DrawnStart& result, TransientRow* row) const {
  std::vector<double> phi;
  std::vector<Fate> fates;
  std::vector<UnlistedStart> none;
  std::vector<TransientRow> rows;
  if (!MachineRunner(draw, stop_).run(index, 1, phi, fates, none, row ? &rows : nullptr)) return false;
  result.fate = fates.front();
  if (row) *row = rows.front();
  return true;
}

std::optional<DrawnStart> DrawnRunner::decide(std::uint64_t index, const std::vector<double>& values,
                                              TransientRow* row) const {
  DrawnStart result;
  std::optional<Study> draw;
  try {
    draw = drawn_study(study_, values);
  } catch (const InputError&) {  // beyond the ends that were tried
    result.start = start_of(study_, sampler_, study_.sampling.seed, index);
    result.fate.outcome = Outcome::failed;
    if (row) *row = transient_row({}, {}, true);
    return result;
  }
  result.start = start_of(*draw, sampler_, study_.sampling.seed, index);
  if (!(by_kinds_ ? follow_by_kinds(*draw, index, result, row) : follow_alone(*draw, index, result, row)))
    return std::nullopt;
  if (draw->scales) change_units(*draw->scales, *study_.scales, result.fate, row);
  return result;
}

bool DrawnRunner::run(std::uint64_t first, std::size_t count, std::vector<double>& phi, std::vector<Fate>& fates,
                      std::vector<UnlistedStart>& unlisted, std::vector<TransientRow>* rows) const {
  phi.clear();
  unlisted.clear();
  fates.assign(count, Fate{});
  if (rows) rows->assign(count, TransientRow{});
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t index = first + i;
    std::optional<DrawnStart> drawn = decide(index, values_of(index), rows ? &(*rows)[i] : nullptr);
    if (!drawn) return false;
    phi.insert(phi.end(), drawn->start.phi.begin(), drawn->start.phi.begin() + study_.parameters.balls);
    fates[i] = drawn->fate;
    if (drawn->motion)
      unlisted.push_back({i, {static_cast<double>(index)}, std::move(drawn->motion), std::move(drawn->name)});
  }
  return true;
}

std::optional<UnlistedStart> DrawnRunner::follow(const std::vector<double>& state) const {
  const auto index = static_cast<std::uint64_t>(state.front());
  std::optional<DrawnStart> drawn = decide(index, values_of(index), nullptr);
  if (!drawn) return std::nullopt;
  return UnlistedStart{0, state, std::move(drawn->motion), std::move(drawn->name)};
}

int DrawnRunner::list(const UnlistedStart& start) {
  if (!start.motion) return 0;
  for (const Attractor& a : catalogue_.attractors())
    if (start.name.id ? a.id == start.name.id : a.name == start.name.name) return a.id;
  int id = start.name.id;
  if (id == 0)
    for (id = first_free_id; catalogue_.find(id);) ++id;
  catalogue_.add({id, start.name.name, start.name.alias, *start.motion, {}});
  return id;
}

BalanceNote DrawnRunner::balance() const {
  BalanceNote note;
  if (by_kinds_) {
    note = by_kinds_->balance();
  } else {
    const BalancedAnalysis balanced = analyse_balanced(study_.system(), stop_);
    note = {balanced.stable, balanced.note};
  }
  if (!note.note.empty()) note.note = "with every uncertain value at its median: " + note.note;
  return note;
}

}  // namespace equipoise

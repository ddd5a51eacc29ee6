// Takes one study's starts from index to fate.
#include "equipoise/classification/start_runs/start_runner.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "equipoise/attractors/motions/motion_figures.hpp"
#include "equipoise/classification/rotor_family/horizon.hpp"
#include "equipoise/classification/start_runs/transient_tally.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"

namespace equipoise {

StartRunner::StartRunner(const Study& study, const AttractorSearchSettings& settings, bool transients)
    : study_(with_horizon(study)),
      gathers_(transients),
      few_starts_(settings.few_starts && study.uncertain.empty()),
      stop_(settings.stop),
      system_(study.system()),
      transients_(transient_settings(study)),
      source_(make_spin_up(with_medians(study_), settings.stop)),
      sampler_(sampler_of(study_)) {
  if (study_.uncertain.empty()) {
    search_ = search_attractors(study_, settings);
    catalogue_ = search_.catalogue;
  } else {
    family_.emplace(study_);
    // Coasting rotors have no attractors to search for: each start is tested against its own balance.
    catalogue_ = Catalogue(true);
    if (!system_.coasts()) {
      mesh_ = mesh_of(study_, *family_, settings);
      catalogue_ = mesh_.catalogue;
    }
  }
  if (!transients) return;
  source_->watch(transients_);
  for (const Attractor& a : catalogue_.attractors()) {
    ends_.resize(std::max(ends_.size(), static_cast<std::size_t>(a.id) + 1));
    ends_[static_cast<std::size_t>(a.id)] = end_of(a.id);
  }
}

// The mesh of a study with uncertain values, made once for all runs that share a cache.
FamilyMesh StartRunner::mesh_of(const Study& study, const StudyFamily& family,
                                const AttractorSearchSettings& settings) {
  Study subject = study;
  subject.sampling = {};
  subject.limits = {};
  AttractorSearchSettings of_family = settings;
  of_family.family = to_toml(subject);
  if (!settings.cache) return search_attractor_mesh(family, {}, of_family);
  std::string key = search_key(of_family.family, settings);
  if (const auto at = settings.cache->meshes.find(key); at != settings.cache->meshes.end()) return *at->second;
  FamilyMesh mesh = search_attractor_mesh(family, {}, of_family);
  if (!mesh.stopped) settings.cache->meshes.emplace(std::move(key), std::make_shared<const FamilyMesh>(mesh));
  return mesh;
}

StartRunner::StartRunner(const Study& study, StudyFamily family, const FamilyStarts& starts,
                         const AttractorSearchSettings& settings)
    : study_(with_horizon(study)),
      measures_radii_(true),
      stop_(settings.stop),
      system_(study.system()),
      transients_(transient_settings(study)),
      source_(make_spin_up(study_, settings.stop)),
      sampler_(sampler_of(study_)),
      family_(std::move(family)),
      mesh_(search_attractor_mesh(*family_, starts, settings)),
      catalogue_(mesh_.catalogue) {}

// Where rotors differ, no end is known beforehand, except exact balance with its zero figures.
KnownEnd StartRunner::end_of(int attractor) const {
  const KnownEnd end = known_end(study_.parameters, *catalogue_.find(attractor), transients_.shaft);
  if (!family_) return end;
  const bool exact = attractor == balanced_id && end.figures && end.figures->radial == 0.0;
  return exact ? end : KnownEnd{};
}

BalanceNote StartRunner::balance() const {
  if (!family_) return {search_.balanced.stable, search_.balanced.note};
  BalanceNote note;
  for (const FamilyCell& cell : mesh_.cells) {
    note.stable = note.stable || cell.search.balanced.stable;
    if (note.note.empty()) note.note = cell.search.balanced.note;
  }
  if (note.stable) note.note.clear();
  return note;
}

bool StartRunner::run(std::uint64_t first, std::size_t count, Decided& decided) const {
  if (family_) {
    std::vector<DrawnStart> drawn;
    for (std::size_t i = 0; i < count; ++i) drawn.push_back({first + i, fractions_of(first + i)});
    return run_drawn(drawn, decided);
  }
  Batch batch(*this, gathers_);
  if (!source_->make(study_.sampling.seed, first, count, batch.starts, batch.watched_table())) return false;
  if (!finish(batch, decided)) return false;
  decided.phi = batch.starts.phi;
  return true;
}

bool StartRunner::run_from(std::span<const InitialState> given, Decided& decided) const {
  if (family_) throw std::logic_error("starts that draw their rotors are known by their numbers alone");
  Batch batch(*this, gathers_);
  return source_->follow(parted(study_.parameters, given), batch.starts, batch.watched_table()) &&
         finish(batch, decided);
}

std::vector<double> StartRunner::fractions_of(std::uint64_t number) const {
  return drawn_fractions(study_, sampler_, study_.sampling.seed, number);
}

std::vector<UndecidedEnd> StartRunner::look_at(const std::vector<InitialState>& undecided) const {
  std::vector<UndecidedEnd> ends;
  if (family_) return ends;  // a start alone does not say which rotor it drew
  for (const InitialState& given : undecided) {
    Batch batch(*this, false);
    if (!source_->follow(parted(study_.parameters, {&given, 1}), batch.starts)) break;
    if (batch.starts.is_over(0)) {
      ends.push_back(
          {.what = Restlessness::clamped, .reached = batch.starts.nearest[0], .asked = *study_.release.speed});
      continue;
    }
    if (!decide(batch)) break;
    const std::vector<double> z = when_recognised(batch, 0, batch.fates[0].time);
    const Eigen::Map<const Eigen::VectorXd> state(z.data(), static_cast<Eigen::Index>(z.size()));
    ends.push_back(look_at_undecided(system_, state));
    if (batch.fates[0].outcome == Outcome::attracted && ends.back().what == Restlessness::regular)
      ends.back().what = Restlessness::unidentified;
    if (system_.prescribed()) continue;
    const float before = batch.fates[0].mean_speed;
    if (!note_last_speeds(batch)) break;
    const double now = batch.fates[0].mean_speed;
    const Restlessness of_rotor = restlessness(before, batch.fates[0], batch.starts.begin(0, source_->settled()));
    UndecidedEnd& end = ends.back();
    const bool changes = of_rotor == Restlessness::speeding_up || of_rotor == Restlessness::changing_speed;
    const bool waits_for_speed = end.what == Restlessness::creeping || end.what == Restlessness::near_balance;
    if (end.what == Restlessness::regular || (changes && waits_for_speed)) end.what = of_rotor;
    if (end.what == Restlessness::speeding_up) end.reached = std::fabs(now);
  }
  return ends;
}

// Compares a driven rotor's last speed with `before`, the mean over its last long window. For motions that are not
// chaotic. hardly_seen: it was watched over too few short windows to tell one from the next.
Restlessness StartRunner::restlessness(double before, const Fate& fate, double begin) const {
  constexpr double steady = 0.02;
  constexpr int fewest_windows = 8;
  const double now = fate.mean_speed;
  if (fate.time - begin < fewest_windows * search_.rule.window) return Restlessness::hardly_seen;
  if (!(std::fabs(now - before) > steady * std::fabs(now))) return Restlessness::regular;
  return std::fabs(now) > std::fabs(before) ? Restlessness::speeding_up : Restlessness::changing_speed;
}

std::optional<UnlistedStart> StartRunner::follow(const std::vector<double>& state) const {
  if (family_) {  // `state` is a start's number
    Decided decided;
    const auto number = static_cast<std::uint64_t>(state.front());
    const DrawnStart drawn{number, fractions_of(number)};
    if (!run_drawn({&drawn, 1}, decided, false)) return std::nullopt;
    return decided.unlisted.empty() ? UnlistedStart{0, state, {}, {}} : std::move(decided.unlisted.front());
  }
  const Eigen::Map<const Eigen::VectorXd> z(state.data(), static_cast<Eigen::Index>(state.size()));
  UnlistedStart start{0, state, {}, {}};
  if (search_.coasting)
    start.motion = search_.coasting->lasting_motion(z, stop_);
  else
    start.motion = motion_from(system_, z, followed_for(system_, few_starts_), stop_);
  if (is_set(stop_)) return std::nullopt;  // its motion may have been cut short
  return start;
}

int StartRunner::list(const UnlistedStart& start) {
  const bool stable = start.motion && start.motion->stable;
  if (!stable) return 0;
  if (start.motion->kind == MotionKind::measured) return catalogue_.add(start.name, *start.motion);
  if (!family_ && !system_.coasts()) return catalogue_.add(study_.parameters, *start.motion);
  return catalogue_.add(family_ ? start.name : motion_name(study_.parameters, *start.motion), *start.motion);
}

int StartRunner::settle(const UnlistedStart& start, Fate& fate) {
  const int attractor = list(start);
  fate.attractor = static_cast<short>(attractor);
  if (attractor == 0) {
    fate.outcome = Outcome::undecided;
    fate.by = DecidedBy::nothing;
  }
  return attractor;
}

void StartRunner::settle(Decided& decided) {
  for (const UnlistedStart& start : decided.unlisted) settle(start, decided.fates[start.place]);
}

}  // namespace equipoise

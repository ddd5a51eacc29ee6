// Prepares one rotor or a family, and takes its starts from index to outcome in batches.
#include "equipoise/classification/start_runs/session.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "equipoise/attractors/motions/motion_figures.hpp"
#include "equipoise/classification/rotor_family/horizon.hpp"
#include "equipoise/classification/start_runs/batch.hpp"
#include "equipoise/classification/start_runs/transient_tally.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"

namespace equipoise {

namespace {

FamilyMesh mesh_of_one(const Study& study, const AttractorSearchSettings& settings) {
  FamilyMesh mesh;
  AttractorSearch found = search_attractors(study, settings);
  mesh.catalogue = found.catalogue;
  mesh.stopped = found.stopped;
  mesh.cells.push_back({{}, std::move(found), {}});
  return mesh;
}

// The mesh of a study with uncertain values, made once for all runs that share a cache. Coasting rotors have no
// attractors to search for: each start is tested against its own balance.
FamilyMesh mesh_of(const Study& study, const StudyFamily& family, const AttractorSearchSettings& settings) {
  if (study.system().coasts()) return {};
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

// Where rotors differ, no end is known beforehand, except exact balance with its zero figures.
KnownEnd end_of(const Attractor& a, const model::Parameters& p, const TransientSettings& settings, bool of_family) {
  const KnownEnd end = known_end(p, a, settings.shaft);
  const bool exact = a.id == balanced_id && end.figures && end.figures->radial == 0.0;
  return exact || !of_family ? end : KnownEnd{};
}

}  // namespace

Session::Session(const Study& study, const AttractorSearchSettings& settings, bool transients)
    : study_(with_horizon(study)),
      gathers_(transients),
      mode_(settings.mode),
      stop_(settings.stop),
      system_(study.system()),
      transients_(transient_settings(study)),
      source_(make_spin_up(with_medians(study_), settings.stop)),
      sampler_(sampler_of(study_)) {
  if (!study_.uncertain.empty()) family_.emplace(study_);
  mesh_ = family_ ? mesh_of(study_, *family_, settings) : mesh_of_one(study_, settings);
  if (!transients) return;
  source_->watch(transients_);
  for (const Attractor& a : mesh_.catalogue.attractors()) {
    ends_.resize(std::max(ends_.size(), static_cast<std::size_t>(a.id) + 1));
    ends_[static_cast<std::size_t>(a.id)] = end_of(a, study_.parameters, transients_, family_.has_value());
  }
}

Session::Session(const Study& study, StudyFamily family, const FamilyStarts& starts,
                 const AttractorSearchSettings& settings)
    : study_(with_horizon(study)),
      measures_radii_(true),
      stop_(settings.stop),
      system_(study.system()),
      transients_(transient_settings(study)),
      source_(make_spin_up(study_, settings.stop)),
      sampler_(sampler_of(study_)),
      family_(std::move(family)),
      mesh_(search_attractor_mesh(*family_, starts, settings)) {}

Session::Session(const Session& other, double tolerance) : Session(other) {
  study_.numerics.tolerance = tolerance;
  source_ = make_spin_up(with_medians(study_), stop_);
  if (gathers_) source_->watch(transients_);
}

BalanceNote Session::balance() const {
  BalanceNote note;
  for (const FamilyCell& cell : mesh_.cells) {
    note.stable = note.stable || cell.search.balanced.stable;
    if (note.note.empty()) note.note = cell.search.balanced.note;
  }
  // A note is about the rotor of one cell; others of the family may balance.
  if (family_ && note.stable)
    note.note.clear();
  else if (family_ && !note.note.empty())
    note.note.add_before("for some of the rotors drawn, ");
  return note;
}

bool Session::decide(std::uint64_t first, std::size_t count, Decided& decided) const {
  if (family_) {
    std::vector<DrawnStart> drawn;
    for (std::size_t i = 0; i < count; ++i) drawn.push_back({first + i, fractions_of(first + i)});
    return decide(drawn, decided);
  }
  Batch batch(*this, gathers_);
  if (!batch.begin(first, count) || !batch.finish(decided)) return false;
  decided.phi = batch.phi();
  return true;
}

bool Session::decide(std::span<const InitialState> given, Decided& decided) const {
  if (family_) throw std::logic_error("starts that draw their rotors are known by their numbers alone");
  Batch batch(*this, gathers_);
  return batch.begin(given) && batch.finish(decided);
}

bool Session::meet(std::vector<FamilyStart> given, std::span<const std::size_t> rotor,
                   std::span<MetMotions> met) const {
  Batch batch(*this, false);
  return batch.begin(std::move(given)) && batch.meet(rotor, met);
}

std::vector<double> Session::fractions_of(std::uint64_t number) const {
  return drawn_fractions(study_, sampler_, study_.sampling.seed, number);
}

std::vector<UndecidedEnd> Session::look_at(const std::vector<InitialState>& undecided) const {
  std::vector<UndecidedEnd> ends;
  if (family_) return ends;  // a start alone does not say which rotor it drew
  for (const InitialState& given : undecided) {
    Batch batch(*this, false);
    const auto end = batch.begin({&given, 1}) ? batch.look() : std::nullopt;
    if (!end) break;
    ends.push_back(*end);
  }
  return ends;
}

std::optional<UnlistedStart> Session::follow(const std::vector<double>& state) const {
  if (family_) {  // `state` is a start's number
    Decided decided;
    const auto number = static_cast<std::uint64_t>(state.front());
    const DrawnStart drawn{number, fractions_of(number)};
    if (!decide({&drawn, 1}, decided)) return std::nullopt;
    return decided.unlisted.empty() ? UnlistedStart{0, state, {}, {}} : std::move(decided.unlisted.front());
  }
  const Eigen::Map<const Eigen::VectorXd> z(state.data(), static_cast<Eigen::Index>(state.size()));
  UnlistedStart start{0, state, {}, {}};
  const auto& coasting = mesh_.cells.front().search.coasting;
  start.motion =
      coasting ? coasting->lasting_motion(z, stop_) : motion_from(system_, z, followed_for(system_, mode_), stop_);
  if (is_set(stop_)) return std::nullopt;  // its motion may have been cut short
  // Each start of a coasting rotor finds its own speed, so motions with one name are one.
  if (coasting && start.motion) start.name = motion_name(study_.parameters, *start.motion);
  return start;
}

int RunCatalogue::list(const UnlistedStart& start) {
  if (!start.motion || !start.motion->stable) return 0;
  return start.name.name.empty() ? add(parameters_, *start.motion) : add(start.name, *start.motion);
}

int RunCatalogue::settle(const UnlistedStart& start, Outcome& outcome) {
  const int attractor = list(start);
  outcome.attractor = static_cast<short>(attractor);
  if (attractor == 0) {
    outcome.kind = OutcomeKind::undecided;
    outcome.by = DecidedBy::nothing;
  }
  return attractor;
}

void RunCatalogue::settle(Decided& decided) {
  for (const UnlistedStart& start : decided.unlisted) settle(start, decided.outcomes[start.place]);
}

}  // namespace equipoise

// Starts of a session, taken from index to outcome side by side on lanes.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "equipoise/classification/start_runs/session.hpp"

namespace equipoise {

/// A function that returns false or nothing was stopped early.
class Session::Batch {
 public:
  /// `watched`: transients are gathered.
  Batch(const Session& session, bool watched) : s_(session), watched_(watched), table_{s_.transients_, {}, s_.ends_} {}

  /// Bring starts to the last piece of their drive.
  bool begin(std::uint64_t first, std::size_t count);
  bool begin(std::span<const InitialState> given);
  bool begin(std::vector<FamilyStart> given);
  /// Applies the rule, follows on what it does not list, and says what each start came to.
  bool finish(Decided& decided);
  /// Initial ball angles.
  const std::vector<double>& phi() const { return starts_.phi; }
  /// How the only start goes on at the horizon.
  std::optional<UndecidedEnd> look();
  /// As Session::meet().
  bool meet(std::span<const std::size_t> rotor, std::span<MetMotions> met);

 private:
  // Starts with their own rotors are each followed.
  bool few() const { return s_.mode_ == SearchMode::few && !s_.family_; }
  const Study& study(std::size_t i) const { return own_.empty() ? s_.study_ : own_[i].own.study; }
  const model::System& system(std::size_t i) const { return own_.empty() ? s_.system_ : starts_.rotors[i].system; }
  double begin_of(std::size_t i) const { return starts_.begin(i, s_.settled()); }
  double horizon() const { return s_.settled() + *s_.study_.numerics.horizon; }
  double end(std::size_t i) const { return own_.empty() ? horizon() : starts_.rotors[i].end; }
  TransientTable* watched_table() { return watched_ ? &table_ : nullptr; }
  const double* state(std::size_t i) const {
    return &starts_.states[i * static_cast<std::size_t>(s_.system_.dimension())];
  }
  const FamilyCell& cell(std::size_t i) const { return s_.mesh_.cells[own_.empty() ? 0 : cell_[i]]; }

  bool classify();
  bool classify(const FamilyCell& cell, const std::vector<std::size_t>& places);
  bool note_last_speeds();
  bool note_radii();
  bool is_left(std::size_t i) const;
  bool follows_open(std::size_t i) const;
  bool is_in_chaos(std::size_t i, const std::vector<double>& state, double followed) const;
  std::optional<UnlistedStart> follow_on(std::size_t i, bool open);
  std::optional<UnlistedStart> followed(std::size_t i, double now, double patience) const;
  std::optional<UnlistedStart> unlisted_of_few(std::size_t i, double now);
  UnlistedStart met_again(std::size_t i) const;
  UnlistedStart in_chaos(std::size_t i, double now) const;
  std::vector<double> when_recognised(std::size_t i, double now) const;
  double mean_speed(std::size_t i) const;
  TransientRow row(std::size_t i, const std::optional<MotionFigures>& end) const;
  Restlessness restlessness(double before) const;
  bool meet(std::size_t i, MetMotions& met) const;

  const Session& s_;
  SpunUp starts_;
  std::vector<FamilyStart> own_;   // each start's study if they differ, else empty
  std::vector<std::size_t> cell_;  // their cells of the mesh
  bool watched_;
  TransientTable table_;  // if watched
  std::vector<Outcome> outcomes_;
  std::optional<std::vector<PilotRecord>> records_;  // of all starts, if needed
  // Of few starts: what those that were followed look like (`attractor`: their place here), and what they came to.
  std::vector<KnownFeatures> looks_;
  std::vector<UnlistedStart> came_to_;
};

}  // namespace equipoise

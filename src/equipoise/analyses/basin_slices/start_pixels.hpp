// Pixels as starts: of one rotor, or of a family of rotors if an axis is one of their parameters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "equipoise/analyses/basin_slices/line_motions.hpp"
#include "equipoise/analyses/basin_slices/slice_names.hpp"
#include "equipoise/analyses/basin_slices/slice_store.hpp"
#include "equipoise/analyses/ensembles/chunks.hpp"
#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/core/running/run_options.hpp"
#include "equipoise/machine/balance/coincident_balls.hpp"
#include "equipoise/results/commands/basin_slice.hpp"

namespace equipoise {

/// Whether all pixels are starts of one rotor: both axes are ball angles or, with free balls, other initial values.
bool maps_starts(const BasinSlice& map);

/// Of a tilting rotor: model::tilt_balance_margin().
double balance_margin(const model::Parameters& p);
/// Largest growth rate at isolated balanced states; NaN if the rotor's angle matters or the race is off centre.
double balance_growth(const model::System& system);

/// The start of [initial] with a pixel's values and the links.
InitialState start_at(const BasinSlice& map, int column, int row);
/// The study of a pixel. Throws InputError if it is invalid.
Study study_at(const BasinSlice& map, int column, int row);

/// Alike balls that start in one place with one rate move as one, even where others of the plane's starts drive them
/// apart. Such starts have measure zero, but a grid may hit them: a whole diagonal of a square over two angles. Pairs
/// that are in one place all over the plane are the user's choice, and count. Colliding balls that overlap are no
/// start.
class InvariantPixels {
 public:
  explicit InvariantPixels(const BasinSlice& plane);

  bool holds(int column, int row) const;
  /// In the whole plane. 0 if they are all there is.
  std::uint64_t count() const { return count_; }
  /// Whether every pixel starts some alike balls in one place, which no count includes.
  bool everywhere() const { return everywhere_; }

 private:
  // How far one ball of a pair is ahead of the other: the sum of what column and row give.
  struct Pair {
    std::vector<double> angle_of_column, angle_of_row, rate_of_column, rate_of_row;
    struct {
      double angle, rate;
    } meet{model::parting, model::parting};  // below both
  };
  std::vector<Pair> pairs_;  // those that the plane moves apart
  std::uint64_t count_ = 0;
  bool everywhere_ = false;
};

/// Decides the pixels of a slice as basin() decides its starts.
class StartPixels {
 public:
  /// Takes what pixels come to. Called by one thread at a time.
  using Take = std::function<void(const std::vector<std::uint32_t>& positions, const std::vector<SlicePixel>& pixels)>;

  /// Finds the attractors, after listing the motions that earlier runs met. `map`: its study must have a horizon.
  /// `names` receives the motions of pixels. `file`, if not null, keeps names and states on motions that are new to it
  /// before the pixels that came to them.
  StartPixels(const BasinSlice& map, const RunOptions& options, SliceNames& names, SliceStore* file, Take take);

  /// Computes pixels at these positions and passes them on in this order. False if stopped before all were done.
  bool compute(const std::vector<std::uint32_t>& positions);

  /// Of the starts of these pixels, those that end elsewhere when followed to this tolerance; starts that reach no
  /// attractor do not count. Empty if stopped.
  std::optional<Share> flipped(const std::vector<std::uint32_t>& positions, double tolerance) const;

 private:
  bool of_family() const { return session_.family() != nullptr; }
  InitialState start(std::uint32_t position) const;
  FamilyStart family_start(std::uint32_t position) const;
  // `lines`: the motions of lines that have been probed, or null.
  bool take_all(const Session& session, const LineMotions* lines, const std::vector<std::uint32_t>& positions,
                const TakeChunk& take) const;
  bool decide(const Session& session, const LineMotions* lines, const std::vector<std::uint32_t>& positions,
              Chunk& chunk) const;
  void hand_on(const std::vector<std::uint32_t>& positions, Chunk& chunk);
  short code_of_motion(const MotionName& motion);
  // `own`: given if rotors differ between pixels. `followed`: the largest r, if the start was followed for it.
  SlicePixel pixel_of(const std::optional<FamilyStart>& own, const Outcome& outcome, const double* followed);

  const BasinSlice& map_;
  const RunOptions& options_;
  SliceNames& names_;
  SliceStore* const file_;
  const Take take_;
  const Session session_;
  RunCatalogue catalogue_;
  std::optional<LineMotions> lines_;  // where lines have one rotor
  bool unread_ = false;               // stopped before the motions that the file names were listed
  std::set<int> listed_;              // attractors known beforehand, or already listed
  std::map<int, short> codes_;        // of attractors
};

}  // namespace equipoise

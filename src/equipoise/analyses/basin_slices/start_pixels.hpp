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
#include "equipoise/analyses/basin_slices/slice_pixel.hpp"
#include "equipoise/analyses/ensembles/chunks.hpp"
#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/core/running/run_options.hpp"
#include "equipoise/results/commands/basin_slice.hpp"

namespace equipoise {

/// Whether all pixels are starts of one rotor: both axes are ball angles or, with free balls, other initial values.
bool maps_starts(const BasinSlice& map);

/// Of a rotor that tilts: model::tilt_balance_margin().
double balance_margin(const model::Parameters& p);
/// Largest growth rate at isolated balanced states; NaN if the rotor's angle matters or the race is off centre.
double balance_growth(const model::System& system);

/// The study of a pixel. Throws InputError if it is invalid.
Study study_at(const BasinSlice& map, int column, int row);

/// Decides the pixels of a slice as basin() decides its starts.
class StartPixels {
 public:
  using Discovered = std::function<void(const std::vector<double>& state)>;

  /// Finds the attractors. `map`: its study must have a horizon. `met`: states on motions that earlier runs met; these
  /// are listed first. `discovered` is told of new ones, before the pixels that came to them. `notes` may be null.
  StartPixels(const BasinSlice& map, const RunOptions& options, const std::vector<std::vector<double>>& met,
              const Discovered& discovered, SearchLog* notes);

  /// Computes pixels at these positions and passes them on in this order. False if stopped before all were done.
  bool compute(const std::vector<std::uint32_t>& positions, const TakePixels& take);

 private:
  bool of_family() const { return session_.family() != nullptr; }
  InitialState start(std::uint32_t position) const;
  FamilyStart family_start(std::uint32_t position) const;
  bool decide(const std::vector<std::uint32_t>& positions, Chunk& chunk) const;
  void hand_on(const std::vector<std::uint32_t>& positions, Chunk& chunk, const TakePixels& take);
  // `own`: given if rotors differ between pixels.
  SlicePixel pixel_of(const std::optional<FamilyStart>& own, const Fate& fate, const MotionName*& motion);
  static void add_balance(const Study& study, SlicePixel& pixel);

  const BasinSlice& map_;
  const RunOptions& options_;
  Discovered discovered_;
  const Session session_;
  RunCatalogue catalogue_;
  std::optional<LineMotions> lines_;                        // where lines have one rotor
  bool unread_ = false;                                     // stopped before all of `met` were listed
  std::set<int> listed_;                                    // attractors known beforehand, or already told
  std::map<int, std::unique_ptr<const MotionName>> names_;  // of attractors
};

}  // namespace equipoise

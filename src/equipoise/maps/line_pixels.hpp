// Maps along a parameter: one trajectory a pixel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

#include "equipoise/base/run_options.hpp"
#include "equipoise/maps/map_pixel.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/motions/settling.hpp"
#include "equipoise/results/plane_map.hpp"

namespace equipoise {

double balance_margin(const model::Parameters& p);
/// Of isolated balanced states where nothing depends on the rotor's angle and the race is centred; else not a number.
double balance_growth(const model::System& system);

/// The study of a pixel. Throws InputError if it is none.
Study study_at(const PlaneMap& map, int column, int row);

/// Pixels followed one by one, until each is seen to approach a motion. Where one axis is of initial values lines run
/// along it, and a few pixels of a line, which share one system, are done one after another: so each orbit is refined
/// once for all of them. (Moving orbits from one system to the next costs more than finding them anew.)
class LinePixels {
 public:
  /// `map`: its study has a horizon.
  LinePixels(const PlaneMap& map, const RunOptions& options);

  /// Pixels at these positions, handed on in any order. False if stopped before all were done.
  bool compute(const std::vector<std::uint32_t>& positions, const TakePixels& take);

 private:
  struct Followed;
  std::vector<std::uint32_t> along_lines(std::vector<std::uint32_t> positions) const;
  std::pair<std::uint32_t, std::uint32_t> piece_of(std::uint32_t position) const;
  void compute_piece(const std::vector<std::uint32_t>& positions, std::size_t begin, std::size_t end,
                     const TakePixels& take);
  Followed follow(const Study& study, const model::System& system, std::vector<KnownOrbit>& known) const;

  const PlaneMap& map_;
  const RunOptions& options_;
  bool one_system_;  // all pixels of a line have the same parameters
  bool along_y_;
  std::mutex taking_;
};

}  // namespace equipoise

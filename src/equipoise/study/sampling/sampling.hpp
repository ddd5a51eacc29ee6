// How the starts of an ensemble are chosen: at random, by scrambled Sobol points, or on a jittered grid.
// This room: starts: random, Sobol, grid.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace equipoise {

enum class SamplingMethod { random, sobol, grid };
inline constexpr std::array<const char*, 3> sampling_method_names{"random", "sobol", "grid"};

/// Stratified sampling of ball angles: m^n equal cells, m per turn, with two independent uniform starts each, whose
/// differences give the variance without bias (S. Haber, Math. Comp. 21 (1967) 388). With `exchange` (exchanging balls
/// changes no outcome's probability) only cells c_1 <= ... <= c_n are evaluated, each for all its mirror images. The
/// seed shuffles the cells, so that the first starts are also a fair sample.
class JitteredGrid {
 public:
  /// The largest grid that fits into `starts` >= 2 starts.
  JitteredGrid(int balls, bool exchange, std::uint64_t starts);

  std::uint64_t side() const { return side_; }         ///< m
  std::uint64_t cells() const { return cells_; }       ///< evaluated
  std::uint64_t starts() const { return 2 * cells_; }  ///< starts 0 to starts() - 1 fill the grid
  double all_cells() const;                            ///< m^n
  bool exchange() const { return exchange_; }

  /// Writes the ball angles of start `index` < starts(); starts 2 k and 2 k + 1 share a cell.
  void angles(std::uint64_t seed, std::uint64_t index, double* phi) const;
  /// How many cells of the whole grid the start's cell stands for: 1 to n!.
  double weight(std::uint64_t seed, std::uint64_t index) const;

 private:
  void cell(std::uint64_t seed, std::uint64_t index, std::uint64_t* coordinates) const;

  int balls_;
  bool exchange_;
  std::uint64_t side_ = 1, cells_ = 1;
};

/// The random numbers of every start, for every method. Thread-safe.
class Sampler {
 public:
  /// Only a grid uses `starts` (2 or more) and `exchange`; see JitteredGrid.
  Sampler(SamplingMethod method, int balls, std::uint64_t starts, bool exchange);

  SamplingMethod method() const { return method_; }
  /// The grid; only for that method.
  const std::optional<JitteredGrid>& grid() const { return grid_; }

  /// Writes the ball angles of start `index`, each uniform on [0, 2 pi).
  void angles(std::uint64_t seed, std::uint64_t index, double* phi) const;
  /// Writes further numbers of start `index` for `count` quantities, uniform on [0, 1). Only quantities that are
  /// `drawn` use coordinates of a Sobol point.
  void fractions(std::uint64_t seed, std::uint64_t index, int count, const bool* drawn, double* fractions) const;
  /// A number of start `index` for the value `name`, the `place`-th drawn in addition to ball angles and `wanted`
  /// fractions(). It is the next coordinate of the Sobol point while there is one, else independent of `place`.
  double named(std::uint64_t seed, std::uint64_t index, int wanted, int place, std::string_view name) const;
  /// How much start `index` counts: 1, except on a grid that uses exchange symmetry.
  double weight(std::uint64_t seed, std::uint64_t index) const;

 private:
  SamplingMethod method_;
  int balls_;
  std::optional<JitteredGrid> grid_;
};

}  // namespace equipoise

// How the starts of an ensemble are chosen: at random, by scrambled Sobol points, or on a jittered grid.
// This room: starts: random, Sobol, grid.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "equipoise/study/sampling/jittered_grid.hpp"

namespace equipoise {

enum class SamplingMethod { random, sobol, grid };
inline constexpr std::array<const char*, 3> sampling_method_names{"random", "sobol", "grid"};

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

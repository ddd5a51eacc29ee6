// How the starts of an ensemble are chosen: at random, by scrambled Sobol points, on a jittered grid.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "equipoise/sampling/jittered_grid.hpp"

namespace equipoise {

enum class SamplingMethod { random, sobol, grid };
inline constexpr std::array<const char*, 3> sampling_method_names{"random", "sobol", "grid"};

/// The random numbers of every start, whatever the method. Thread-safe.
class Sampler {
 public:
  /// `starts` (2 or more) and `exchange` matter to a grid alone, see JitteredGrid.
  Sampler(SamplingMethod method, int balls, std::uint64_t starts, bool exchange);

  SamplingMethod method() const { return method_; }
  /// The grid, for that method.
  const std::optional<JitteredGrid>& grid() const { return grid_; }

  /// Writes the ball angles of start `index`, each uniform on [0, 2 pi).
  void angles(std::uint64_t seed, std::uint64_t index, double* phi) const;
  /// Writes further numbers of start `index`, uniform on [0, 1), for `count` quantities. Of a Sobol point only those
  /// that are `drawn` take up coordinates.
  void fractions(std::uint64_t seed, std::uint64_t index, int count, const bool* drawn, double* fractions) const;
  /// A number of start `index` for a value called `name`, the `place`-th drawn beside ball angles and `wanted`
  /// fractions(): the next coordinate of its Sobol point if there is one, else independent of the place.
  double named(std::uint64_t seed, std::uint64_t index, int wanted, int place, std::string_view name) const;
  /// What start `index` counts: 1, but on a grid that uses exchange symmetry.
  double weight(std::uint64_t seed, std::uint64_t index) const;

 private:
  SamplingMethod method_;
  int balls_;
  std::optional<JitteredGrid> grid_;
};

}  // namespace equipoise

// What pictures of sweeps show, whoever draws them.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "equipoise/results/sweep_result.hpp"

namespace equipoise {

/// One outcome of a sweep, to be stacked on those before it.
struct SweepLayer {
  std::string name;           ///< with the alias before it
  std::string colour;         ///< the same in all pictures
  std::vector<double> share;  ///< by cell; 0 where it is missing
};
/// From below: balanced, the other attractors that some start came to by identifier, and what came to none.
std::vector<SweepLayer> sweep_layers(const SweepResult& result);

/// "final rotor speed Ω / critical speed", "rotor.unbalance (g mm)".
std::string sweep_axis_label(const SweepParameter& parameter);

}  // namespace equipoise

// What all pictures of sweeps share.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "equipoise/results/commands/sweep_result.hpp"

namespace equipoise {

/// One outcome of a sweep, stacked on those before it.
struct SweepLayer {
  std::string name;           ///< after its alias
  std::string colour;         ///< the same in all pictures
  std::vector<double> share;  ///< by cell; 0 where it is missing
};
/// From the bottom: balanced, the other attractors met, by identifier, and outcomes without attractor.
std::vector<SweepLayer> sweep_layers(const SweepResult& result);

/// "final rotor speed Ω / critical speed", "rotor.unbalance (g mm)".
std::string sweep_axis_label(const SweepParameter& parameter);

}  // namespace equipoise

// How long starts stay in chaotic motion that leads somewhere in the end: told from a pilot.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "equipoise/attractors/fate.hpp"
#include "equipoise/model/parameters.hpp"

namespace equipoise {

/// Pilot starts followed to time `end`, and the state of one that is still undecided then, at a strobe where the
/// equations depend on the rotor's angle.
struct PilotOutcome {
  const std::vector<Fate>* fates = nullptr;
  double begin = 0.0, end = 0.0;
  std::function<Eigen::VectorXd(std::size_t)> state;
};

/// In words, without a full stop: how many of the undecided go on chaotically, and for how long on average. Empty where
/// few are undecided or those few are not chaotic. Of the stay a lower bound (95 %) where too few were seen to end.
std::string chaotic_stay(const model::Parameters& p, double speed, const PilotOutcome& pilot);

}  // namespace equipoise

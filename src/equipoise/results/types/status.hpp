// How an integration ended: numerical trouble is data, kept apart by kind.
#pragma once

namespace equipoise {

enum class IntegrationStatus {
  done,      ///< reached its end
  diverged,  ///< a state variable passed divergence_limit
  failed,    ///< step size or step count exhausted
};

/// A state variable beyond this has left every motion a balancer can make (lengths are in race radii, r < 1).
inline constexpr double divergence_limit = 1e6;

}  // namespace equipoise

// Words for kinds of motion.
#include "equipoise/types/motion.hpp"

namespace equipoise {

const char* name_of(MotionKind kind) {
  switch (kind) {
    case MotionKind::equilibrium:
      return "equilibrium";
    case MotionKind::periodic:
      return "periodic";
    case MotionKind::quasi_periodic:
      return "quasi-periodic";
    case MotionKind::chaotic:
      return "chaotic";
    default:
      return "measured";
  }
}

}  // namespace equipoise

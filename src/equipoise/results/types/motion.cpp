// Words for kinds of motion.
#include "equipoise/results/types/motion.hpp"

#include <cstddef>

namespace equipoise {

const char* name_of(MotionKind kind) {
  constexpr std::array<const char*, 5> names{"equilibrium", "periodic", "quasi-periodic", "chaotic", "measured"};
  return names[static_cast<std::size_t>(kind)];
}

}  // namespace equipoise

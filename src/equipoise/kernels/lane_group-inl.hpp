// What all compiled kernels share: how many groups of lanes take turns, and the observer of those that merely arrive.
// Included once per CPU target.
#if defined(EQUIPOISE_KERNELS_LANE_GROUP_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_KERNELS_LANE_GROUP_INL
#undef EQUIPOISE_KERNELS_LANE_GROUP_INL
#else
#define EQUIPOISE_KERNELS_LANE_GROUP_INL
#endif

#include <vector>

#include "equipoise/deciding/fate.hpp"
#include "equipoise/lanes/lane_block-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// Groups of lanes taken in turn. Eight lanes and 32 registers (AVX-512) profit from three for up to two balls; narrower
// registers, or more balls, keep the processor busy with one.
template <int room>
inline constexpr int lane_groups = room <= 2 && pack_lanes == 8 ? 3 : 1;

// Records trajectories that are lost on the way; the others simply arrive.
class WatchForLoss : public NoObserver {
 public:
  explicit WatchForLoss(std::vector<Fate>& fates) : fates_(fates) {}
  void end(int, std::size_t start, LaneEnd how, double t, const double*) {
    if (how == LaneEnd::diverged) fates_[start] = {Outcome::diverged, DecidedBy::nothing, 0, t};
    if (how == LaneEnd::failed) fates_[start] = {Outcome::failed, DecidedBy::nothing, 0, t};
  }

 private:
  std::vector<Fate>& fates_;
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif

// Observer of a lane block made of two: one that tells fates and one that gathers transients. A trajectory whose fate
// is known goes on until its end has been seen. Included once per CPU target.
#if defined(EQUIPOISE_DECIDING_FOLLOW_ON_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_DECIDING_FOLLOW_ON_INL
#undef EQUIPOISE_DECIDING_FOLLOW_ON_INL
#else
#define EQUIPOISE_DECIDING_FOLLOW_ON_INL
#endif

#include <cstddef>

#include "equipoise/deciding/decision_rule.hpp"
#include "equipoise/lanes/lane_block-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// `Fates` tells by attractor_of(slot) what it has just decided; one without that function never decides. Its fates are
// those it would give alone: it sees nothing of a lane after its decision.
//
// A decided trajectory leaves when its watch has seen enough of where it ends (seen_enough()).
template <class Fates, class Watch, int groups>
class FollowOn {
 public:
  FollowOn(Fates& fates, Watch& watch) : fates_(fates), watch_(watch) {}

  void begin(int slot, std::size_t start, double t, const double* z) {
    fates_.begin(slot, start, t, z);
    watch_.begin(slot, start, t, z);
    decided_[slot / lanes] &= ~bit(slot);
  }

  HWY_INLINE void stage(int row, int g, const Pack* z) {
    fates_.stage(row, g, z);
    watch_.stage(row, g, z);
  }

  HWY_INLINE unsigned step(int g, unsigned active, Mask accepted, Pack t, Pack h, const Pack* z) {
    const unsigned full = watch_.step(g, active, accepted, t, h, z) & decided_[g];
    const unsigned fresh = fates_.step(g, active & ~decided_[g], accepted, t, h, z);
    if constexpr (requires(Fates f) { f.attractor_of(0); }) {
      if (fresh) note(g, fresh, t);
      if (full) return seen(g, full);
    }
    return 0;
  }

  void end(int slot, std::size_t start, LaneEnd how, double t, const double* z) {
    watch_.end(slot, start, t);
    if (decided_[slot / lanes] & bit(slot))
      fates_.end(slot, start, LaneEnd::decided, decided_at_[slot], z);
    else
      fates_.end(slot, start, how, t, z);
  }

 private:
  static constexpr int lanes = static_cast<int>(pack_lanes);
  static unsigned bit(int slot) { return 1u << (slot % lanes); }

  HWY_NOINLINE void note(int g, unsigned fresh, Pack t) {
    alignas(64) double times[8];
    t.store(times);
    for (int lane = 0; lane < lanes; ++lane) {
      if (!(fresh & (1u << lane))) continue;
      const int slot = g * lanes + lane;
      decided_at_[slot] = times[lane];
      attractor_[slot] = fates_.attractor_of(slot);
      watch_.restart(slot, times[lane]);
    }
    decided_[g] |= fresh;
  }

  HWY_NOINLINE unsigned seen(int g, unsigned full) const {
    unsigned leaving = 0;
    for (int lane = 0; lane < lanes; ++lane) {
      const int slot = g * lanes + lane;
      if ((full & (1u << lane)) && watch_.seen_enough(slot, attractor_[slot])) leaving |= 1u << lane;
    }
    return leaving;
  }

  Fates& fates_;
  Watch& watch_;
  unsigned decided_[groups] = {};
  double decided_at_[groups * lanes] = {};
  int attractor_[groups * lanes] = {};
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif

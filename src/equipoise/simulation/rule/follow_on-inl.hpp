// Observer of a lane block that combines an observer that decides fates with an optional watch. A decided trajectory
// goes on until the watch has seen its final motion. Included once per CPU target.
#if defined(EQUIPOISE_CLASSIFICATION_FOLLOW_ON_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_CLASSIFICATION_FOLLOW_ON_INL
#undef EQUIPOISE_CLASSIFICATION_FOLLOW_ON_INL
#else
#define EQUIPOISE_CLASSIFICATION_FOLLOW_ON_INL
#endif

#include <cstddef>

#include "equipoise/simulation/batch/batch_watch-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// `Fates` says by attractor_of(slot) what it has just decided; without that function it never decides. It sees nothing
// of a lane after its decision, so a watch changes no fate. `watch` may be null, as for most tasks; HWY_UNLIKELY keeps
// registers for those.
template <class Fates, int groups>
class FollowOn {
 public:
  static_assert(groups <= most_batch_groups);

  FollowOn(Fates& fates, BatchWatch* watch, int size) : fates_(fates), watch_(watch), size_(size) {}

  void begin(int slot, std::size_t start, double t, const double* z) {
    fates_.begin(slot, start, t, z);
    decided_[slot / lanes] &= ~bit(slot);
    if (watch_) watch_->begin(slot, start, t, z);
  }

  HWY_INLINE void stage(int row, int g, const Pack* z) {
    fates_.stage(row, g, z);
    if (row == first_sampled_stage && HWY_UNLIKELY(watch_)) sample(first_[g], z);
    if (row == second_sampled_stage && HWY_UNLIKELY(watch_)) sample(second_[g], z);
  }

  HWY_INLINE unsigned step(int g, unsigned active, Mask accepted, Pack t, Pack h, const Pack* z) {
    unsigned full = 0;
    if (HWY_UNLIKELY(watch_)) full = watch_->step({g, active, accepted, t, h, z, first_[g], second_[g]});
    const unsigned fresh = fates_.step(g, active & ~decided_[g], accepted, t, h, z);
    return HWY_UNLIKELY(watch_) ? leaving(g, full & decided_[g], fresh, t) : fresh;
  }

  void corner(int slot, double t, const double* z) {
    if (watch_) watch_->corner(slot, t, z);
  }

  void end(int slot, std::size_t start, BatchEnd how, double t, const double* z) {
    if (watch_) watch_->end(slot, start, how, t);
    if (decided_[slot / lanes] & bit(slot))
      fates_.end(slot, start, BatchEnd::decided, decided_at_[slot], z);
    else
      fates_.end(slot, start, how, t, z);
  }

 private:
  static constexpr int lanes = static_cast<int>(pack_lanes);
  static unsigned bit(int slot) { return 1u << (slot % lanes); }

  HWY_INLINE void sample(Pack* kept, const Pack* z) const {
    for (int i = 0; i < size_; ++i) kept[i] = z[i];
  }

  // Notes the `fresh` decisions. Returns the earlier decided lanes that may leave, of those whose window has just ended
  // (`full`).
  HWY_INLINE unsigned leaving(int g, unsigned full, unsigned fresh, Pack t) {
    if constexpr (requires(Fates f) { f.attractor_of(0); }) {
      if (fresh) note(g, fresh, t);
      if (full) return seen(g, full);
    }
    return 0;
  }

  HWY_NOINLINE void note(int g, unsigned fresh, Pack t) {
    alignas(64) double times[8];
    t.store(times);
    for (int lane = 0; lane < lanes; ++lane) {
      if (!(fresh & (1u << lane))) continue;
      const int slot = g * lanes + lane;
      decided_at_[slot] = times[lane];
      attractor_[slot] = fates_.attractor_of(slot);
      watch_->restart(slot, times[lane]);
    }
    decided_[g] |= fresh;
  }

  HWY_NOINLINE unsigned seen(int g, unsigned full) const {
    unsigned result = 0;
    for (int lane = 0; lane < lanes; ++lane) {
      const int slot = g * lanes + lane;
      if ((full & (1u << lane)) && watch_->seen_enough(slot, attractor_[slot])) result |= 1u << lane;
    }
    return result;
  }

  Fates& fates_;
  BatchWatch* const watch_;
  const int size_;                 // of a state
  unsigned decided_[groups] = {};  // bits of lanes followed on
  double decided_at_[groups * lanes] = {};
  int attractor_[groups * lanes] = {};
  Pack first_[groups][watched_state], second_[groups][watched_state];
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif

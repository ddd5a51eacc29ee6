// A second observer of lanes, in addition to the one that decides outcomes. It is bound at run time and called once per
// step, so no kernel is compiled again for it. Included once per CPU target.
#if defined(EQUIPOISE_BATCH_BATCH_WATCH_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_BATCH_BATCH_WATCH_INL
#undef EQUIPOISE_BATCH_BATCH_WATCH_INL
#else
#define EQUIPOISE_BATCH_BATCH_WATCH_INL
#endif

#include <cstddef>
#include <memory>

#include "equipoise/simulation/batch/batch_block-inl.hpp"
#include "equipoise/machine/model/parameters.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// A step just tried in one group of lanes.
struct TriedStep {
  int group;
  unsigned active;  // bits of the lanes that hold a trajectory
  Mask accepted;
  Pack t, h;           // t: at the step's end
  const Pack* z;       // the state there
  const Pack* first;   // and at first_sampled_stage
  const Pack* second;  // and at second_sampled_stage
};

// Stages of DOP853 at 1/3 and 0.6 of a step: with its ends, samples are at most 0.4 apart.
inline constexpr int first_sampled_stage = 5, second_sampled_stage = 9;

// Size of the largest state of any system (machine/model/system.hpp).
inline constexpr int watched_state = max_dimension;

// A watch has room for this many groups.
inline constexpr int most_batch_groups = 3;

// Hooks as in NoObserver. A decided trajectory may leave only at the end of one of the watch's windows of time.
class BatchWatch {
 public:
  virtual ~BatchWatch() = default;
  virtual void begin(int slot, std::size_t start, double t, const double* z) = 0;
  // Bits of the lanes whose window has just ended.
  virtual unsigned step(const TriedStep& step) = 0;
  // The state has jumped to z, or its rates have.
  virtual void corner(int slot, double t, const double* z) = 0;
  virtual void end(int slot, std::size_t start, BatchEnd how, double t) = 0;
  // Restarts the windows of a lane at `t`: nothing before belongs to the trajectory's final motion.
  virtual void restart(int slot, double t) = 0;
  // Whether a trajectory decided for `attractor` may leave with the window that has just ended.
  virtual bool seen_enough(int slot, int attractor) const = 0;
};

// The watch that a task asks for, null if none: compiled once for the kernels of all kinds
// (simulation/kernels/watch_kernels.cpp).
std::unique_ptr<BatchWatch> watch_of(const BatchTask& task);

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif

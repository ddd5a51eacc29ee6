// The choice of a task's kernel, and CPU targets. Highway's foreach_target compiles this file once per CPU target.
#include "equipoise/simulation/kernels/batch_kernels.hpp"

#include <cstdint>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/simulation/kernels/batch_job.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "equipoise/simulation/kernels/batch_kernels.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

std::int64_t target_code() { return HWY_TARGET; }

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace equipoise {

HWY_EXPORT(target_code);

namespace {
// The usual names: Highway calls AVX-512 "AVX3", and says of NEON what else it asks of a processor.
std::string name_of(std::int64_t target) {
  if (target == HWY_AVX3) return "AVX-512";
  if (target == HWY_SCALAR) return "scalar";
  const std::string name = hwy::TargetName(target);
  return name.rfind("NEON", 0) == 0 ? "NEON" : name;
}

bool run_kind(const BatchJob& job) {
  if (job.task.held) return advance_held_batch(job);
  switch (job.task.kind()) {
    case BatchKind::smooth:
      return run_kernel<BatchKind::smooth>(job);
    case BatchKind::hybrid:
      return run_kernel<BatchKind::hybrid>(job);
    case BatchKind::tilting:
      return run_kernel<BatchKind::tilting>(job);
    case BatchKind::turning:
      return run_kernel<BatchKind::turning>(job);
    default:
      return run_kernel<BatchKind::plain>(job);
  }
}

// Carries Outcome::met over from one piece of the drive to the next: a contact, once made, counts.
bool run_batch(const BatchJob& job) {
  if (!job.task.parameters->balls_collide() || job.task.held) return run_kind(job);
  std::vector<char> met(job.task.count);
  for (std::size_t i = 0; i < met.size(); ++i) met[i] = job.outcomes[i].met;
  BatchTask task = job.task;
  task.met = met.data();
  const bool done = run_kind({task, job.outcomes, job.rule, job.pilot});
  for (std::size_t i = 0; i < met.size(); ++i) job.outcomes[i].met = met[i] != 0;
  return done;
}
}  // namespace

bool advance_batch(const BatchTask& task, std::vector<Outcome>& outcomes) { return run_batch({task, outcomes}); }

bool classify_batch(const BatchTask& task, const ClassificationRule& rule, std::vector<Outcome>& outcomes,
                    std::vector<PilotRecord>* pilot) {
  return run_batch({task, outcomes, &rule, pilot});
}

std::string cpu_target() { return name_of(HWY_DYNAMIC_DISPATCH(target_code)()); }

// Kernels do the same operations in the same order on every instruction set. Only fused multiply-add rounds
// differently: where a set has it, the written ones are fused; with EQUIPOISE_KERNELS_CONTRACTED also those that GCC
// chooses.
std::string cpu_arithmetic(const std::string& target) {
#if !(defined(EQUIPOISE_KERNELS_CONTRACTED) && defined(__FMA__))  // GCC would fuse in portable code, too
  if (target == "SSE4" || target == "scalar") return "without fused multiply-add (SSE4, scalar)";
#endif
#ifdef EQUIPOISE_KERNELS_CONTRACTED
  if (target == "AVX-512" || target == "AVX2") return "with fused multiply-add (AVX2, AVX-512)";
#else
  if (target == "AVX-512" || target == "AVX2" || target == "NEON")
    return "with fused multiply-add where it is written (AVX2, AVX-512, NEON)";
#endif
  return "of " + target;
}

// Found before the first choice, since a choice hides all other targets from Highway.
static const std::vector<std::int64_t>& all_targets() {
  static const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  return targets;
}

std::vector<std::string> cpu_targets() {
  std::vector<std::string> names;
  for (const std::int64_t target : all_targets()) names.push_back(name_of(target));
  return names;
}

bool use_cpu_target(const std::string& name) {
  hwy::SetSupportedTargetsForTest(0);  // back to all that this computer has
  hwy::GetChosenTarget().DeInit();
  if (name.empty()) return true;
  for (const std::int64_t target : all_targets())
    if (name == name_of(target)) {
      hwy::SetSupportedTargetsForTest(target);
      hwy::GetChosenTarget().DeInit();
      return true;
    }
  return false;
}

void require_cpu_target(const std::string& name, const std::string& where, const std::string& key) {
  const std::string before = cpu_target();
  if (use_cpu_target(name)) return;
  use_cpu_target(before);
  throw InputError(where, key, display_text(name),
                   fmt::format("must be one of those this program is built for and this machine has: {}",
                               fmt::join(cpu_targets(), ", ")));
}

ChosenCpuTarget::ChosenCpuTarget(const std::string& name) {
  const std::string before = cpu_target();
  if (name.empty() || name == before) return;
  require_cpu_target(name, "options", "cpu_target");
  before_ = before;
}

ChosenCpuTarget::~ChosenCpuTarget() {
  if (!before_.empty()) use_cpu_target(before_);
}

}  // namespace equipoise
#endif

// Which instruction set the kernels run on: the best that this machine has, unless another is chosen.
#pragma once

#include <string>
#include <vector>

namespace equipoise {

/// Instruction set in use: "AVX-512", "AVX2", "SSE4", "NEON" or "scalar".
std::string cpu_target();
/// Every instruction set this program was built for that this machine has, best first.
std::vector<std::string> cpu_targets();
/// Uses one of cpu_targets() from now on; an empty name returns to the best. False if `name` is not among them.
/// Not to be called while kernels run.
bool use_cpu_target(const std::string& name);

/// How kernels round on a target: those with the same words give the same bits in programs of one compiler. Without fused
/// multiply-add, and with no more of it than is written, all compilers agree.
std::string cpu_arithmetic(const std::string& target);

/// The same for a name given at `where`, under `key`. If it is not among cpu_targets(), changes nothing and throws an
/// InputError that names both.
void require_cpu_target(const std::string& name, const std::string& where, const std::string& key);

/// The CPU target of one call, for the lifetime of this object.
class ChosenCpuTarget {
 public:
  /// An empty name changes nothing. Throws InputError, naming RunOptions, if this machine does not have it.
  explicit ChosenCpuTarget(const std::string& name);
  ~ChosenCpuTarget();
  ChosenCpuTarget(const ChosenCpuTarget&) = delete;
  ChosenCpuTarget& operator=(const ChosenCpuTarget&) = delete;

 private:
  std::string before_;  // empty: nothing to return to
};

}  // namespace equipoise

// Balanced states, one by one: form and sampled level from the trap analysis, proof, check.
#include "equipoise/basins/certify.hpp"

#include <chrono>
#include <cmath>

#include "equipoise/base/reporting.hpp"
#include "equipoise/fates/start_runner.hpp"
#include "equipoise/traps/balanced_analysis.hpp"
#include "equipoise/traps/balanced_trap.hpp"

namespace equipoise {

namespace {

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

StateProof prove(const model::System& system, const BalancedTrap& trap, const StopFlag* stop) {
  StateProof proof;
  proof.critical = trap.level / level_margin;
  auto begin = std::chrono::steady_clock::now();
  proof.certificate =
      largest_certificate(system, trap.phi.data(), form_of(trap), proof.critical, &proof.check.reason, stop);
  proof.seconds = seconds_since(begin);
  if (proof.certificate.level == 0.0) {
    proof.certificate.phi = trap.phi;
    return proof;
  }
  begin = std::chrono::steady_clock::now();
  proof.check = check_certificate(proof.certificate, stop);
  proof.check_seconds = seconds_since(begin);
  for (int i = 0; i < system.dimension(); ++i)
    proof.reach[i] = trap.reach[i] * std::sqrt(proof.certificate.level / trap.level);
  return proof;
}

CertifyResult proofs(const Study& study, const RunOptions& options) {
  const model::System system = study.system();
  const model::Parameters& p = study.parameters;
  CertifyResult result;
  result.study = study;
  result.speed = model::balanced_speed(system).value_or(0.0);
  if (model::balanced_states(system).kind == model::BalancedStates::Kind::family) {
    result.note = "the balanced states form a continuum; proofs are for isolated ones, of one or two balls";
    return result;
  }
  const BalancedAnalysis analysis = analyse_balanced(system, options.stop);
  result.note = analysis.note;
  if (p.balls > 2) {
    result.note = "proofs are for one or two balls";
    return result;
  }
  const bool copies = p.balls == 2 && p.equal_balls() && analysis.traps.size() == 2;
  const auto stopped = [&] { return is_set(options.stop); };
  const std::size_t states = copies ? 1 : analysis.traps.size();
  const auto report = [&] {
    if (options.progress) options.progress({result.states.size(), states, "balanced states", {}});
  };
  report();
  while (result.states.size() < states && !stopped()) {
    result.states.push_back(prove(system, analysis.traps[result.states.size()], options.stop));
    if (copies) result.states.back().copies = 2;
    report();
  }
  result.partial = stopped();
  return result;
}

}  // namespace

CertifyResult certify(const Study& study, const RunOptions& options) {
  check_offers(study, model::Answer::proofs);
  return reported(options, [&](const RunOptions& o) { return proofs(study, o); });
}

}  // namespace equipoise

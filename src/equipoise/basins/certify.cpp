// Balanced states, one by one: form and sampled level from the trap analysis, proof, check.
#include "equipoise/basins/certify.hpp"

#include <chrono>
#include <cmath>

#include "equipoise/fates/start_runner.hpp"
#include "equipoise/traps/balanced_trap.hpp"

namespace equipoise {

namespace {

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

StateProof prove(const model::Parameters& p, double speed, const BalancedTrap& trap) {
  const int size = model::dimension(p.balls);
  StateProof proof;
  proof.critical = trap.level / level_margin;
  auto begin = std::chrono::steady_clock::now();
  proof.certificate =
      largest_certificate(p, speed, trap.phi.data(), form_of(trap), proof.critical, &proof.check.reason);
  proof.seconds = seconds_since(begin);
  if (proof.certificate.level == 0.0) {
    proof.certificate.phi = trap.phi;
    return proof;
  }
  begin = std::chrono::steady_clock::now();
  proof.check = check_certificate(proof.certificate);
  proof.check_seconds = seconds_since(begin);
  for (int i = 0; i < size; ++i) proof.reach[i] = trap.reach[i] * std::sqrt(proof.certificate.level / trap.level);
  return proof;
}

}  // namespace

CertifyResult certify(const Study& study) {
  check_autonomous(study, "proofs");
  const model::Parameters& p = study.parameters;
  CertifyResult result;
  result.study = study;
  result.speed = study.speed_profile().final_speed();
  if (model::balanced_states(p).kind == model::BalancedStates::Kind::family) {
    result.note = "the balanced states form a continuum; proofs are for isolated ones, of one or two balls";
    return result;
  }
  const BalancedAnalysis analysis = analyse_balanced(p, result.speed);
  result.note = analysis.note;
  if (p.balls > 2) {
    result.note = "proofs are for one or two balls";
    return result;
  }
  const bool copies = p.balls == 2 && p.equal_balls() && analysis.traps.size() == 2;
  for (const BalancedTrap& trap : analysis.traps) {
    result.states.push_back(prove(p, result.speed, trap));
    if (!copies) continue;
    result.states.back().copies = 2;
    break;
  }
  return result;
}

}  // namespace equipoise

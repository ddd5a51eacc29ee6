// Proves balanced states one by one: form and sampled level from the balanced analysis, then proof and check.
#include "equipoise/extras/proof/certify.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "equipoise/attractors/equilibria/continuum_draws.hpp"
#include "equipoise/classification/balanced_regions/balanced_analysis.hpp"
#include "equipoise/classification/balanced_regions/balanced_region.hpp"
#include "equipoise/classification/proved_regions/level_frame.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/core/running/reporting.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"

namespace equipoise {

namespace {

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

StateProof prove(const model::System& system, const BalancedRegion& region, const StopFlag* stop) {
  StateProof proof;
  proof.critical = region.level / level_margin;
  auto begin = std::chrono::steady_clock::now();
  proof.certificate =
      largest_certificate(system, region.angles(), form_of(region), proof.critical, &proof.check.reason, stop);
  proof.seconds = seconds_since(begin);
  if (proof.certificate.level == 0.0) {
    std::copy_n(region.angles(), system.balls(), proof.certificate.phi.begin());
    return proof;
  }
  begin = std::chrono::steady_clock::now();
  proof.check = check_certificate(proof.certificate, stop);
  proof.check_seconds = seconds_since(begin);
  for (int i = 0; i < system.dimension(); ++i)
    proof.reach[i] = region.reach[i] * std::sqrt(proof.certificate.level / region.level);
  return proof;
}

// Members are drawn evenly over all ball angles that balance.
void prove_members(const model::System& system, const RunOptions& options, CertifyResult& result) {
  constexpr std::size_t drawn = 64;
  const model::Parameters& p = system.parameters();
  if (p.balls < 3 || !system.plain()) {
    result.note = p.tilts() ? tilt_refusal(system)
                            : "the balanced states form a continuum; proofs about one are for three balls or more, at "
                              "a prescribed speed, in a centred race";
    return;
  }
  ContinuumDraws draws(p);
  std::array<double, model::max_balls> phi{};
  const auto report = [&] {
    if (options.progress) options.progress({result.members.size(), drawn, "balanced states", {}});
  };
  report();
  while (result.members.size() < drawn && !is_set(options.stop) && draws.next(phi)) {
    MemberProof proof;
    proof.certificate = prove_member(p, system.speed(), phi.data());
    proof.check = proof.certificate.radius > 0.0
                      ? check_member(proof.certificate)
                      : CertificateResult{false, "neither attraction nor instability could be proved"};
    proof.growth = across_continuum(p, system.speed(), phi.data());
    result.members.push_back(std::move(proof));
    report();
  }
  result.partial = is_set(options.stop);
  if (!result.partial && !result.members.empty() && result.attracting() == 0)
    result.note.add("no member of the continuum that was drawn attracts ").add_speed(system.speed());
}

CertifyResult proofs(const Study& study, const RunOptions& options) {
  const model::System system = study.system();
  const model::Parameters& p = study.parameters;
  CertifyResult result;
  result.study = study;
  result.speed = model::balanced_speed(system).value_or(0.0);
  if (model::balanced_states(system).kind == model::BalancedStates::Kind::continuum) {
    prove_members(system, options, result);
    return result;
  }
  const BalancedAnalysis analysis = analyse_balanced(system, options.stop);
  result.note = analysis.note;
  if (p.balls > 2 && !p.tilts()) {
    result.note = "proofs are for one or two balls";
    return result;
  }
  const bool copies = p.balls == 2 && p.equal_balls() && analysis.regions.size() == 2;
  const auto stopped = [&] { return is_set(options.stop); };
  const std::size_t states = copies ? 1 : analysis.regions.size();
  const auto report = [&] {
    if (options.progress) options.progress({result.states.size(), states, "balanced states", {}});
  };
  report();
  while (result.states.size() < states && !stopped()) {
    result.states.push_back(prove(system, analysis.regions[result.states.size()], options.stop));
    if (copies) result.states.back().copies = 2;
    report();
  }
  result.partial = stopped();
  return result;
}

}  // namespace

bool CertifyResult::proved() const {
  if (!members.empty()) return attracting() > 0 && attracting() + unstable() == static_cast<int>(members.size());
  return !states.empty() && std::all_of(states.begin(), states.end(), [](const StateProof& s) {
    return s.certificate.level > 0.0 && s.check.proved;
  });
}

int CertifyResult::members_proved(bool attracts) const {
  return static_cast<int>(std::count_if(members.begin(), members.end(), [&](const MemberProof& m) {
    return m.check.proved && m.certificate.attracts == attracts;
  }));
}

bool CertificateFile::proved() const {
  const auto all = [](const auto& proofs) {
    return std::all_of(proofs.begin(), proofs.end(), [](const auto& proof) { return proof.check.proved; });
  };
  return (!states.empty() || !members.empty()) && all(states) && all(members);
}

CertifyResult certify(const Study& study, const RunOptions& options) {
  check_offers(study, model::ResultKind::proofs);
  return reported(options, [&](const RunOptions& o) { return proofs(with_medians(study), o); });
}

}  // namespace equipoise

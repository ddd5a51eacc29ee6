// Studies of the repository, and additions to them.
#include "machines.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "claims.hpp"
#include "equipoise/classification/rotor_family/horizon.hpp"
#include "late_motion.hpp"

namespace equipoise::audit {

namespace {

struct Machine {
  const char* label;
  const char* study;
  std::vector<std::string> overrides;
};

const std::string unbalance = "rotor.eccentricity={ uniform = [0.005, 0.015] }";
const std::string narrow = "rotor.eccentricity={ uniform = [0.008, 0.012] }";
const std::string damping = "rotor.damping={ uniform = [0.4, 0.6] }";
const std::string mass = "balancer.mass={ uniform = [0.045, 0.055] }";
const std::string drag = "balancer.drag={ loguniform = [0.04, 0.06] }";
const std::string speed = "speed.speed={ uniform = [2.3, 2.5] }";

const std::vector<Machine> machines{
    {"paper's rotor, 2.4", "paper/table-2-omega-2.4.toml", {}},
    {"motor", "paper-rotor-with-motor.toml", {}},
    {"weak motor, balls held", "paper-rotor-with-motor.toml", {"speed.torque.stall=0.03", "release.speed=1.5"}},
    {"motor, gravity", "paper-rotor-with-motor.toml", {"rotor.gravity=0.002"}},
    {"motor, unequal supports", "paper-rotor-with-motor.toml", {"rotor.stiffness=[1.0, 1.2]"}},
    {"motor, off-centre race", "paper-rotor-with-motor.toml", {"balancer.race_offset=[0.001, 0.0005]"}},
    {"motor, balls that roll", "paper-rotor-with-motor.toml", {"balancer.rolls=true", "balancer.ball_radius=0.1"}},
    {"gravity", "paper/table-2-omega-3.0.toml", {"rotor.gravity=0.002"}},
    {"off-centre race", "paper/table-2-omega-2.4.toml", {"balancer.race_offset=[0.001, 0.0]"}},
    {"captured at resonance", "captured-at-resonance.toml", {}},
    {"balls that touch", "paper/table-2-omega-2.4.toml", {"balancer.contact_angle=0.3", "balancer.restitution=0.5"}},
    {"balls that stick", "paper/table-2-omega-2.4.toml", {"balancer.rolling=0.001"}},
    {"angle grinder", "examples/angle-grinder.toml", {}},
    {"motor, touch and stick", "paper-rotor-with-motor.toml", {"balancer.contact_angle=0.3", "balancer.rolling=0.001"}},
    // Each start has its own values.
    {"unbalance", "paper/table-2-omega-2.4.toml", {unbalance}},
    {"five values", "paper/table-2-omega-2.4.toml", {narrow, damping, mass, drag, speed}},
    {"fast, unbalance", "paper/table-2-omega-4.0.toml", {unbalance}},
    {"ramp, unbalance, drag", "paper/table-3-t0-100.toml", {unbalance, drag}},
    {"motor, unbalance", "paper-rotor-with-motor.toml", {unbalance}},
    {"motor, torque, drag", "paper-rotor-with-motor.toml", {"speed.torque.stall={ uniform = [0.05, 0.2] }", drag}},
    {"gravity, unbalance", "paper/table-2-omega-3.0.toml", {"rotor.gravity=0.002", unbalance}},
    {"unequal supports", "paper/table-2-omega-3.0.toml", {"rotor.stiffness=[1.0, 1.2]", unbalance}},
    {"three balls, unbalance", "paper/table-2-omega-3.0.toml", {"balancer.balls=3", unbalance, mass}},
    {"touch, unbalance", "paper/table-2-omega-2.4.toml", {"balancer.contact_angle=0.3", unbalance}},
};

LookTimes look_times(const Study& study, const Ensemble& ensemble, double longer, MachineAudit& audit) {
  const std::vector<double> decided = ensemble.decision_times(study);
  LookTimes times;
  times.length = window_length(study);
  if (decided.empty()) return times;
  audit.decided = decided.size();
  audit.usual = decided[decided.size() * 9 / 10];
  // The slowest, a few of many, are followed twice as long as they took.
  times.second = std::max(longer * audit.usual, 2.0 * decided.back() + 2.0 * times.length);
  times.first = std::max(0.5 * times.second, 1.02 * decided.back());
  audit.looked = times.second;
  return times;
}

}  // namespace

std::size_t machine_count() { return machines.size(); }

std::string machine_label(std::size_t k) { return machines[k].label; }

Study machine_study(std::size_t k) {
  return read_study(std::string(EQUIPOISE_SOURCE_DIR "/studies/") + machines[k].study, machines[k].overrides);
}

MachineAudit audit_machine(std::size_t k, std::uint64_t starts, const Settings& settings) {
  const double begin = cpu_seconds();
  const Study study = machine_study(k);
  MachineAudit audit;
  audit.label = machine_label(k);
  audit.starts = starts;
  BasinOptions options;
  options.threads = settings.threads;
  const Ensemble ensemble = run_ensemble(study, starts, options);
  audit.undecided_share = ensemble.result.undecided.share;
  const LookTimes times = look_times(study, ensemble, settings.longer, audit);
  const Study with_end = with_horizon(study);
  const std::optional<StudyFamily> family =
      study.uncertain.empty() ? std::nullopt : std::optional<StudyFamily>(with_end);
  constexpr std::uint64_t part = 20000;  // held in memory at a time
  for (std::uint64_t first = 0; first < starts && audit.decided > 0; first += part) {
    const auto count = static_cast<std::size_t>(std::min(part, starts - first));
    const std::vector<LateMotion> late = follow_late(study, first, count, times, settings.threads);
    for (std::size_t j = 0; j < count; ++j) {
      const std::size_t i = first + j;
      if (!ensemble.decided(i)) continue;
      const std::string against =
          contradiction(family ? own_rotor_start(*family, with_end, i).study : study, ensemble, i, late[j], times);
      if (against.empty()) continue;
      if (audit.wrong++ == 0)
        audit.first = fmt::format("start {} is \"{}\" at {:.0f}, but at {:.0f} {}", i, ensemble.name(i),
                                  ensemble.outcomes[i].time, times.second, against);
    }
  }
  audit.seconds = cpu_seconds() - begin;
  return audit;
}

std::string machine_head() {
  return fmt::format("{:24} {:>8} {:>8} {:>7} {:>7} {:>9} {:>8} {:>6}\n", "machine", "starts", "decided", "open %",
                     "usual t", "looked t", "CPU s", "wrong");
}

std::string machine_line(const MachineAudit& a) {
  std::string line = fmt::format("{:24} {:8} {:8} {:7.2f} {:7.0f} {:9.0f} {:8.0f} {:6}\n", a.label, a.starts, a.decided,
                                 100.0 * a.undecided_share, a.usual, a.looked, a.seconds, a.wrong);
  if (!a.first.empty()) line += "  " + a.first + "\n";
  return line;
}

}  // namespace equipoise::audit

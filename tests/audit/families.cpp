// Makes a search for every rotor drawn.
#include "families.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <span>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "equipoise/classification/rotor_family/horizon.hpp"
#include "equipoise/classification/start_runs/session.hpp"
#include "late_motion.hpp"
#include "machines.hpp"

namespace equipoise::audit {

namespace {

constexpr std::uint64_t drawn_starts = 50000;  // over all values
constexpr std::uint64_t most_rotors = 200;     // number of rotors whose shares are averaged,
constexpr std::size_t starts_of_rotor = 1000;  // with this many starts each

using Shares = std::map<std::string, double>;

// Decides starts of one rotor, known exactly, as basin() does.
class KnownRotor {
 public:
  explicit KnownRotor(const Study& study) : session_(study, {}), catalogue_(session_) {}

  std::string kind(const InitialState& start) {
    Decided decided;
    session_.decide({&start, 1}, decided);
    return settled(decided).front();
  }

  // Shares of starts that no other rotor is asked about.
  Shares shares(std::uint64_t rotor) {
    Decided decided;
    session_.decide(rotor * starts_of_rotor, starts_of_rotor, decided);
    Shares shares;
    for (const std::string& kind : settled(decided)) shares[kind] += 1.0 / starts_of_rotor;
    return shares;
  }

  // Whether neighbouring starts end otherwise: on both sides of each ball, at distances to which two integrations of
  // one start may diverge on a long way.
  bool ends_otherwise_beside(const InitialState& start, int balls) {
    const std::string here = kind(start);
    for (const double aside : {1e-6, -1e-6, 1e-5, -1e-5, 1e-4, -1e-4})
      for (int i = 0; i < balls; ++i) {
        InitialState beside = start;
        beside.phi[i] += aside;
        if (kind(beside) != here) return true;
      }
    return false;
  }

 private:
  std::vector<std::string> settled(Decided& decided) {
    catalogue_.settle(decided);
    std::vector<std::string> kinds;
    for (const Outcome& outcome : decided.outcomes) {
      const Attractor* a = outcome.kind == OutcomeKind::attracted ? catalogue_.find(outcome.attractor) : nullptr;
      kinds.push_back(a ? kind_of_name(a->name) : name_of(outcome.kind));
    }
    return kinds;
  }

  const Session session_;
  RunCatalogue catalogue_;
};

// A kind's share over all values, and the mean over rotors, both with their errors.
void compare(const Ensemble& drawn, const std::vector<Shares>& rotors, FamilyAudit& audit) {
  const double n = static_cast<double>(drawn.outcomes.size()), m = static_cast<double>(rotors.size());
  Shares all;
  for (const auto& [kind, count] : drawn.kinds()) all[kind] = static_cast<double>(count) / n;
  for (const Shares& one : rotors)
    for (const auto& [kind, share] : one) all.try_emplace(kind, 0.0);
  for (const auto& [kind, share] : all) {
    double sum = 0.0, squares = 0.0;
    for (const Shares& one : rotors) {
      const auto at = one.find(kind);
      const double s = at == one.end() ? 0.0 : at->second;
      sum += s;
      squares += s * s;
    }
    const double mean = sum / m;
    // A kind that no rotor showed may be all that a few others do.
    const double between = sum > 0.0 ? std::max(0.0, squares / m - mean * mean) / std::max(1.0, m - 1.0) : share / m;
    // A kind that one of the two never showed still has an error.
    const double least = 1.0 / n, error = std::sqrt(between + std::max(share * (1.0 - share), least) / n);
    const double deviation = (share - mean) / error;
    if (std::fabs(deviation) < std::fabs(audit.deviation)) continue;
    audit.deviation = deviation;
    audit.kind = kind;
    audit.drawn = share;
    audit.known = mean;
  }
}

}  // namespace

FamilyAudit audit_family(std::size_t k, std::uint64_t starts, const Settings& settings) {
  const double begin = cpu_seconds();
  const Study study = with_horizon(machine_study(k));
  const StudyFamily family(study);
  FamilyAudit audit;
  audit.label = machine_label(k);
  audit.starts = starts;
  audit.rotors = std::min(most_rotors, starts);
  BasinOptions options;
  options.threads = settings.threads;
  const Ensemble drawn = run_ensemble(study, std::max(starts, drawn_starts), options);
  std::vector<Shares> rotors(audit.rotors);
  std::mutex counting;
  std::uint64_t first = starts;
  tbb::task_arena arena(settings.threads);
  arena.execute([&] {
    tbb::parallel_for(std::uint64_t{0}, starts, [&](std::uint64_t i) {
      const OwnRotorStart own = own_rotor_start(family, study, i);
      KnownRotor known(own.study);
      if (i < audit.rotors) rotors[i] = known.shares(i);
      const std::string here = drawn.kind(i), there = known.kind(own.start), open = name_of(OutcomeKind::undecided);
      const bool same = here == there, undecided = here == open || there == open;
      const bool beside = !same && !undecided && known.ends_otherwise_beside(own.start, study.parameters.balls);
      const std::scoped_lock lock(counting);
      audit.same += same && !undecided;
      audit.open += undecided;
      audit.boundary += beside;
      if (same || undecided || beside) return;
      ++audit.different;
      if (i > first) return;
      first = i;
      audit.first = fmt::format("start {} is \"{}\", and \"{}\" of the rotor known exactly", i, here, there);
    });
  });
  compare(drawn, rotors, audit);
  audit.seconds = cpu_seconds() - begin;
  return audit;
}

std::string family_head() {
  return fmt::format("{:24} {:>6} {:>6} {:>5} {:>8} {:>9} {:>6} {:>9} {:>7}  {}\n", "machine", "starts", "same", "open",
                     "boundary", "different", "rotors", "deviation", "CPU s", "share that deviates most");
}

std::string family_line(const FamilyAudit& a) {
  std::string line = fmt::format("{:24} {:6} {:6} {:5} {:8} {:9} {:6} {:9.2f} {:7.0f}  {}: {:.2f} %, known {:.2f} %\n",
                                 a.label, a.starts, a.same, a.open, a.boundary, a.different, a.rotors, a.deviation,
                                 a.seconds, a.kind, 100.0 * a.drawn, 100.0 * a.known);
  if (!a.first.empty()) line += "  " + a.first + "\n";
  return line;
}

}  // namespace equipoise::audit

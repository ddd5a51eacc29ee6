// What an ensemble comes to for those who have to decide whether to fit the balancer: the first lines of every answer.
// This room: the verdict, what standards make of a machine, and the usual changes, each tried.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "equipoise/core/running/run_options.hpp"
#include "equipoise/report/text/table_text.hpp"
#include "equipoise/results/commands/basin_result.hpp"

namespace equipoise {

enum class Decision {
  fit,         ///< it meets the requirements
  not_needed,  ///< so does the rotor without balls
  caution,     ///< it does once settled, but vibrates more on the way than the rotor without balls
  change,      ///< it does too rarely, but is of use
  do_not_fit,  ///< the rotor is better off without it
  open,        ///< too few starts, or too many undecided, to say
};
inline constexpr std::array<const char*, 6> decision_names{"fit",    "not_needed", "caution",
                                                           "change", "do_not_fit", "open"};

/// Judged by the limits of the study: the balancer fits if the share of starts that meet all of them, on the way and at
/// the end, certainly reaches limits.share. Without limits: if in nine starts of ten the RMS velocity at the end is at
/// most half of that without balls. Each start is compared with its own rotor. Peaks count as larger from a tenth on.
/// Below the critical speed, neither limits nor starts matter.
struct BalancerVerdict {
  Decision decision = Decision::open;
  std::string words;       ///< "Fit it.", with a reason
  std::string because;     ///< why: the deciding number with its interval, and that without balls
  std::string change;      ///< the most useful change; a hint where none was tried
  bool leave_out = false;  ///< the machine needs none, or none can help

  /// Whether a change of the balancer is worth trying: not for one that meets the requirements or is not judged yet.
  bool asks_for_changes() const {
    return !leave_out &&
           (decision == Decision::caution || decision == Decision::change || decision == Decision::do_not_fit);
  }
};

/// One change of the balancer, tried on starts of its own.
struct TriedChange {
  std::string words;                        ///< "twice the drag"
  Study study;                              ///< with it
  std::uint64_t starts = 0;                 ///< tried
  Decision decision = Decision::open;       ///< on it
  std::optional<Share> kept;                ///< of starts that meet every limit; empty without limits
  QuantileEstimate end_velocity;            ///< RMS, 90 % of starts below; R omega_c
  QuantileEstimate peak;                    ///< displacement, 90 % of starts below; R
  double seconds = 0.0, cpu_seconds = 0.0;  ///< search included
};
/// What a result with the change shows, if it can be judged.
std::optional<TriedChange> tried_change(std::string words, const BasinResult& with_it);
/// Whether `a` serves better: by decision, then by the share that meets the limits, otherwise by velocity at the end.
bool serves_better(const TriedChange& a, const TriedChange& b);
/// Whether more starts might show that `a` does: their intervals overlap, or its decision is better.
bool may_serve_better(const TriedChange& a, const TriedChange& b);

/// Empty if there is nothing to compare with: an ensemble without transients, or too small for figures. `tried`: the
/// verdict's last line names the best of them.
std::optional<BalancerVerdict> verdict_of(const BasinResult& result, std::span<const TriedChange> tried = {});

/// Says why, and that no start has to be followed to know it.
inline constexpr char leave_balancer_out[] = "Leave the balancer out: {}.";
inline constexpr char by_linear_theory[] = "By linear theory; no start has to be followed for that.";

/// "the rotor runs at 1000 rpm, below its critical speed of ...", to follow "Leave the balancer out: "; empty unless
/// runs_below_resonance().
std::string below_resonance_words(const Study& study);

/// The tone in which a decision is shown.
Tone tone_of(Decision decision);
/// The changes that were tried, best first, at most `most` of them, and below them the balancer as it is: the share
/// that keeps the limits, or without limits the velocity at the end, and the peak, both 90 % of starts below. Of a
/// result that has a verdict.
DocumentTable changes_table(const BasinResult& result, std::span<const TriedChange> tried, std::size_t most = 8);

/// The verdict, why, and what to try next.
Notice verdict_notice(const BalancerVerdict& verdict);
/// That as text, and the empty line after it.
std::string verdict_text(const BalancerVerdict& verdict, const TextStyle& style = wide_style);

// The changes of a balancer that an engineer would try first, each tried.

/// Starts on which each change is tried: if all meet the limits, 96 % do (95 % confidence).
inline constexpr std::uint64_t starts_of_a_change = 100;
/// The first of them. A change that certainly fails on these is tried on all only if it may still be the best.
inline constexpr std::uint64_t starts_of_a_look = 32;

/// A study with one thing changed, with this many random starts, and what the change is: "twice the drag".
struct Change {
  std::string words;
  Study study;
};

/// Drag twice and half, more and fewer balls, larger and smaller ones, a latch that holds the balls until well above
/// resonance, a faster run-up: those that make a valid study. None for a study with uncertain values, whose draws
/// cannot be changed in it, or without balls.
std::vector<Change> usual_changes(const Study& study);

/// No further change is begun after this many seconds of CPU time; one that then runs is given up a little later, as is
/// one that takes longer than the others, because an answer is wanted within a minute. So the number of changes tried
/// may depend on the machine, but what each is worth does not.
inline constexpr double seconds_for_changes = 30.0, longest_for_changes = 45.0, longest_for_a_change = 15.0;

/// Tries the usual changes on the study's first starts, in order, up to the first that makes the balancer fit. Each has
/// starts_of_a_change starts or, if it certainly fails and is not the best, starts_of_a_look. If stopped, returns what
/// is done. Progress counts changes.
std::vector<TriedChange> try_changes(const Study& study, const RunOptions& options = {});
/// The same for a result's study, if its verdict asks for it: none for a balancer that meets the requirements, is not
/// needed or is not judged yet, nor for a stopped result.
std::vector<TriedChange> changes_asked_for(const BasinResult& result, const RunOptions& options = {});

}  // namespace equipoise

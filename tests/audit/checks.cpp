// The checks, in the order in which a study's time is spent.
#include "checks.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "claims.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "figures.hpp"
#include "late_motion.hpp"
#include "same_study.hpp"

namespace equipoise::audit {

const std::array<const char*, column_count> column_names{"later",     "horizon",  "proof",    "rotated",
                                                         "mirror",    "order",    "physical", "threads",
                                                         "processor", "replayed", "figures",  "undecided"};

bool StudyAudit::failed() const {
  return std::any_of(checks.begin(), checks.end(), [](const Check& c) { return c.verdict == Verdict::failed; });
}

namespace {

// Two independent samples of one law differ this much less than once in ten audits (40 studies, two comparisons, about
// four kinds).
constexpr double improbable = 3e-4;
// For the same trajectories except for roundings: those that pass a boundary of basins may go either way. With chaotic
// transients that may be a few in a hundred.
constexpr double boundary_share = 0.04;
constexpr std::size_t boundary_starts = 4;
// Beyond this share of undecided starts, a result must say why.
constexpr double many_undecided = 0.2;

class StudyChecks {
 public:
  StudyChecks(const DrawnStudy& drawn, const Settings& settings)
      : settings_(settings), study_(drawn.study), begin_(cpu_seconds()) {
    audit_.drawn = drawn;
    starts_ = is_machine() ? settings.machine_starts : settings.starts;
  }

  StudyAudit run() {
    try {
      base_ = run_ensemble(study_, starts_, options());
    } catch (const InputError& refusal) {
      audit_.refused = refusal.what();
      return finish();
    }
    describe();
    using Member = void (StudyChecks::*)();
    const std::array<Member, 11> members{
        &StudyChecks::check_later,   &StudyChecks::check_horizon,  &StudyChecks::check_figures,
        &StudyChecks::check_replay,  &StudyChecks::check_rotation, &StudyChecks::check_mirror,
        &StudyChecks::check_proof,   &StudyChecks::check_order,    &StudyChecks::check_physical,
        &StudyChecks::check_threads, &StudyChecks::check_processor};
    // Time runs out at a different check in each study, so that no check is always skipped.
    constexpr std::size_t always = 4;
    for (std::size_t k = 0; k < members.size(); ++k) {
      const std::size_t rest = members.size() - always, turn = static_cast<std::size_t>(audit_.drawn.number);
      const Member member = members[k < always ? k : always + (k - always + turn) % rest];
      if (k < always || cpu_seconds() - begin_ < settings_.seconds) (this->*member)();
    }
    return finish();
  }

 private:
  // Followed from event to event.
  bool is_machine() const { return !study_.system().simple(); }

  StudyAudit finish() {
    audit_.seconds = cpu_seconds() - begin_;
    return audit_;
  }

  BasinOptions options() {
    BasinOptions options;
    options.threads = settings_.threads;
    options.searches = &searches_;
    return options;
  }

  void describe() {
    std::vector<std::pair<std::uint64_t, std::string>> kinds;
    for (const auto& [kind, count] : base_.kinds()) kinds.emplace_back(count, kind);
    std::sort(kinds.rbegin(), kinds.rend());
    for (const auto& [count, kind] : kinds)
      audit_.answer += fmt::format("{}{} {:.0f} %", audit_.answer.empty() ? "" : ", ", kind,
                                   100.0 * static_cast<double>(count) / static_cast<double>(base_.outcomes.size()));
    const Share& undecided = base_.result.undecided;
    audit_.undecided_share = undecided.share;
    Check& check = audit_.at(Column::undecided);
    check = Check::passed(fmt::format("{:.0f} %", 100.0 * undecided.share));
    if (undecided.share > many_undecided && !note_says("ndecided"))
      check.fail(fmt::format("{:.0f} % undecided, and no note says why", 100.0 * undecided.share), command(""));
  }

  // Whether a note in the result contains these letters.
  bool note_says(const char* letters) const {
    std::istringstream lines(basin_text(base_.result));
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("Note:") && line.find(letters) != std::string::npos) return true;
    return false;
  }

  // The program's command for the study; writes the study file that it needs.
  std::string command(const std::string& arguments, const Study* other = nullptr, const char* suffix = "") {
    const Study& study = other ? *other : study_;
    std::string name = std::filesystem::path(study_.name).stem().string() + suffix + ".toml";
    if (!settings_.folder.empty()) {
      std::filesystem::create_directories(settings_.folder);
      name = settings_.folder + "/" + name;
      std::ofstream(name) << to_toml(study);
    }
    return fmt::format("equipoise basin {} --starts {}{}{}", name, starts_, arguments.empty() ? "" : " ", arguments);
  }

  std::string replay(std::size_t start) { return command(fmt::format("--start-index {}", start)); }

  // Starts are followed `longer` times as long as nine in ten took to be decided, and twice as long as the slowest
  // took, within the study's share of time.
  void check_later() {
    Check& check = audit_.at(Column::later);
    const std::vector<double> decided = base_.decision_times(study_);
    if (decided.empty()) return;
    const double most = decided.back(), usual = decided[decided.size() * 9 / 10];
    const std::size_t count = std::min<std::size_t>(base_.outcomes.size(), is_machine() ? 100 : 200);
    // Time units of one trajectory that a core computes in a share of time.
    const double reach = settings_.seconds * (is_machine() ? 2e4 : 4e5) / static_cast<double>(count);
    LookTimes times;
    times.length = window_length(study_);
    times.second =
        std::clamp(settings_.longer * usual, 2.0 * most + 2.0 * times.length, std::max(reach, 2.5 * most + 500.0));
    times.first = std::max(0.5 * times.second, 1.02 * most);
    const std::vector<LateMotion> late = follow_late(study_, 0, count, times, settings_.threads);
    std::size_t judged = 0, wrong = 0;
    std::map<std::string, int> told;  // one fault of each kind
    for (std::size_t i = 0; i < count; ++i) {
      if (!base_.decided(i)) continue;
      ++judged;
      const std::string against = contradiction(study_, base_, i, late[i], times);
      if (against.empty()) continue;
      ++wrong;
      if (told[base_.kind(i)]++ == 0)
        check.fail(fmt::format("start {} is \"{}\" at {:.0f}, but at {:.0f} {}", i, base_.name(i),
                               base_.outcomes[i].time, times.second, against),
                   replay(i));
    }
    if (check.verdict != Verdict::failed) check.verdict = Verdict::passed;
    check.seen = fmt::format("{} of {}, x{:.0f}", judged - wrong, judged, times.second / std::max(usual, 1.0));
  }

  void check_horizon() {
    Check& check = audit_.at(Column::horizon);
    const std::uint64_t count = is_machine() ? std::min<std::uint64_t>(starts_, 60) : starts_;
    const Study longer =
        parse_study(to_toml(study_), study_.name,
                    {"numerics.decide=horizon", fmt::format("numerics.horizon={:.1f}", long_horizon())});
    const Ensemble followed = run_ensemble(longer, count, options());
    const Pairs pairs = compare_pairs(base_, followed, false);
    std::size_t lost = 0;
    for (std::size_t i = 0; i < count; ++i) lost += base_.decided(i) && !followed.decided(i);
    check = Check::passed(fmt::format("{} of {}{}", pairs.compared - pairs.differ, pairs.compared,
                                      lost ? fmt::format(", {} open", lost) : ""));
    const std::size_t at = pairs.first_difference;
    if (pairs.differ)
      check.fail(fmt::format("{} starts are something else at the horizon: start {} is \"{}\", then \"{}\"",
                             pairs.differ, at, base_.name(at), followed.name(at)),
                 replay(at) + fmt::format(" --decide horizon --set numerics.horizon={:.1f}", long_horizon()));
  }

  double long_horizon() const {
    const std::vector<double> decided = base_.decision_times(study_);
    const double most = decided.empty() ? 0.0 : decided.back();
    return std::clamp(3.0 * most, 9000.0, 60000.0);
  }

  void check_proof() {
    if (is_machine() || model::depends_on_rotor_angle(study_.parameters) || study_.parameters.balls > 2) return;
    const Study by_proof = parse_study(to_toml(study_), study_.name, {"numerics.decide=proof"});
    same_starts(Column::proof, run_ensemble(by_proof, starts_, options()), 0, "decided by proof", "--decide proof");
  }

  // The same trajectories: at most `allowed` starts may differ.
  void same_starts(Column column, const Ensemble& other, std::size_t allowed, const std::string& what,
                   const std::string& arguments) {
    Check& check = audit_.at(column);
    const Pairs pairs = compare_pairs(base_, other, false);
    check = Check::passed(fmt::format("{} of {}", pairs.compared - pairs.differ, pairs.compared));
    const std::size_t at = pairs.first_difference;
    if (pairs.differ > allowed)
      check.fail(fmt::format("{} of {} starts differ {}: start {} is \"{}\", then \"{}\"", pairs.differ, pairs.compared,
                             what, at, base_.name(at), other.name(at)),
                 command(arguments));
    const double more = other.result.undecided.share - base_.result.undecided.share;
    const bool other_grounds = column == Column::proof;  // decides later by its nature
    if (!other_grounds && std::fabs(more) > 2.0 * boundary_share + 0.02)
      check.fail(fmt::format("{:.0f} % undecided, {} {:.0f} %", 100.0 * base_.result.undecided.share, what,
                             100.0 * other.result.undecided.share),
                 command(arguments));
  }

  std::size_t at_boundaries(const Ensemble& other) const {
    return boundary_starts + static_cast<std::size_t>(boundary_share * static_cast<double>(other.outcomes.size()));
  }

  // Without gravity and with equal supports nothing depends on the rotor's angle. On lanes results are bit-identical;
  // for a machine the angle is a state with its own rounding.
  void check_rotation() {
    if (model::depends_on_rotor_angle(study_.parameters)) return;
    Study turned = study_;
    turned.initial.psi += 2.1;
    const Ensemble other = run_ensemble(turned, starts_, options());
    same_starts(Column::rotated, other, is_machine() ? at_boundaries(other) : 0, "with the rotor turned",
                fmt::format("--set initial.psi={:.17g}", turned.initial.psi));
  }

  void same_shares(Column column, const Study& other, const char* what, const char* suffix) {
    Check& check = audit_.at(column);
    // The mirrored study has other starts: these are two samples.
    const Ensemble ensemble = run_ensemble(other, starts_, options());
    const SharesApart apart = compare_shares(base_, ensemble);
    check = Check::passed(fmt::format("p {:.2g}", apart.probability));
    if (apart.probability < improbable)
      check.fail(
          fmt::format("\"{}\" {:.0f} %, {} {:.0f} %", apart.kind, 100.0 * apart.first, what, 100.0 * apart.second),
          command("") + " ; " + command("", &other, suffix));
  }

  void check_mirror() {
    const std::optional<Study> other = mirrored(study_);
    if (other) same_shares(Column::mirror, *other, "mirrored", "-mirrored");
  }

  void check_order() {
    if (study_.parameters.balls == 1) return;
    if (study_.parameters.equal_balls()) return exchange_balls();
    same_shares(Column::order, reversed(study_), "with its balls in the opposite order", "-reversed");
  }

  // Equal balls that exchange their angles exchange their motions.
  void exchange_balls() {
    Check& check = audit_.at(Column::order);
    check = Check::passed("exchanged");
    const double until = (study_.speed.driven() ? 0.0 : study_.release_time()) + 20.0;
    for (std::uint64_t i = 0; i < 3; ++i) {
      Study one = study_;
      one.initial = start_of(study_, study_.sampling.seed, i);
      const Trajectory a = simulate(one, {until}), b = simulate(reversed(one), {until});
      if (a.t.empty() != b.t.empty()) check.fail("one order of balls is lost, the other not", replay(i));
      if (a.t.empty() || b.t.empty()) continue;
      const std::size_t balls = a.phi.size();
      double apart = std::fabs(a.radial[0] - b.radial[0]);
      for (std::size_t k = 0; k < balls; ++k) apart = std::max(apart, std::fabs(a.phi[k][0] - b.phi[balls - 1 - k][0]));
      // Steps of 1e-12, amplified over twenty units of time and some impacts.
      if (!(apart < 1e-6))
        check.fail(fmt::format("exchanged balls are {:.2g} apart at {:.0f}", apart, until), replay(i));
    }
  }

  void check_physical() {
    Check& check = audit_.at(Column::physical);
    const model::Scales scales{2.5, 0.04, 60.0};
    const std::optional<std::string> text = physical_text(study_, scales);
    if (!text) return;
    const Study physical = parse_study(*text, study_.name);
    const std::string differ = numbers_differ(study_, physical);
    BasinOptions with_transients = options();
    with_transients.transients = true;
    const Ensemble other = run_ensemble(physical, starts_, with_transients);
    const Ensemble again = run_ensemble(study_, starts_, with_transients);
    same_starts(Column::physical, other, at_boundaries(other), "in SI units", "");
    if (!differ.empty()) check.fail("numbers differ: " + differ, command("", &physical, "-physical"));
    for (const Ensemble* e : {&again, &other})
      for (const std::string& fault : impossible_figures(e->result))
        audit_.at(Column::figures).fail(fault, command("--transients"));
    for (const std::string& fault : wrong_units(again.result, other.result))
      check.fail(fault, command("--transients", &physical, "-physical"));
  }

  void check_threads() {
    BasinOptions one = options(), three = options();
    one.searches = three.searches = nullptr;  // results of the search must not depend on threads either
    one.threads = 1;
    three.threads = 3;
    const std::uint64_t count = std::min<std::uint64_t>(starts_, 64);
    const Ensemble a = run_ensemble(study_, count, one), b = run_ensemble(study_, count, three);
    Check& check = audit_.at(Column::threads);
    check = Check::passed("same bits");
    for (std::size_t i = 0; i < a.outcomes.size(); ++i) {
      const Outcome &x = a.outcomes[i], &y = b.outcomes[i];
      if (x.kind != y.kind || x.by != y.by || x.attractor != y.attractor || x.time != y.time) {
        check.fail(fmt::format("start {}: \"{}\" at {} on one thread, \"{}\" at {} on three", i, a.name(i), x.time,
                               b.name(i), y.time),
                   command("--threads 1") + " ; --threads 3");
        return;
      }
    }
  }

  void check_processor() {
    const std::vector<std::string> targets = cpu_targets();
    if (targets.size() < 2 || is_machine()) return;  // machines run in plain doubles everywhere
    // At most half as fast: fewer starts, with the list of motions already found.
    const std::uint64_t count = std::min<std::uint64_t>(starts_, 100);
    const std::string& target = targets[1 + static_cast<std::size_t>(audit_.drawn.number) % (targets.size() - 1)];
    use_cpu_target(target);
    const Ensemble other = run_ensemble(study_, count, options());
    use_cpu_target("");
    same_starts(Column::processor, other, at_boundaries(other), "on " + target, "--cpu " + target);
  }

  void check_replay() {
    Check& check = audit_.at(Column::replayed);
    check = Check::passed("3 of 3");
    for (const std::size_t i : {std::size_t{0}, base_.outcomes.size() / 2, base_.outcomes.size() - 1}) {
      const StartReplay again = replay_start(study_, i, options());
      const Outcome &x = base_.outcomes[i], &y = again.outcome;
      const std::string name = y.kind == OutcomeKind::attracted ? again.name : base_.name(i);
      if (x.kind != y.kind || x.time != y.time || x.by != y.by || name != base_.name(i))
        check.fail(
            fmt::format("start {} is \"{}\" at {}, replayed \"{}\" at {}", i, base_.name(i), x.time, name, y.time),
            replay(i));
    }
  }

  void check_figures() {
    Check& check = audit_.at(Column::figures);
    check = Check::passed("");
    for (const std::string& fault : impossible_figures(base_.result)) check.fail(fault, command(""));
  }

  const Settings& settings_;
  Study study_;
  double begin_;
  std::uint64_t starts_ = 0;
  AttractorSearchCache searches_;
  Ensemble base_;
  StudyAudit audit_;
};

}  // namespace

StudyAudit audit_study(const DrawnStudy& drawn, const Settings& settings) { return StudyChecks(drawn, settings).run(); }

}  // namespace equipoise::audit

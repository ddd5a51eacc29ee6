// Searches at every value, follows both ways, lets branches meet, looks beyond their ends, names them.
#include "equipoise/analyses/continuation/continuation.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

#include "equipoise/analyses/continuation/branch_follower.hpp"
#include "equipoise/core/running/parallel.hpp"
#include "equipoise/core/running/run_info.hpp"
#include "equipoise/simulation/kernels/long_call.hpp"

namespace equipoise {

namespace {

// A branch in the making: its motions by index of the value, and how it ended on either side.
struct Track {
  std::map<std::size_t, Motion> points;
  std::optional<Advance> low, high;  // empty where the line ends or the search was stopped
};

// One way from a motion.
struct Way {
  std::map<std::size_t, Motion> points;  // without the first
  std::optional<Advance> end;
  int joins = -1;  // the track that it became part of
};

// A motion from which a branch starts.
struct Origin {
  std::size_t at = 0;
  Motion motion;
  std::string family;
  Way down, up;
};

// A state that may lead to something new at a value.
struct Lead {
  std::size_t at = 0;
  Eigen::VectorXd state;
  std::optional<Motion> motion;
};

class Continuation {
 public:
  Continuation(const Study& study, const ParameterLine& line, const ContinuationOptions& options)
      : line_(line),
        options_(options),
        starts_(options.starts > 0 ? options.starts : along_starts),
        follower_(line, starts_, options.stop),
        threads_(thread_count(options.threads)) {
    result_.study = study;
    for (std::size_t k = 0; k < line.values().size(); ++k) {
      values_.push_back(line.values()[k]);
      asked_.push_back(true);
      // Checking the study half-way is expensive where balance is a continuum under gravity.
      if (const auto between = is_set(options.stop) ? std::nullopt : line.half_way(k)) {
        values_.push_back(*between);
        asked_.push_back(false);
      }
    }
    found_.resize(values_.size());
    commonest_.resize(values_.size());
  }

  BranchesResult run() {
    const RunClock clock;
    for (const double value : values_) systems_.push_back(line_.system_at(value));
    search();
    while (!follower_.stopped() && follow_new()) {
    }
    result_.partial = follower_.stopped();
    if (result_.partial) gather_rest();
    locate_and_name();
    leave_out_unasked();
    result_.key = line_.key();
    result_.step = line_.step();
    result_.starts = starts_;
    note_machine(result_, options_);
    result_.took(clock.time());
    return std::move(result_);
  }

 private:
  void report(std::uint64_t total, const char* what) {
    const std::lock_guard lock(mutex_);
    if (++done_ <= total && options_.progress) options_.progress({done_, total, what, {}});
  }

  void search() {
    in_parallel(threads_, found_.size(), [&](std::size_t k) {
      if (follower_.stopped()) return;
      ValueSearch there = attractors_at(line_.study_at(values_[k]), starts_, options_.warm_start_states, options_.stop);
      found_[k] = std::move(there.motions);
      commonest_[k] = std::move(there.commonest);
      report(found_.size(), "values searched");
    });
  }

  bool is_on(const Track& track, std::size_t k, const Motion& motion) const {
    const auto at = track.points.find(k);
    if (at == track.points.end()) return false;
    const model::Parameters& p = systems_[k].parameters();
    const auto like = [](const Motion& m) { return is_restless(m) || may_be_locked(m); };
    return same_motion(p, at->second, motion) ||
           (at->second.stable && motion.stable && like(at->second) && like(motion) &&
            (is_restless(at->second) || is_restless(motion)) && resembles(p, at->second, motion));
  }
  int track_of(std::size_t k, const Motion& motion) const {
    for (std::size_t t = 0; t < tracks_.size(); ++t)
      if (is_on(tracks_[t], k, motion)) return static_cast<int>(t);
    return -1;
  }

  // Follows one unlisted motion of every family, both ways. False if there was none.
  bool follow_new() {
    std::vector<Origin> origins;
    std::set<std::string> families;
    for (std::size_t k = 0; k < found_.size(); ++k) {
      for (const Motion& motion : found_[k]) {
        if (track_of(k, motion) >= 0) continue;
        std::string family = family_of(systems_[k].parameters(), motion);
        if (families.insert(family).second) origins.push_back({k, motion, std::move(family), {}, {}});
      }
    }
    done_ = tracks_.size();
    const std::uint64_t total = done_ + 2 * origins.size();
    in_parallel(threads_, 2 * origins.size(), [&](std::size_t i) {
      Origin& origin = origins[i / 2];
      (i % 2 ? origin.up : origin.down) = follow(origin, i % 2 ? 1 : -1);
      report(total, "branches followed");
    });
    std::vector<Lead> leads;
    for (Origin& origin : origins)
      if (track_of(origin.at, origin.motion) < 0)
        settle(origin, leads);  // otherwise it belongs to another origin's
                                // track
    follow_leads(leads);
    return !origins.empty();
  }

  Way follow(const Origin& origin, int direction) const {
    Way way;
    std::size_t k = origin.at;
    const Motion* last = &origin.motion;
    const std::size_t end = direction > 0 ? values_.size() - 1 : 0;
    while (k != end && !follower_.stopped()) {
      const std::size_t next = k + direction;
      const double value = values_[next];
      Advance advance = follower_.advance(*last, values_[k], value);
      if (follower_.stopped()) return way;
      if (advance.arrived) {
        const int track = track_of(next, advance.motion);
        if (track >= 0 && !tracks_[track].points.contains(k)) {
          way.joins = track;
          return way;
        }
        if (track >= 0) {  // it fell onto a branch that existed next to it
          way.end = follower_.narrowed({values_[k], *last, false, value, std::move(advance.motion)});
          if (follower_.stopped()) way.end.reset();
          return way;
        }
        last = &(way.points[next] = std::move(advance.motion));
        k = next;
        continue;
      }
      way.end = std::move(advance);
      return way;
    }
    return way;
  }

  // Starts a new track, or extends one that an origin's way has joined.
  void settle(Origin& origin, std::vector<Lead>& leads) {
    Track track;
    track.low = std::move(origin.down.end);
    track.high = std::move(origin.up.end);
    track.points = std::move(origin.down.points);
    track.points.merge(origin.up.points);
    track.points[origin.at] = std::move(origin.motion);
    note_leads(track, leads);
    for (const auto& [joins, down] : {std::pair{origin.down.joins, true}, std::pair{origin.up.joins, false}}) {
      if (joins < 0) continue;
      Track& other = tracks_[joins];
      const bool overlap = std::any_of(track.points.begin(), track.points.end(),
                                       [&](const auto& point) { return other.points.contains(point.first); });
      if (overlap) continue;
      (down ? other.high : other.low) = down ? track.high : track.low;
      other.points.merge(track.points);
      return;
    }
    tracks_.push_back(std::move(track));
  }

  // Where a branch ends or loses stability, its last stable state may lead to its successor.
  void note_leads(const Track& track, std::vector<Lead>& leads) const {
    const std::size_t first = track.points.begin()->first, last = track.points.rbegin()->first;
    if (track.low && first > 0) leads.push_back({first - 1, track.low->motion.state, {}});
    if (track.high && last + 1 < found_.size()) leads.push_back({last + 1, track.high->motion.state, {}});
    for (auto a = track.points.begin(), b = std::next(a); b != track.points.end(); ++a, ++b) {
      if (a->second.stable && !b->second.stable) leads.push_back({b->first, a->second.state, {}});
      if (!a->second.stable && b->second.stable) leads.push_back({a->first, b->second.state, {}});
    }
  }

  void follow_leads(std::vector<Lead>& leads) {
    in_parallel(threads_, leads.size(), [&](std::size_t i) {
      Lead& lead = leads[i];
      if (!follower_.stopped())
        lead.motion = motion_from(systems_[lead.at], lead.state, motion_patience, options_.stop);
    });
    for (Lead& lead : leads)
      if (lead.motion && lead.motion->stable) found_[lead.at].push_back(std::move(*lead.motion));
  }

  // After a stop: groups the motions not yet followed by name.
  void gather_rest() {
    for (std::size_t k = 0; k < found_.size(); ++k) {
      for (Motion& motion : found_[k]) {
        if (track_of(k, motion) >= 0) continue;
        const std::string family = family_of(systems_[k].parameters(), motion);
        const auto home = std::find_if(tracks_.begin(), tracks_.end(), [&](const Track& track) {
          return !track.points.contains(k) &&
                 family_of(systems_[track.points.begin()->first].parameters(), track.points.begin()->second) == family;
        });
        (home == tracks_.end() ? tracks_.emplace_back() : *home).points[k] = std::move(motion);
      }
    }
  }

  // Where two branches of one name exist at one value, the vote goes to the one that more starts come to there. A
  // branch so has the same identifier whatever part of the line is studied.
  std::vector<std::size_t> count_votes() const {
    std::vector<std::size_t> votes(tracks_.size());
    for (std::size_t k = 0; k < commonest_.size(); ++k) {
      const model::Parameters& p = systems_[k].parameters();
      for (const Motion& motion : commonest_[k]) {
        const int track = track_of(k, motion);
        if (track < 0) continue;
        const auto of_this_name = std::count_if(tracks_.begin(), tracks_.end(), [&](const Track& other) {
          return other.points.contains(k) && family_of(p, other.points.at(k)) == family_of(p, motion);
        });
        if (of_this_name > 1) ++votes[static_cast<std::size_t>(track)];
      }
    }
    return votes;
  }

  void locate_and_name() {
    const std::vector<std::size_t> votes = count_votes();
    struct Gap {
      std::size_t track = 0;
      BranchPoint low, high;
      std::vector<BranchEvent> events;
    };
    std::vector<Gap> gaps;
    std::vector<Branch> branches(tracks_.size());
    for (std::size_t t = 0; t < tracks_.size(); ++t) {
      for (auto& [k, motion] : tracks_[t].points) branches[t].points.push_back({k, values_[k], std::move(motion)});
      const auto& points = branches[t].points;
      const auto &low = tracks_[t].low, &high = tracks_[t].high;
      if (low) gaps.push_back({t, {0, low->value, low->motion}, points.front(), {}});
      for (std::size_t i = 0; i + 1 < points.size(); ++i)
        if (points[i + 1].at == points[i].at + 1) gaps.push_back({t, points[i], points[i + 1], {}});
      if (high) gaps.push_back({t, points.back(), {0, high->value, high->motion}, {}});
    }
    in_parallel(threads_, gaps.size(), [&](std::size_t g) {
      Gap& gap = gaps[g];
      if (gap.low.value < gap.high.value) gap.events = changes_between(follower_, gap.low, gap.high);
    });
    for (std::size_t t = 0; t < tracks_.size(); ++t)
      if (tracks_[t].low) branches[t].events.push_back(end_event(BranchChange::birth, *tracks_[t].low));
    for (Gap& gap : gaps)
      for (BranchEvent& event : gap.events) branches[gap.track].events.push_back(event);
    for (std::size_t t = 0; t < tracks_.size(); ++t)
      if (tracks_[t].high) branches[t].events.push_back(end_event(BranchChange::death, *tracks_[t].high));
    name_branches(systems_, votes, branches);
    result_.branches = std::move(branches);
  }

  // Half-way values stay only where a branch exists that has no others.
  void leave_out_unasked() {
    std::vector<bool> kept = asked_;
    for (const Branch& branch : result_.branches) {
      const auto is_asked = [&](const BranchPoint& point) { return asked_[point.at]; };
      if (std::any_of(branch.points.begin(), branch.points.end(), is_asked)) continue;
      for (const BranchPoint& point : branch.points) kept[point.at] = true;
    }
    std::vector<std::size_t> place(values_.size());
    for (std::size_t k = 0; k < values_.size(); ++k) {
      place[k] = result_.values.size();
      if (kept[k]) result_.values.push_back(values_[k]);
    }
    for (Branch& branch : result_.branches) {
      std::erase_if(branch.points, [&](const BranchPoint& point) { return !kept[point.at]; });
      for (BranchPoint& point : branch.points) point.at = place[point.at];
    }
  }

  BranchEvent end_event(BranchChange change, const Advance& end) const {
    BranchEvent event;
    event.cause = cause_of_end(follower_, end);
    event.change = change;
    if (event.cause == BranchCause::unresolved)
      event.change = change == BranchChange::birth ? BranchChange::first_seen : BranchChange::last_seen;
    event.low = std::min(end.value, end.refused);
    event.high = std::max(end.value, end.refused);
    event.set_excursion(end.motion);
    return event;
  }

  const ParameterLine& line_;
  const ContinuationOptions& options_;
  const std::uint64_t starts_;
  BranchContinuation follower_;
  int threads_;
  std::vector<double> values_;                  // of the line, and half-way between
  std::vector<bool> asked_;                     // by value: whether it belongs to the line
  std::vector<std::vector<Motion>> found_;      // by value
  std::vector<std::vector<Motion>> commonest_;  // by value: of every name the motion of most starts
  std::vector<model::System> systems_;          // by value
  std::vector<Track> tracks_;
  BranchesResult result_;
  std::mutex mutex_;
  std::uint64_t done_ = 0;
};

}  // namespace

BranchesResult follow_attractors(const Study& study, const ParameterLine& line, const ContinuationOptions& options) {
  return long_call(options, [&](const ContinuationOptions& o) { return Continuation(study, line, o).run(); });
}

}  // namespace equipoise

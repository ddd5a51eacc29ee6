// Branches in NetCDF, written in one go.
#include "equipoise/results/result_files/branches_file.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "equipoise/core/base/version.hpp"
#include "equipoise/results/commands/motion_table.hpp"
#include "equipoise/results/commands/outcome_share.hpp"
#include "equipoise/results/io/dataset_file.hpp"

namespace equipoise {

namespace {

using Type = DataColumn::Type;

// Places are values, then attractors. Null where the attractor is not there.
const Motion* motion_at(const BranchesResult& r, std::size_t place) {
  const std::size_t at = place / r.branches.size();
  const std::vector<BranchPoint>& points = r.branches[place % r.branches.size()].points;
  const auto before = [](const BranchPoint& p, std::size_t value) { return p.at < value; };
  const auto point = std::lower_bound(points.begin(), points.end(), at, before);
  return point != points.end() && point->at == at ? &point->motion : nullptr;
}

void add_branches(Dataset& data, std::size_t value, const BranchesResult& r) {
  const auto balls = static_cast<std::size_t>(r.study.parameters.balls);
  const std::size_t attractor = data.dimension("attractor", r.branches.size()), ball = data.dimension("ball", balls);
  const auto id = [&r](std::size_t k) { return static_cast<double>(r.branches[k].id); };
  data.add("id", "1", "identifier, the same along the whole range", {attractor}, id, Type::integer);
  data.add_texts("name", attractor, r.branches, &Branch::name, "name of the attractor");
  data.add_texts("alias", attractor, r.branches, &Branch::alias, name_by_wright_and_peng);
  const auto add_flag = [&](const char* name, const char* meaning, int (*of)(const Motion&), std::vector<int> flags,
                            const char* meanings) {
    const auto flag = [&r, of](std::size_t k) -> double {
      const Motion* motion = motion_at(r, k);
      return motion ? of(*motion) : -1;
    };
    DataColumn& column = data.add(name, "1", meaning, {value, attractor}, flag, Type::byte);
    column.fill = -1;
    column.flags = std::move(flags);
    column.attributes.emplace_back("flag_meanings", meanings);
  };
  const auto kind = [](const Motion& m) { return static_cast<int>(m.kind); };
  add_flag("kind", "kind of motion", kind, {0, 1, 2, 3}, "equilibrium periodic quasi-periodic chaotic");
  const auto stable = [](const Motion& m) { return m.stable ? 1 : 0; };
  add_flag("stable", "whether the motion attracts its neighbourhood", stable, {0, 1}, "unstable stable");
  const auto add_numbers = [&](const auto& numbers) {
    for (const MotionNumber& n : numbers) {
      const auto number = [&r, &n](std::size_t k) {
        const Motion* motion = motion_at(r, k);
        return motion ? n.value(*motion) : no_number;
      };
      data.add(n, {value, attractor}, number).fill = no_number;
    }
  };
  add_numbers(motion_numbers);
  const auto drift = [&r, balls](std::size_t k) {
    const Motion* motion = motion_at(r, k / balls);
    return motion ? motion->drift[k % balls] : no_number;
  };
  data.add("drift", "1", "mean rate of a ball in the rotating frame, radians times omega_c", {value, attractor, ball},
           drift)
      .fill = no_number;
  if (r.study.speed.driven()) add_numbers(motor_numbers);
}

void add_events(Dataset& data, const std::vector<const BranchEvent*>& events) {
  if (events.empty()) return;
  const std::size_t event = data.dimension("event", events.size());
  const auto add = [&](const char* name, const char* meaning, auto BranchEvent::*member, Type type) {
    const auto number = [events, member](std::size_t k) { return static_cast<double>(events[k]->*member); };
    data.add(name, "1", meaning, {event}, number, type);
  };
  add("event_id", "identifier of the attractor to which it happens", &BranchEvent::id, Type::integer);
  const auto change = [](const BranchEvent* e) { return name_of(e->change); };
  data.add_texts("event_change", event, events, change, "what happens");
  const auto cause = [](const BranchEvent* e) { return name_of(e->cause); };
  data.add_texts("event_type", event, events, cause, "type of the bifurcation");
  add("event_low", "it happens above this value of the parameter", &BranchEvent::low, Type::real);
  add("event_high", "it happens below this value of the parameter", &BranchEvent::high, Type::real);
}

}  // namespace

void write_branches_file(const std::string& path, const BranchesResult& result) {
  Dataset data("Attractors of a rotor with an automatic ball balancer along a parameter");
  const std::size_t value = data.dimension("value", result.values.size());
  data.add("value", "1", fmt::format("{}: {}", result.key, parameter_label(result.key)), {value},
           [&result](std::size_t k) { return result.values[k]; });
  std::vector<const BranchEvent*> events;
  for (const Branch& branch : result.branches)
    for (const BranchEvent& e : branch.events) events.push_back(&e);
  if (!result.branches.empty()) add_branches(data, value, result);
  add_events(data, events);
  const std::string study = to_toml(result.study);
  data.say("identity", fmt::format("{}\n# along {}\n# version {}\n", study, result.key, version_string));
  data.say("parameter", result.key);
  data.say("study", study);
  data.say("complete", !result.partial ? "yes" : "no");
  io::write_netcdf_file(path, data);
}

}  // namespace equipoise

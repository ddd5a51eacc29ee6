// Runs that are watched.
#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "calls.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/results/commands/trajectory.hpp"
#include "equipoise/simulation/spin_up/held_run.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"

namespace equipoise::web {

namespace {

std::map<int, std::unique_ptr<FollowedRun>>& runs() {
  static std::map<int, std::unique_ptr<FollowedRun>> all;
  return all;
}

FollowedRun& run_of(const Json& handle) {
  const auto at = runs().find(handle.get<int>());
  if (at == runs().end()) throw InputError("run", "handle", handle.dump(), "is closed; must be one that is open");
  return *at->second;
}

void add_row(const FollowedRun& run, std::vector<double>& rows) {
  Trajectory now;
  now.phi.resize(static_cast<std::size_t>(run.study().parameters.balls));
  now.phi_dot.resize(now.phi.size());
  run.record(now);
  for (const auto* column : {&now.t, &now.psi, &now.psi_dot, &now.x, &now.y, &now.x_dot, &now.y_dot})
    rows.push_back(column->back());
  for (const auto* balls : {&now.phi, &now.phi_dot})
    for (const std::vector<double>& ball : *balls) rows.push_back(ball.back());
  rows.push_back(now.radial.back());
  rows.push_back(run.clamped() ? 1.0 : 0.0);
}

std::vector<std::string> columns(int balls) {
  std::vector<std::string> names{"t", "psi", "psi_dot", "x", "y", "x_dot", "y_dot"};
  for (const char* name : {"phi", "phi_dot"})
    for (int i = 1; i <= balls; ++i) names.push_back(fmt::format("{}_{}", name, i));
  names.insert(names.end(), {"radial", "held"});
  return names;
}

std::unique_ptr<FollowedRun> followed(Study study, InitialState start, bool bare) {
  if (bare) {
    take_balls_off(study, start);
    study.parameters.balls = 0;
  }
  return std::make_unique<FollowedRun>(study, start);
}

// A start that draws its rotor too is played with that rotor.
std::unique_ptr<FollowedRun> opened(const Study& uncertain, const Json& start) {
  const bool bare = start.value("bare", false);
  if (start.contains("index")) {
    const auto index = start.at("index").get<std::uint64_t>();
    const Sampler sampler = sampler_of(uncertain);
    const InitialState s = drawn_start_of(uncertain, sampler, uncertain.sampling.seed, index);
    if (uncertain.uncertain.empty()) return followed(uncertain, s, bare);
    return followed(drawn_study(uncertain, drawn_values(uncertain, sampler, uncertain.sampling.seed, index)), s, bare);
  }
  const Study study = with_medians(uncertain);
  InitialState s = study.initial;
  if (start.contains("phi")) {
    const auto phi = start.at("phi").get<std::vector<double>>();
    if (phi.size() != static_cast<std::size_t>(study.parameters.balls))
      throw InputError("run", "phi", fmt::format("{} numbers", phi.size()),
                       fmt::format("must be {}, one per ball", study.parameters.balls));
    std::copy(phi.begin(), phi.end(), s.phi.begin());
  }
  return followed(study, s, bare);
}

}  // namespace

Json play_open(const Json& args, Bulk& bulk) {
  static int last = 0;
  auto run = opened(study_of(args.at(0)), args.size() > 1 && args.at(1).is_object() ? args.at(1) : Json::object());
  const int balls = run->study().parameters.balls;
  std::vector<double> row;
  add_row(*run, row);
  runs().emplace(++last, std::move(run));
  return {{"handle", last}, {"balls", balls}, {"columns", columns(balls)}, {"row", bulk.doubles(std::move(row))}};
}

Json play_advance(const Json& args, Bulk& bulk) {
  FollowedRun& run = run_of(args.at(0));
  const IntegrationStatus status = run.advance(args.at(1).get<double>());
  std::vector<double> row;
  add_row(run, row);
  return {{"row", bulk.doubles(std::move(row))}, {"status", name_of(status)}};
}

Json play_rows(const Json& args, Bulk& bulk) {
  FollowedRun& run = run_of(args.at(0));
  std::vector<double> rows;
  IntegrationStatus status = IntegrationStatus::done;
  for (const double time : numbers_of<double>(args.at(1))) {
    status = run.advance(time);
    if (status != IntegrationStatus::done) break;
    add_row(run, rows);
  }
  return {{"row", bulk.doubles(std::move(rows))}, {"status", name_of(status)}};
}

Json play_close(const Json& args) {
  runs().erase(args.at(0).get<int>());
  return nullptr;
}

}  // namespace equipoise::web

// Attractors, starts and shares. A search is kept: the page asks for one study again and again.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <list>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "calls.hpp"
#include "equipoise/analyses/one_study/comparison.hpp"
#include "equipoise/analyses/mapper/mapper.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/results/commands/outcome_share.hpp"
#include "equipoise/results/types/outcome.hpp"
#include "equipoise/report/drawing/plot_parts.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/report/text/motion_words.hpp"
#include "equipoise/report/shown/motion_path.hpp"

namespace equipoise::web {

namespace {

struct Kept {
  std::string toml;
  bool transients;
  double seconds;
  Mapper mapper;
};

// The last few: two settings side by side, with figures of transients and without.
const Mapper& kept(const std::string& toml, const Study& study, bool transients, double* seconds = nullptr) {
  constexpr std::size_t most = 6, most_searches = 24;
  static std::list<Kept> all;
  static AttractorSearchCache searches;
  const auto same = [&](const Kept& k) { return k.toml == toml && k.transients == transients; };
  auto at = std::find_if(all.begin(), all.end(), same);
  if (at == all.end()) {
    if (searches.made.size() >= most_searches) searches.made.clear();
    const auto begin = std::chrono::steady_clock::now();
    MapperOptions options;
    options.transients = transients;
    options.searches = &searches;
    options.progress = tell;
    Mapper mapper(study, options);
    const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    all.push_front({toml, transients, took, std::move(mapper)});
    if (all.size() > most) all.pop_back();
    at = all.begin();
  }
  all.splice(all.begin(), all, at);
  if (seconds) *seconds = all.front().seconds;
  return all.front().mapper;
}

Json outcome_json(const OutcomeShare& o, const Study& study) {
  return object("code", o.id, "name", o.name, "alias", o.alias, "title", reader_title(o, study.scales.has_value()),
                "colour", colour_of(o.id));
}

Json outcomes_json(const Mapper& mapper) {
  Json list = Json::array();
  const Study& study = mapper.study();
  const Catalogue known = mapper.attractors();
  for (const Attractor& a : known.attractors()) list.push_back(outcome_json({a.id, a.name, a.alias}, study));
  for (const NoAttractor& n : no_attractors)
    if (n.kind != OutcomeKind::stalled || study.speed.driven()) list.push_back(outcome_json({n.code, n.name}, study));
  return list;
}

// So many looks a turn that a moving picture of it is smooth.
Json path_json(const Study& study, const Motion& motion) {
  constexpr double most_turns = 24.0;
  constexpr int looks_a_turn = 48;
  const double turn = turn_time(motion.speed), duration = std::min(whole_way(motion), most_turns * turn);
  const MotionPath path = motion_path(study.system(), motion, duration,
                                      std::max(looks_a_turn, static_cast<int>(duration / turn * looks_a_turn)));
  return {{"duration", duration}, {"psi", path.psi}, {"x", path.x}, {"y", path.y}, {"phi", path.phi}};
}

// What `decide` answers, and how long it took: a search for attractors, which comes before, is made once.
template <class Decide>
Json outcomes_json(const Mapper& mapper, std::uint64_t first, Decide&& decide, Bulk& bulk) {
  const auto begin = std::chrono::steady_clock::now();
  Decided ended = decide();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::vector<double> time;
  for (const Outcome& outcome : ended.outcomes) time.push_back(outcome.time);
  Json json = told_rows(ended.outcomes, ended.transients, bulk);
  json.update({{"first", first},
               {"count", ended.outcomes.size()},
               {"time", bulk.doubles(std::move(time))},
               {"angles", bulk.doubles(std::move(ended.phi))},
               {"balls", mapper.study().parameters.balls},
               {"seconds", seconds},
               {"outcomes", outcomes_json(mapper)}});
  return json;
}

Json share_of(const Share& s) {
  return object("count", s.count, "total", s.total, "share", s.share, "low", s.low, "high", s.high, "least", s.least,
                "most", s.most);
}

BasinOutcomes outcomes_of(const Json& side) {
  BasinOutcomes o;
  o.study = study_of(side.at("toml"));
  for (const std::int32_t code : numbers_of<std::int32_t>(side.at("outcome")))
    o.outcome.push_back(static_cast<short>(code));
  for (const Json& one : side.at("outcomes"))
    o.names[one.at("code").get<short>()] = {one.at("name").get<std::string>(), one.at("alias").get<std::string>()};
  return o;
}

}  // namespace

Json search_attractors(const Json& args, Bulk&) {
  const std::string toml = args.at(0).get<std::string>();
  double seconds = 0.0;
  const Mapper& mapper = kept(toml, study_of(args.at(0)), false, &seconds);
  const Study study = with_medians(mapper.study());
  Json attractors = Json::array();
  const Catalogue known = mapper.attractors();
  for (const Attractor& a : known.attractors()) {
    Json one = outcome_json({a.id, a.name, a.alias}, study);
    one.update(Json(PartOf{a, study}));
    one["stability"] = stability_text(a, study.scales);
    one["path"] = path_json(study, a.motion);
    attractors.push_back(std::move(one));
  }
  return {{"outcomes", outcomes_json(mapper)},
          {"attractors", attractors},
          {"note", mapper.balance().note},
          {"horizon", *mapper.study().numerics.horizon},
          {"seconds", seconds}};
}

Json ensemble(const Json& args, Bulk& bulk) {
  std::string toml = args.at(0).get<std::string>();
  const auto first = args.at(1).get<std::uint64_t>();
  const auto count = args.at(2).get<std::size_t>();
  const Json options = args.size() > 3 && args.at(3).is_object() ? args.at(3) : Json::object();
  Study study = study_of(args.at(0));
  if (options.contains("seed") && options.at("seed").is_number_unsigned()) {
    study.sampling.seed = options.at("seed").get<std::uint64_t>();
    toml += "\n# seed " + std::to_string(study.sampling.seed);
  }
  const Mapper& m = kept(toml, study, options.value("figures", false));
  return outcomes_json(
      m, first, [&] { return m.starts(first, count); }, bulk);
}

Json states(const Json& args, Bulk& bulk) {
  const Mapper& m = kept(args.at(0).get<std::string>(), study_of(args.at(0)), false);
  return outcomes_json(
      m, 0, [&] { return m.at_angles(numbers_of<double>(args.at(1))); }, bulk);
}

Json shares(const Json& args) {
  std::uint64_t total = 0, open = 0;
  for (const Json& one : args.at(0)) {
    const auto count = one.at("count").get<std::uint64_t>();
    total += count;
    if (one.at("code").get<int>() == undecided_code) open += count;
  }
  Json list = Json::array();
  for (const Json& one : args.at(0)) {
    const auto count = one.at("count").get<std::uint64_t>();
    const int code = one.at("code").get<int>();
    Json share = share_of(open_share(count, code == undecided_code ? count : count + open, total));
    share["code"] = code;
    list.push_back(share);
  }
  return list;
}

Json compare_shares(const Json& args) {
  const BasinOutcomes first = outcomes_of(args.at(0)), second = outcomes_of(args.at(1));
  const ComparisonResult r = compare(first, second);
  const bool physical = first.study.scales && second.study.scales;
  const auto share = [&](const ComparedShare& s) {
    return object("name", s.name, "alias", s.alias, "title", reader_title(s, physical), "first", share_of(s.first),
                  "second", share_of(s.second), "difference", s.difference);
  };
  return object("common", r.common, "why_not", r.why_not_common, "starts", r.starts, "shares", list_of(r.shares, share),
                "verdict", verdict(r));
}

}  // namespace equipoise::web

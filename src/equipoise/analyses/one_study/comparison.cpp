// Matches outcomes by name and counts them in pairs.
#include "equipoise/analyses/one_study/comparison.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/results/columns/transient_figures.hpp"
#include "equipoise/results/types/outcome.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise {

namespace {

std::string why_not_common(const BasinOutcomes& first, const BasinOutcomes& second) {
  const Study &a = first.study, &b = second.study;
  const auto method = [](const Study& s) { return s.sampling.method.value_or(SamplingMethod::random); };
  if (a.parameters.balls != b.parameters.balls) return "they have different numbers of balls";
  if (first.own_starts != second.own_starts) return "they were not given the same starts";
  if (a.sampling.seed != b.sampling.seed) return "their seeds differ";
  if (method(a) != method(b)) return "their sampling methods differ";
  if (a.parameters.contact_angle != b.parameters.contact_angle) return "their contact angles differ";
  for (const BoxSide& side : box_sides) {
    const auto &left = a.sampling.box.*side.side, &right = b.sampling.box.*side.side;
    if (left.has_value() != right.has_value() || (left && (left->low != right->low || left->high != right->high)))
      return "their sampling boxes differ";
  }
  return "";
}

void refuse_grid(const Study& study) {
  if (study.sampling.method == SamplingMethod::grid)
    throw InputError(study.name, "sampling.method", "grid",
                     "starts on a grid have weights; comparisons need \"random\" or \"sobol\"");
}

// The outcomes of both studies as one list: motions of the first, those of the second alone, then outcomes without a
// motion. A motion with a reserved identifier is the same in both, whatever its name (balanced; balanced, stuck).
// Others are the same if their names are.
class CommonNames {
 public:
  CommonNames(const BasinOutcomes& first, const BasinOutcomes& second) {
    for (const bool motions : {true, false})
      for (const int k : {0, 1})
        for (const auto& [code, name] : (k ? second : first).names)
          if ((code > 0) == motions) places_[k][code] = place_of(code, name);
  }

  std::size_t place(int study, short code) const { return places_[study].at(code); }
  const std::vector<BasinOutcomes::Name>& all() const { return names_; }
  /// The place of an outcome that has a reserved identifier.
  std::optional<std::size_t> place_of_own(short code) const {
    const auto found = std::find(own_.begin(), own_.end(), code);
    return found == own_.end() ? std::nullopt : std::optional<std::size_t>(found - own_.begin());
  }

 private:
  std::size_t place_of(short code, const BasinOutcomes::Name& name) {
    const short own = std::min<short>(code, first_free_id);
    for (std::size_t k = 0; k < names_.size(); ++k) {
      if (own_[k] != own || (own == first_free_id && names_[k].name != name.name)) continue;
      if (names_[k].name != name.name) names_[k].name += " / " + name.name;
      return k;
    }
    names_.push_back(name);
    own_.push_back(own);
    return names_.size() - 1;
  }

  std::vector<BasinOutcomes::Name> names_;
  std::vector<short> own_;  // reserved identifiers; first_free_id: it has none
  std::array<std::map<short, std::size_t>, 2> places_;
};

class Comparison {
 public:
  Comparison(const BasinOutcomes& first, const BasinOutcomes& second) : names_(first, second) {
    result_.first = first.study;
    result_.second = second.study;
    result_.partial = first.partial || second.partial;
    result_.why_not_common = why_not_common(first, second);
    result_.common = result_.why_not_common.empty();
    result_.starts = std::min(first.outcome.size(), second.outcome.size());
    first_ = places(0, first);
    second_ = places(1, second);
    compare_figures(first, second);
    compare_limits(first, second);
  }

  ComparisonResult run() {
    for (std::size_t k = 0; k < names_.all().size(); ++k) result_.shares.push_back(share_of(k));
    bound_balanced();
    if (result_.common) count_changes();
    return std::move(result_);
  }

  // In the units that both results are shown in: of studies with other scales one number means two things.
  void compare_figures(const BasinOutcomes& first, const BasinOutcomes& second) {
    for (std::size_t k = 0; k < transient_figures.size(); ++k) {
      const TransientFigure& f = transient_figures[k];
      if (f.value == &TransientRow::followed_until || first.transients[k].empty() || second.transients[k].empty())
        continue;
      if (f.differs && !f.differs(first.study) && !f.differs(second.study)) continue;
      if (f.needs && !(first.study.limits.*f.needs && second.study.limits.*f.needs)) continue;
      const study::ShownUnit a = study::shown_unit(f.told_in(), first.study.scales),
                             b = study::shown_unit(f.told_in(), second.study.scales);
      if (std::string_view(a.name) != b.name) continue;
      const auto shown = [&](const std::vector<float>& values, double size, std::uint64_t& open) {
        std::vector<double> result;
        for (std::size_t i = 0; i < (result_.common ? result_.starts : values.size()); ++i) {
          open += std::isinf(values[i]);
          result.push_back(static_cast<double>(values[i]) * size);
        }
        return result;
      };
      ComparedFigure figure{f.name, f.title, a.name, {}};
      const std::vector<double> before = shown(first.transients[k], a.size, figure.first_open),
                                after = shown(second.transients[k], b.size, figure.second_open);
      figure.mean = result_.common ? paired_mean_difference(before, after) : independent_mean_difference(before, after);
      if (figure.mean.first_count > 0 && figure.mean.second_count > 0) result_.figures.push_back(std::move(figure));
    }
  }

  // What undecided starts may still come to bounds the shares; a peak that exceeded a limit stays one.
  void compare_limits(const BasinOutcomes& first, const BasinOutcomes& second) {
    const auto compared = [](const BasinOutcomes& o) { return o.study.limits.any() && !o.transients[0].empty(); };
    if (!compared(first) || !compared(second)) return;
    const Kept before = kept(first), after = kept(second);
    ComparedLimits& l = result_.limits.emplace();
    l.first = share(before.seen);
    l.second = share(after.seen);
    l.difference = difference(before.seen, after.seen);
    l.surely_low = difference(before.most, after.least).low;
    l.surely_high = difference(before.least, after.most).high;
    l.alike = same_limits(first.study, second.study);
  }

 private:
  struct Kept {
    std::vector<bool> seen, least, most;
  };

  // Of common starts both lists stay in step, so that there a lost start keeps nothing; elsewhere it is left out.
  Kept kept(const BasinOutcomes& o) const {
    Kept result;
    const bool driven = o.study.speed.driven();
    const double final_speed = std::fabs(o.study.speed_profile().final_speed());
    for (std::size_t i = 0; i < (result_.common ? result_.starts : o.outcome.size()); ++i) {
      const TransientRow row = row_of(o, i);
      const bool lost = std::isnan(row.peak_radial), open = o.outcome[i] == undecided_code;
      if (lost && !result_.common) continue;
      const LimitsOfStart of = limits_of_start(o.study.limits, row,
                                               !driven                ? final_speed
                                               : o.mean_speed.empty() ? NAN
                                                                      : std::fabs(o.mean_speed[i]),
                                               o.study.scales ? o.study.scales->frequency : 0.0);
      result.seen.push_back(!lost && of.both());
      result.least.push_back(!lost && of.both() && !open);
      result.most.push_back(!lost && (of.both() || (open && of.on_the_way)));
    }
    return result;
  }

  // In the units that they are shown in.
  static bool same_limits(const Study& a, const Study& b) {
    const auto shown = [](const Study& s, const std::optional<double>& limit, study::Dimension d) {
      return limit ? fmt::format("{:.6g}", *limit * study::shown_unit(d, s.scales).size) : "";
    };
    return std::all_of(transient_limits.begin(), transient_limits.end(),
                       [&](const TransientLimit& l) {
                         return shown(a, a.limits.*l.limit, l.told_in()) == shown(b, b.limits.*l.limit, l.told_in());
                       }) &&
           shown(a, a.limits.settled, study::Dimension::length) == shown(b, b.limits.settled, study::Dimension::length);
  }

  // Each start's outcome as a place in the common list. With common starts, only for those that both studies have.
  std::vector<std::size_t> places(int study, const BasinOutcomes& o) const {
    std::vector<std::size_t> result(result_.common ? result_.starts : o.outcome.size());
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = names_.place(study, o.outcome[i]);
    return result;
  }

  static std::vector<bool> are(const std::vector<std::size_t>& places, std::size_t place) {
    std::vector<bool> result(places.size());
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = places[i] == place;
    return result;
  }

  static Share share(const std::vector<bool>& ended) {
    return wilson_share(static_cast<std::uint64_t>(std::count(ended.begin(), ended.end(), true)), ended.size());
  }

  ComparedShare share_of(std::size_t place) const {
    const std::vector<bool> before = are(first_, place), after = are(second_, place);
    const BasinOutcomes::Name& name = names_.all()[place];
    ComparedShare s{name.name, name.alias, share(before), share(after), {}};
    s.difference = difference(before, after);
    return s;
  }

  ShareDifference difference(const std::vector<bool>& before, const std::vector<bool>& after) const {
    return result_.common ? paired_difference(compare_starts(before, after))
                          : independent_difference(share(before), share(after));
  }

  // Undecided starts of one study or the other may all become balanced.
  void bound_balanced() {
    const auto undecided = names_.place_of_own(undecided_code);
    result_.balanced = names_.place_of_own(balanced_id);
    if (!result_.balanced) return;
    const ShareDifference& d = result_.shares[*result_.balanced].difference;
    result_.surely_low = d.low - (undecided ? result_.shares[*undecided].first.share : 0.0);
    result_.surely_high = d.high + (undecided ? result_.shares[*undecided].second.share : 0.0);
  }

  void count_changes() {
    std::map<std::pair<std::size_t, std::size_t>, std::uint64_t> changes;
    std::uint64_t changed = 0;
    for (std::size_t i = 0; i < result_.starts; ++i)
      if (first_[i] != second_[i]) {
        ++changed;
        ++changes[{first_[i], second_[i]}];
      }
    result_.changed = wilson_share(changed, result_.starts);
    for (const auto& [ends, starts] : changes)
      result_.changes.push_back({names_.all()[ends.first].name, names_.all()[ends.second].name, starts});
    std::stable_sort(result_.changes.begin(), result_.changes.end(),
                     [](const auto& a, const auto& b) { return a.starts > b.starts; });
  }

  CommonNames names_;
  std::vector<std::size_t> first_, second_;
  ComparisonResult result_;
};

}  // namespace

void check_comparable(const Study& study) {
  refuse_grid(study);
  check_runnable(study, false);
}

ComparisonResult compare(const BasinOutcomes& first, const BasinOutcomes& second) {
  refuse_grid(first.study);
  refuse_grid(second.study);
  return Comparison(first, second).run();
}

}  // namespace equipoise

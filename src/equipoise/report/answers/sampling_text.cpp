// Explains the sampling to the reader of a table.
#include "equipoise/report/answers/sampling_text.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "equipoise/report/answers/start_text.hpp"
#include "equipoise/study/sampling/scrambled_sobol.hpp"

namespace equipoise {

namespace {

SamplingMethod method_of(const BasinResult& r) { return r.study.sampling.method.value_or(SamplingMethod::random); }

// Digits in groups of three, for numbers of five digits or more.
std::string grouped(double value) {
  std::string text = fmt::format("{:.0f}", value);
  if (text.size() < 5) return text;
  for (int at = static_cast<int>(text.size()) - 3; at > 0; at -= 3) text.insert(static_cast<std::size_t>(at), 1, ' ');
  return text;
}

// Rounded to `digits` significant digits.
std::string rounded(double value, int digits) {
  if (!(value >= 1.0)) return grouped(value);
  const double unit = std::pow(10.0, std::max(0.0, std::floor(std::log10(value)) + 1.0 - digits));
  return grouped(std::round(value / unit) * unit);
}

std::string points_text(const BasinResult& r) {
  const std::uint64_t points = r.starts / sobol_replicates, rest = r.starts % sobol_replicates;
  return fmt::format("{} x {}{}", sobol_replicates, grouped(static_cast<double>(points)),
                     rest == 0 ? "" : fmt::format(" + {}", rest));
}

std::string choice_text(const BasinResult& r) {
  const SamplingChoice& c = *r.choice;
  if (c.pilot == 0)
    return fmt::format(
        "Sampling: random starts, in blocks; this half-width needs at most {}, too few for a pilot of Sobol starts.\n",
        rounded(c.random_starts, 3));
  if (c.method == SamplingMethod::random)
    return fmt::format("Sampling: random, about {} starts needed; Sobol starts would need {}, says a pilot of {}.\n",
                       rounded(c.random_starts, 3), rounded(c.sobol_starts, 3), grouped(static_cast<double>(c.pilot)));
  return fmt::format("Sampling: scrambled Sobol, {} starts; random starts would have needed about {}.\n",
                     points_text(r), rounded(c.random_starts, 3));
}

std::string grid_text(const BasinResult& r) {
  const JitteredGrid& g = *r.grid;
  std::string text =
      fmt::format("Sampling: jittered grid, {}{} cells, two starts per cell", grouped(static_cast<double>(g.side())),
                  r.study.parameters.balls == 1 ? "" : fmt::format("^{}", r.study.parameters.balls));
  text += ".\n";
  if (g.exchange() && r.study.parameters.balls > 1)
    text += fmt::format("The balls are alike: {} cells stand for all {}, so shares are weighted, counts are not.\n",
                        grouped(static_cast<double>(g.cells())), grouped(g.all_cells()));
  return text;
}

bool falls_back(const BasinResult& r) {
  const auto wilson = [](const OutcomeShare& o) { return o.share.by == IntervalBy::wilson; };
  const std::vector<OutcomeShare> others = r.others();
  return std::any_of(r.attractors.begin(), r.attractors.end(), wilson) ||
         std::any_of(others.begin(), others.end(), [&](const auto& o) { return o.id != stalled_code && wilson(o); });
}

}  // namespace

std::string as_good_as(const Share& share) {
  return share.by == IntervalBy::wilson ? "-" : rounded(share.effective_starts, 2);
}

std::string sampling_text(const BasinResult& r) {
  std::string text;
  if (r.own_starts) return "Starts: given, not drawn; intervals are those of random starts.\n";
  if (method_of(r) == SamplingMethod::grid)
    text = grid_text(r);
  else if (r.choice)
    text = choice_text(r);
  else if (method_of(r) == SamplingMethod::sobol)
    text = fmt::format("Sampling: scrambled Sobol, {} starts.\n", points_text(r));
  if (method_of(r) == SamplingMethod::random) return text;
  text += method_of(r) == SamplingMethod::sobol
              ? fmt::format("Intervals: Student's t over the {} independent replicates", sobol_replicates)
              : std::string("Intervals: from the differences between the two starts of each cell");
  if (falls_back(r)) text += "; Wilson's where the last column has a dash";
  return text + ".\nAs good as: random starts that give the same standard error.\n";
}

void to_json(Json& json, const PartOf<Sampling, BasinResult>& of) {
  const BasinResult& r = of.whole;
  json = object("method", "given");
  if (r.own_starts) return;
  json = object("method", sampling_method_names[static_cast<std::size_t>(method_of(r))]);
  if (const auto drawn = drawn_instead(r.study); !drawn.empty()) put(json, "drawn_instead_of", drawn);
  if (method_of(r) == SamplingMethod::sobol)
    put(json, "replicates", sobol_replicates, "points_per_replicate", r.starts / sobol_replicates);
  if (r.grid)
    put(json, "cells_a_turn", r.grid->side(), "cells", r.grid->all_cells(), "cells_evaluated", r.grid->cells(),
        "starts_a_cell", 2, "exchange", r.grid->exchange());
  if (r.half_width > 0.0) put(json, "half_width", r.half_width);
  if (!r.choice) return;
  put(json, "chosen", true, "pilot_starts", r.choice->pilot, "random_starts_needed",
      std::round(r.choice->random_starts));
  if (r.choice->pilot > 0) put(json, "sobol_starts_needed", std::round(r.choice->sobol_starts));
  const std::string why = choice_text(r);
  put(json, "why", why.substr(10, why.size() - 11));  // without "Sampling: " and the end of the line
}

}  // namespace equipoise

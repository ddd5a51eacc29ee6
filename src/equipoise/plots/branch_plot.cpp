// The script: one data block per stretch of equal stability, bands, edges, legend.
#include "equipoise/plots/branch_plot.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "equipoise/drawing/plot_parts.hpp"
#include "equipoise/results/outcome_share.hpp"
#include "equipoise/words/plots.hpp"

namespace equipoise {

namespace {

struct Sample {
  double value, low, mean, high;
};
struct Stretch {
  bool stable = false;
  std::vector<Sample> samples;
};

// Ends and changes of stability are drawn where they were located, not only at the next value.
std::vector<Stretch> stretches_of(const Branch& branch) {
  std::vector<Stretch> stretches;
  auto event = branch.events.begin();
  const auto sample_of = [](const BranchEvent& e) { return Sample{e.place(), e.r_min, e.r_mean, e.r_max}; };
  std::size_t last = 0;
  for (const BranchPoint& point : branch.points) {
    const Motion& m = point.motion;
    if (stretches.empty() || point.at != last + 1) stretches.push_back({m.stable, {}});
    for (; event != branch.events.end() && event->middle() < point.value; ++event) {
      stretches.back().samples.push_back(sample_of(*event));
      if (event->change == BranchChange::stability_gained || event->change == BranchChange::stability_lost)
        stretches.push_back({m.stable, {sample_of(*event)}});
    }
    stretches.back().samples.push_back({point.value, m.r_min, m.r_mean, m.r_max});
    last = point.at;
  }
  for (; event != branch.events.end(); ++event) stretches.back().samples.push_back(sample_of(*event));
  return stretches;
}

std::string subtitle(const BranchesResult& r) {
  return parameters_text(r.study, {r.key}) + (r.partial ? words::plots::partial_early : "");
}

}  // namespace

std::string branch_plot_script(const BranchesResult& r, const std::string& path) {
  std::string script = canvas(path, 1600, 1000);
  double highest = 0.0;
  std::string bands, edges, keys;
  const auto add = [](std::string& list, const std::string& item) { list += (list.empty() ? "" : ", \\\n  ") + item; };
  for (const Branch& b : r.branches) {
    const char* colour = colour_of(b.id);
    int part = 0;
    for (const Stretch& stretch : stretches_of(b)) {
      const std::string block = fmt::format("$branch_{}_{}", b.id, ++part);
      script += block + " << EOD\n";
      for (const Sample& s : stretch.samples) {
        script += fmt::format("{:.9g} {:.6g} {:.6g} {:.6g}\n", s.value, s.low, s.mean, s.high);
        highest = std::max(highest, s.high);
      }
      script += "EOD\n";
      if (stretch.stable)
        add(bands, fmt::format("{} using 1:2:4 with filledcurves fillcolor rgb '{}' fillstyle transparent solid 0.25 "
                               "noborder notitle",
                               block, colour));
      const bool dot = stretch.samples.size() == 1;
      for (const int column : {2, 4})
        add(edges, fmt::format("{} using 1:{} with {} linecolor rgb '{}' {} notitle", block, column,
                               dot ? "points pointtype 7 pointsize 0.6" : "lines", colour,
                               dot              ? ""
                               : stretch.stable ? "linewidth 2.2"
                                                : "linewidth 1.4 dashtype (12,8)"));
    }
    const std::string title = legend_of(b);
    add(keys, fmt::format("keyentry with filledcurves fillcolor rgb '{}' fillstyle transparent solid 0.55 border "
                          "linecolor rgb '{}' title {}",
                          colour, colour, quoted(title)));
  }
  add(keys, "keyentry with lines linecolor rgb '#444444' linewidth 1.4 dashtype (12,8) title " +
                quoted(words::plots::dashed_unstable));
  const double low = r.values.front(), high = r.values.back(), margin = high > low ? 0.0 : std::max(0.5 * r.step, 1e-9);
  script += fmt::format("set title {} offset 0,0.3\n", quoted(words::plots::where_rotor_ends + subtitle(r)));
  script += fmt::format("set xlabel {}\nset ylabel {} offset -0.6,0\n", quoted(axis_label(r.key)),
                        quoted(words::plots::rotor_displacement));
  script += fmt::format("set xrange [{:.12g}:{:.12g}]\nset yrange [{:.6g}:{:.6g}]\n", low - margin, high + margin,
                        -0.012 * highest, 1.08 * std::max(highest, 1e-6));
  script += quiet_frame;
  script +=
      "set mxtics 5\n"
      "set lmargin 11\nset key outside right top vertical Left reverse samplen 2.2 spacing 1.3 width 1\n";
  std::string items;
  for (const std::string* list : {&bands, &edges, &keys})
    if (!list->empty()) add(items, *list);
  script += "plot " + items + "\n";
  return script;
}

}  // namespace equipoise

// Stacked shares and heat maps.
#include "equipoise/plots/sweep_plot.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "equipoise/drawing/plot_parts.hpp"
#include "equipoise/plots/sweep_layers.hpp"
#include "equipoise/words/plots.hpp"

namespace equipoise {

namespace {

std::string heading(const SweepResult& r, const std::string& title) {
  return fmt::format("{}{}{}", title.empty() ? "" : title + ": ", parameters_text(r.study, keys_of(r.axes)),
                     r.complete() ? "" : words::plots::partial_cells);
}

std::string stacked_script(const SweepResult& r, const std::string& title, const std::string& path) {
  const std::vector<SweepLayer> layers = sweep_layers(r);
  const SweepParameter& x = r.axes.front().parameters.front();
  std::string script = canvas(path, 1600, 900) + "$shares << EOD\n";
  for (std::size_t k = 0; k < r.cells.size(); ++k) {
    if (!r.cells[k]) continue;
    const SweepCell& cell = *r.cells[k];
    const Share& balanced = cell.outcomes.front().share;
    script += fmt::format("{:.9g} {:.6g} {:.6g}", x.values[k], 100.0 * balanced.low, 100.0 * balanced.high);
    double sum = 0.0;
    for (const SweepLayer& layer : layers) script += fmt::format(" {:.6g}", sum += 100.0 * layer.share[k]);
    script += "\n";
  }
  script += "EOD\n" + std::string(quiet_frame);
  const auto [low, high] = std::minmax_element(x.values.begin(), x.values.end());
  const double margin = *high > *low ? 0.0 : 0.5 * std::max(std::fabs(*low), 1e-3);
  script += fmt::format(
      "set title {} offset 0,0.3\nset xlabel {}\nset ylabel {}\nset xrange [{:.9g}:{:.9g}]\n"
      "set yrange [0:100]\nset key outside right top vertical Left reverse samplen 2 spacing 1.3 width 1 invert\n"
      "set lmargin 9\nset grid front\n",
      quoted(heading(r, title)), quoted(sweep_axis_label(x)), quoted(words::plots::share_of_starts_percent),
      *low - margin, *high + margin);
  // A single value becomes a column.
  const bool lone = r.axes.front().size() == 1;
  std::string items;
  int column = 4;
  for (const SweepLayer& layer : layers) {
    items += items.empty() ? "" : ", \\\n  ";
    items +=
        lone ? fmt::format(
                   "$shares using 1:{0}:(0.1) with boxes fillcolor rgb '{1}' fillstyle solid 0.85 noborder title {2}",
                   column, layer.colour, quoted(layer.name))
             : fmt::format(
                   "$shares using 1:({0}):{1} with filledcurves fillcolor rgb '{2}' fillstyle solid 0.85 "
                   "noborder title {3}",
                   column == 4 ? "0" : fmt::format("${}", column - 1), column, layer.colour, quoted(layer.name));
    ++column;
  }
  items += ", \\\n  $shares using 1:4 with points pointtype 7 pointsize 0.5 linecolor rgb '#222222' notitle";
  items += ", \\\n  $shares using 1:2:(0):($3-$2) with vectors nohead linewidth 1.3 linecolor rgb '#222222' title " +
           quoted(words::plots::balanced_interval);
  return script + "plot " + items + "\n";
}

// Positions of values along an axis of a heat map. Evenly spaced values stand at themselves, others (0.01, 0.05, 0.1)
// at their ranks, so that all cells have one size.
class HeatAxis {
 public:
  explicit HeatAxis(const SweepParameter& p) : parameter_(p), at_(p.values), even_(is_even(p.values)) {
    if (even_) {
      half_ = 0.5 * std::fabs(at_[1] - at_[0]);
      return;
    }
    for (double& place : at_) {
      const double value = place;
      place = static_cast<double>(
          std::count_if(p.values.begin(), p.values.end(), [value](double other) { return other < value; }));
    }
  }

  std::size_t size() const { return at_.size(); }
  double at(std::size_t k) const { return at_[k]; }
  double half() const { return half_; }  // of a cell's width
  std::string label() const { return quoted(sweep_axis_label(parameter_)); }
  std::string tics(const char* axis) const {
    if (even_) return fmt::format("set {} autofreq\n", axis);
    std::string list;
    for (std::size_t k = 0; k < at_.size(); ++k)
      list += fmt::format("{}'{:.6g}' {:.9g}", k ? ", " : "", parameter_.values[k], at_[k]);
    return fmt::format("set {} ({})\n", axis, list);
  }
  std::string range() const {
    const auto [low, high] = std::minmax_element(at_.begin(), at_.end());
    return fmt::format("[{:.9g}:{:.9g}]", *low - half_, *high + half_);
  }

 private:
  static bool is_even(const std::vector<double>& values) {
    if (values.size() < 3) return false;
    const double step = values[1] - values[0];
    for (std::size_t k = 2; k < values.size(); ++k)
      if (std::fabs(values[k] - values[k - 1] - step) > 1e-6 * std::fabs(step)) return false;
    return true;
  }

  const SweepParameter& parameter_;
  std::vector<double> at_;
  bool even_;
  double half_ = 0.5;
};

// One rectangle per cell; its share is written into it where there is room.
std::string panel(const SweepResult& r, std::size_t first, const std::string& title, int number) {
  const HeatAxis y(r.axes[r.axes.size() - 2].parameters.front()), x(r.axes.back().parameters.front());
  std::string script = fmt::format("$panel_{} << EOD\n", number);
  for (std::size_t j = 0; j < y.size(); ++j)
    for (std::size_t i = 0; i < x.size(); ++i)
      if (const auto& cell = r.cells[first + j * x.size() + i])
        script += fmt::format("{:.9g} {:.9g} {:.4g}\n", x.at(i), y.at(j), 100.0 * cell->outcomes.front().share.share);
  script += "EOD\n" + x.tics("xtics") + y.tics("ytics");
  script += fmt::format(
      "set title {} offset 0,-0.2\nset xlabel {}\nset ylabel {} offset 0.5,0\nset xrange {}\nset yrange {}\n",
      quoted(title), x.label(), y.label(), x.range(), y.range());
  script += fmt::format(
      "plot $panel_{0} using 1:2:($1-{1:.9g}):($1+{1:.9g}):($2-{2:.9g}):($2+{2:.9g}):3 with boxxyerror fillcolor "
      "palette fillstyle solid 1 noborder notitle",
      number, x.half(), y.half());
  constexpr std::size_t widest = 16, most = 150;
  if (x.size() <= widest && x.size() * y.size() <= most)
    script += fmt::format(
        ", \\\n  $panel_{} using 1:2:(sprintf('%.0f', $3)):($3 > 55 ? 0x000000 : 0xFFFFFF) with labels textcolor rgb "
        "variable font ',13' notitle",
        number);
  return script + "\n";
}

std::string heat_script(const SweepResult& r, const std::string& title, const std::string& path) {
  const bool several = r.axes.size() == 3;
  const std::size_t panels = several ? r.axes.front().size() : 1;
  const std::size_t columns = panels == 4 ? 2 : std::min<std::size_t>(panels, 3);
  const std::size_t rows = (panels + columns - 1) / columns;
  const std::size_t cells = r.cells.size() / panels;
  std::string script = canvas(path, 1600, static_cast<int>(90 + std::max<std::size_t>(rows * 480, 810))) + quiet_frame;
  std::string colours;
  for (std::size_t k = 0; k < viridis.size(); ++k) colours += fmt::format("{}{} '{}'", k ? ", " : "", k, viridis[k]);
  script += fmt::format("set palette defined ({})\nset cbrange [0:100]\n", colours);
  script += "set cblabel 'balanced (%)' offset 1,0\nunset grid\nset lmargin 11\nset rmargin 12\n";
  if (several) script += fmt::format("set multiplot layout {},{} title {}\n", rows, columns, quoted(heading(r, title)));
  for (std::size_t k = 0; k < panels; ++k) {
    const SweepParameter& first = r.axes.front().parameters.front();
    script += panel(r, k * cells, several ? fmt::format("{} = {}", first.key, first.given[k]) : heading(r, title),
                    static_cast<int>(k) + 1);
  }
  return script + (several ? "unset multiplot\n" : "");
}

}  // namespace

std::string sweep_plot_script(const SweepResult& result, const std::string& title, const std::string& path) {
  return result.axes.size() == 1 ? stacked_script(result, title, path) : heat_script(result, title, path);
}

}  // namespace equipoise

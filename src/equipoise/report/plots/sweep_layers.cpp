// Outcomes in stacking order; labels of parameters.
#include "equipoise/report/plots/sweep_layers.hpp"

#include <map>

#include <fmt/format.h>

#include "equipoise/report/drawing/plot_parts.hpp"

namespace equipoise {

std::vector<SweepLayer> sweep_layers(const SweepResult& r) {
  constexpr int last = 1'000'000;  // after all identifiers
  std::map<int, SweepLayer> layers;
  for (std::size_t k = 0; k < r.cells.size(); ++k) {
    if (!r.cells[k]) continue;
    const SweepCell& cell = *r.cells[k];
    const auto add = [&](int order, const std::string& name, int code, double share) {
      SweepLayer& layer = layers.try_emplace(order, SweepLayer{name, colour_of(code), {}}).first->second;
      layer.share.resize(r.cells.size());
      layer.share[k] = share;
    };
    for (const SweepOutcome& o : cell.outcomes)
      if (o.share.count > 0 || o.id == balanced_id) add(o.id, legend_of(o), o.id, o.share.share);
    for (const auto& [outcome, order] : {std::pair{Outcome::stalled, last}, {Outcome::undecided, last + 1}}) {
      const NoAttractor& n = told_of(outcome);
      if (const Share* s = cell.of(n.code); s && s->count > 0) add(order, n.name, n.code, s->share);
    }
    if (cell.lost() > 0) add(last + 2, "diverged or failed", diverged_code, cell.diverged.share + cell.failed.share);
  }
  std::vector<SweepLayer> list;
  for (auto& [order, layer] : layers) list.push_back(std::move(layer));
  return list;
}

std::string sweep_axis_label(const SweepParameter& p) {
  return p.unit.empty() ? axis_label(p.key) : fmt::format("{} ({})", p.key, p.unit);
}

}  // namespace equipoise

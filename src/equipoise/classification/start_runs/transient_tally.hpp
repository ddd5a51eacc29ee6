// Counts figures of transients in index order, by outcome.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/core/statistics/quantile.hpp"
#include "equipoise/results/commands/transient_result.hpp"
#include "equipoise/results/types/outcome.hpp"
#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/sampling/sampling.hpp"

namespace equipoise {

/// The settings for every trajectory of `study`.
TransientSettings transient_settings(const Study& study);
/// The same for a rotor drawn for a start, with forces as in `of_all`: of each bearing, or of all supports together.
TransientSettings transient_settings(const Study& drawn, const TransientSettings& of_all);

/// Whether the drive's work can be computed: for a motor; or for a prescribed speed without contact and dry friction,
/// if the rotor's inertia is given wherever the speed changes.
bool knows_energy(const Study& study);

/// Converts what one rotor's start came to, and its figures if given, to the units of another rotor.
void change_units(const model::Scales& from, const model::Scales& to, Outcome& outcome, TransientRow* row);

/// Takes starts by index, from start 0 on.
class TransientTally {
 public:
  TransientTally(const Study& study, const Sampler& sampler);

  void add(const Outcome& outcome, const TransientRow& row);
  TransientResult result(const Catalogue& catalogue) const;

 private:
  struct Weighed {
    std::uint64_t count = 0;
    double weight = 0.0;

    void add(double w, std::uint64_t n = 1) {
      count += n;
      weight += w;
    }
  };
  // Starts that have a property; undecided ones that may still gain or lose it.
  struct Having {
    Weighed all, may_come, may_go;

    void add(bool has, bool may_change, double w) {
      if (has) all.add(w);
      if (may_change) (has ? may_go : may_come).add(w);
    }
    void merge(const Having& other) {
      all.add(other.all.weight, other.all.count);
      may_come.add(other.may_come.weight, other.may_come.count);
      may_go.add(other.may_go.weight, other.may_go.count);
    }
  };
  struct Line {
    std::uint64_t count = 0;
    double weight = 0.0, weight_squared = 0.0;
    double speed = 0.0, speed_weight = 0.0;  // driven rotors: weighted |mean speed|, and the weights
    std::array<Distribution, transient_figures.size()> figures;
    std::uint64_t lasting = 0;  ///< starts whose motion exceeds limits.displacement
    std::uint64_t never = 0;    ///< starts whose motion exceeds limits.settled
    std::array<Having, transient_limits.size()> exceeding{}, exceeding_at_end{};
    std::array<Having, within_names.size()> within{};
    std::array<Having, standard_levels.size()> beyond{};

    void merge(const Line& other);
  };
  TransientGroup group(const Line& line) const;
  std::array<QuantileEstimate, reported_quantiles.size()> sure_end_velocity() const;
  void count_limits(const Outcome& outcome, const TransientRow& row, double weight, Line& line) const;
  bool kept(Within when) const;
  static Share share(const Line& line, const Having& having);

  Limits limits_;
  std::array<std::optional<double>, standard_levels.size()> levels_{};
  TransientSettings settings_;
  Sampler sampler_;
  double final_speed_;  // of a prescribed one
  double frequency_;    // omega_c in rad/s, 0 without units
  bool driven_;
  std::uint64_t seed_, total_ = 0, lost_ = 0;
  std::vector<PairedStart> first_;
  std::map<std::pair<int, int>, Line> lines_;  // by outcome and attractor
};

}  // namespace equipoise

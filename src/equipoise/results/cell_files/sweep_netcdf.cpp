// Coordinates, shares, motions and transients of all cells; then every cell's record for the program itself.
#include "equipoise/results/cell_files/sweep_netcdf.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <netcdf.h>

#include "equipoise/results/cell_files/cell_netcdf.hpp"
#include "equipoise/results/cell_files/sweep_cells.hpp"
#include "equipoise/results/io/netcdf.hpp"
#include "equipoise/results/result_files/share_columns.hpp"
#include "equipoise/results/words/files.hpp"

namespace equipoise::io {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

class SweepWriter {
 public:
  SweepWriter(NetcdfFile& file, const std::string& identity, const SweepResult& result, const CellRecords& records)
      : file_(file), identity_(identity), result_(result), table_(file, result.axes, records) {
    const auto note = [&](const OutcomeShare& o) { kinds_.try_emplace(o.id, o.name, o.alias); };
    for (const OutcomeShare& o : SweepCell{}.others()) note(o);
    for (const auto& cell : result.cells) {
      if (!cell) continue;
      for (const SweepOutcome& o : cell->outcomes) note(o);
      for (const OutcomeShare& o : cell->others()) note(o);
    }
    for (const auto& [code, names] : kinds_) codes_.push_back(code);
    // Attractors first, as in lists.
    std::stable_partition(codes_.begin(), codes_.end(), [](int code) { return code > 0; });
    for (const int code : codes_) {
      names_.push_back(kinds_.at(code).first);
      aliases_.push_back(kinds_.at(code).second);
    }
  }

  void write() {
    define();
    table_.write();
    for (std::size_t k = 0; k < codes_.size(); ++k) file_.write(code_, {k}, {1}, &codes_[k]);
    file_.write_texts(name_, names_);
    file_.write_texts(alias_, aliases_);
    for (std::size_t k = 0; k < reported_quantiles.size(); ++k) {
      if (quantile_ >= 0) file_.write(quantile_, {k}, {1}, &reported_quantiles[k]);
    }
  }

 private:
  void define() {
    outcome_ = file_.dimension("outcome", codes_.size());
    code_ = file_.variable("outcome", NC_INT, {outcome_}, "1", words::files::code_of_attractor);
    name_ = file_.text_variable("name", outcome_, names_, words::files::name_of_outcome);
    alias_ = file_.text_variable("alias", outcome_, aliases_, words::files::name_by_wright_and_peng);
    column("starts", "1", "starts counted", 1,
           [](const SweepCell& c, double* v) { *v = static_cast<double>(c.starts); });
    column("balanced_stable", "1", words::files::stable_state_exists, 1,
           [](const SweepCell& c, double* v) { *v = c.balanced_stable; });
    define_shares();
    define_motions();
    if (result_.transients) define_transients();
    table_.define_records();
    define_cell_attributes(file_, "sweep", words::files::over_parameters, identity_, result_.study, result_.complete());
    file_.end_definitions();
  }

  void column(const std::string& name, const char* units, const std::string& meaning, std::size_t width,
              const std::function<void(const SweepCell&, double*)>& values, int dimension = -1) {
    table_.column(
        name, units, meaning, [this, values](std::size_t index, double* v) { values(*result_.cells[index], v); },
        dimension, width);
  }

  void define_shares() {
    const auto of_outcomes = [&](const char* name, const char* meaning,
                                 const std::function<double(const Share&)>& value) {
      column(
          name, "1", meaning, codes_.size(),
          [this, value](const SweepCell& cell, double* values) {
            for (std::size_t k = 0; k < codes_.size(); ++k)
              if (const Share* share = share_of(cell, codes_[k])) values[k] = value(*share);
          },
          outcome_);
    };
    of_outcomes("count", words::files::starts_with_outcome,
                [](const Share& s) { return static_cast<double>(s.count); });
    for (const ShareColumn& c : share_columns)
      of_outcomes(c.name, c.of_cell, [value = c.value](const Share& s) { return s.*value; });
  }

  // Null if the cell does not have it.
  static const Share* share_of(const SweepCell& cell, int code) {
    if (code <= 0) return cell.of(code);
    for (const SweepOutcome& o : cell.outcomes)
      if (o.id == code) return &o.share;
    return nullptr;
  }

  void define_motions() {
    for (const MotionColumn& c : motion_columns) {
      if (&c == &motion_columns.back()) define_left_unbalance();
      column(
          c.name, c.cf_units(), c.long_name(), codes_.size(),
          [this, &c](const SweepCell& cell, double* values) {
            for (const SweepOutcome& o : cell.outcomes)
              values[std::find(codes_.begin(), codes_.end(), o.id) - codes_.begin()] = c.value(o).value_or(none);
          },
          outcome_);
    }
  }

  // Only where dry friction leaves any.
  void define_left_unbalance() {
    const auto leaves = [](const auto& cell) {
      const auto some = [](const SweepOutcome& o) { return !o.unbalance.empty(); };
      return cell && std::any_of(cell->outcomes.begin(), cell->outcomes.end(), some);
    };
    if (std::none_of(result_.cells.begin(), result_.cells.end(), leaves)) return;
    for (std::size_t q = 0; q < unbalance_quantiles.size(); ++q) {
      const double percent = 100.0 * unbalance_quantiles[q];
      column(
          fmt::format("left_unbalance_{:.0f}", percent), "1",
          fmt::format(words::files::unbalance_left_in_percent, percent), codes_.size(),
          [this, q](const SweepCell& cell, double* values) {
            for (const SweepOutcome& o : cell.outcomes)
              if (!o.unbalance.empty())
                values[std::find(codes_.begin(), codes_.end(), o.id) - codes_.begin()] = o.unbalance[q];
          },
          outcome_);
    }
  }

  void define_transients() {
    const int quantile = file_.dimension("quantile", reported_quantiles.size());
    quantile_ = file_.variable("quantile", NC_DOUBLE, {quantile}, "1", "probability of a quantile");
    for (std::size_t k = 0; k < transient_figures.size(); ++k) {
      const auto of_quantiles = [&](const std::string& suffix, const std::string& words,
                                    double QuantileEstimate::*part) {
        column(
            transient_figures[k].name + suffix, "1", words + transient_figures[k].long_name(),
            reported_quantiles.size(),
            [k, part](const SweepCell& cell, double* values) {
              const bool told = cell.transients && cell.transients->tells(k);
              for (std::size_t q = 0; told && q < reported_quantiles.size(); ++q)
                values[q] = cell.transients->figures[k].quantiles[q].*part;
            },
            quantile);
      };
      of_quantiles("", words::files::quantile_over_starts, &QuantileEstimate::value);
      of_quantiles("_low", words::files::lower_end_of, &QuantileEstimate::low);
      of_quantiles("_high", words::files::upper_end_of, &QuantileEstimate::high);
    }
    for (std::size_t k = 0; k < transient_limits.size(); ++k)
      of_starts(std::string("exceeded_") + transient_limits[k].name,
                fmt::format(words::files::share_above_limit, transient_limits[k].name),
                [k](const TransientGroup& all) { return all.exceeded[k]; });
    for (std::size_t k = 0; k < within_names.size(); ++k)
      of_starts(std::string("limits_kept_") + within_names[k],
                fmt::format(words::files::share_keeping_limits, within_titles[k]),
                [k](const TransientGroup& all) { return all.within[k]; });
  }

  // A share of all starts, empty where it is not asked for, with its interval.
  template <class Of>
  void of_starts(const std::string& name, const std::string& words, const Of& of) {
    const auto part = [&](const std::string& suffix, const std::string& meaning, double Share::*member) {
      column(name + suffix, "1", meaning, 1, [of, member](const SweepCell& cell, double* value) {
        if (const auto share = cell.transients ? of(*cell.transients) : std::nullopt) *value = *share.*member;
      });
    };
    part("", words, &Share::share);
    part("_low", words::files::lower_end, &Share::low);
    part("_high", words::files::upper_end, &Share::high);
  }

  NetcdfFile& file_;
  const std::string& identity_;
  const SweepResult& result_;
  std::map<int, std::pair<std::string, std::string>> kinds_;
  CellTable table_;
  std::vector<int> codes_;
  std::vector<std::string> names_, aliases_;
  int outcome_ = -1, code_ = -1, name_ = -1, alias_ = -1, quantile_ = -1;
};

}  // namespace

void write_sweep_netcdf(const std::string& path, const std::string& identity, const SweepResult& result) {
  const CellRecords records(result.cells.size(), [&](std::size_t index) {
    const auto& cell = result.cells[index];
    return cell ? bytes_of(*cell) : std::vector<std::uint8_t>{};
  });
  write_netcdf_file(
      path, [&](NetcdfFile& file) { SweepWriter(file, identity, result, records).write(); }, records.mode());
}

}  // namespace equipoise::io

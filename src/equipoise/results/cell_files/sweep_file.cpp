// Sweeps: one record per cell; coordinates, shares, motions and transients of all cells for others.
#include "equipoise/results/cell_files/sweep_file.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "equipoise/results/cell_files/cell_dataset.hpp"
#include "equipoise/results/cell_files/cell_file.hpp"
#include "equipoise/results/cell_files/sweep_cells.hpp"
#include "equipoise/results/io/dataset_file.hpp"
#include "equipoise/results/result_files/result_identity.hpp"

namespace equipoise {

namespace {

// The last record of a cell counts.
template <class Cells>
io::CellFile::Take taken_into(Cells& cells) {
  return [&cells](std::size_t index, const std::vector<std::uint8_t>& record) {
    cells[index] = std::make_shared<SweepCell>(io::cell_from(record));
  };
}

const SweepOutcome* outcome_of(const SweepCell& cell, int code) {
  for (const SweepOutcome& o : cell.outcomes)
    if (o.id == code) return &o;
  return nullptr;
}

// Null if the cell does not have it.
const Share* share_of(const SweepCell& cell, int code) {
  if (code <= 0) return cell.of(code);
  const SweepOutcome* outcome = outcome_of(cell, code);
  return outcome ? &outcome->share : nullptr;
}

// All columns of a sweep's results; they refer to this.
class SweepColumns {
 public:
  SweepColumns(const std::string& identity, const SweepResult& result)
      : result_(result),
        records_(result.cells, [](const SweepCell& cell) { return io::bytes_of(cell); }),
        data_("Where a rotor with an automatic ball balancer ends, over parameters", result.axes, records_) {
    add_outcomes();
    column("starts", "1", "starts counted", [](const SweepCell& c, std::size_t) { return c.starts; });
    column("balanced_stable", "1", "1: a linearly stable balanced state exists",
           [](const SweepCell& c, std::size_t) { return c.balanced_stable; });
    of_shares("count", "starts with the outcome", [](const Share& s) { return s.count; });
    for (const ShareColumn& c : share_columns)
      of_shares(c.name, c.of_cell, [value = c.value](const Share& s) { return s.*value; });
    for (const MotionColumn& c : motion_columns) {
      if (&c == &motion_columns.back()) add_left_unbalance();
      of_motions(c.name, c.cf_units(), c.long_name(), [&c](const SweepOutcome& o) { return c.value(o); });
    }
    if (result.transients) add_transients();
    data_.add_records("sweep", identity, result.study, result.complete());
  }
  SweepColumns(const SweepColumns&) = delete;
  SweepColumns& operator=(const SweepColumns&) = delete;

  const Dataset& data() const { return data_; }

 private:
  using Along = std::vector<std::size_t>;

  void add_outcomes() {
    std::map<int, std::pair<std::string, std::string>> kinds;
    const auto note = [&](const OutcomeShare& o) { kinds.try_emplace(o.id, o.name, o.alias); };
    for (const OutcomeShare& o : SweepCell{}.others()) note(o);
    for (const auto& cell : result_.cells) {
      if (!cell) continue;
      for (const SweepOutcome& o : cell->outcomes) note(o);
      for (const OutcomeShare& o : cell->others()) note(o);
    }
    for (const auto& [code, of_code] : kinds) codes_.push_back(code);
    // Attractors first, as in lists.
    std::stable_partition(codes_.begin(), codes_.end(), [](int code) { return code > 0; });
    outcome_ = data_.dimension("outcome", codes_.size());
    data_.add(
        "outcome", "1", "identifier of an attractor, the same in all cells; 0 undecided, negative: lost or stalled",
        {outcome_}, [this](std::size_t k) { return codes_[k]; }, DataColumn::Type::integer);
    const auto name = [&](int code) { return kinds.at(code).first; };
    data_.add_texts("name", outcome_, codes_, name, "name of the outcome");
    const auto alias = [&](int code) { return kinds.at(code).second; };
    data_.add_texts("alias", outcome_, codes_, alias, name_by_wright_and_peng);
  }

  void column(const std::string& name, const char* units, const std::string& meaning,
              const std::function<double(const SweepCell&, std::size_t)>& value, const Along& along = {}) {
    data_.by_cell(
        name, units, meaning, [this, value](std::size_t cell, std::size_t k) { return value(*result_.cells[cell], k); },
        along);
  }

  void of_shares(const char* name, const char* meaning, const std::function<double(const Share&)>& value) {
    const auto of_outcome = [this, value](const SweepCell& cell, std::size_t k) {
      const Share* share = share_of(cell, codes_[k]);
      return share ? value(*share) : no_number;
    };
    column(name, "1", meaning, of_outcome, {outcome_});
  }

  void of_motions(const std::string& name, const char* units, const std::string& meaning,
                  const std::function<std::optional<double>(const SweepOutcome&)>& value) {
    const auto of_outcome = [this, value](const SweepCell& cell, std::size_t k) {
      const SweepOutcome* outcome = outcome_of(cell, codes_[k]);
      return outcome ? value(*outcome).value_or(no_number) : no_number;
    };
    column(name, units, meaning, of_outcome, {outcome_});
  }

  // Only where dry friction leaves any.
  void add_left_unbalance() {
    const auto leaves = [](const auto& cell) {
      const auto some = [](const SweepOutcome& o) { return !o.unbalance.empty(); };
      return cell && std::any_of(cell->outcomes.begin(), cell->outcomes.end(), some);
    };
    if (std::none_of(result_.cells.begin(), result_.cells.end(), leaves)) return;
    for (std::size_t q = 0; q < unbalance_quantiles.size(); ++q) {
      const double percent = 100.0 * unbalance_quantiles[q];
      of_motions(
          fmt::format("left_unbalance_{:.0f}", percent), "1",
          fmt::format(
              "unbalance that {:.0f} % of the starts leave, or less, where dry friction holds the balls, in M R",
              percent),
          [q](const SweepOutcome& o) { return o.unbalance.empty() ? std::nullopt : std::optional(o.unbalance[q]); });
    }
  }

  void add_transients() {
    const std::size_t quantile = data_.dimension("quantile", reported_quantiles.size());
    data_.add("quantile", "1", "probability of a quantile", {quantile},
              [](std::size_t k) { return reported_quantiles[k]; });
    for (std::size_t k = 0; k < transient_figures.size(); ++k) {
      const auto of_quantiles = [&](const std::string& suffix, const std::string& words,
                                    double QuantileEstimate::*part) {
        const auto of_quantile = [k, part](const SweepCell& cell, std::size_t q) {
          const bool told = cell.transients && cell.transients->tells(k);
          return told ? cell.transients->figures[k].quantiles[q].*part : no_number;
        };
        column(transient_figures[k].name + suffix, "1", words + transient_figures[k].long_name(), of_quantile,
               {quantile});
      };
      of_quantiles("", "quantile over starts: ", &QuantileEstimate::value);
      of_quantiles("_low", "lower end of its 95 % interval: ", &QuantileEstimate::low);
      of_quantiles("_high", "upper end of its 95 % interval: ", &QuantileEstimate::high);
    }
    for (std::size_t k = 0; k < transient_limits.size(); ++k)
      of_starts(std::string("exceeded_") + transient_limits[k].name,
                fmt::format("share of starts above limits.{}", transient_limits[k].name),
                [k](const TransientGroup& all) { return all.exceeded[k]; });
    for (std::size_t k = 0; k < within_names.size(); ++k)
      of_starts(std::string("limits_kept_") + within_names[k],
                fmt::format("share of starts that keep all limits: {}", within_titles[k]),
                [k](const TransientGroup& all) { return all.within[k]; });
  }

  // A share of all starts, empty where it is not requested, with its interval.
  template <class Of>
  void of_starts(const std::string& name, const std::string& words, const Of& of) {
    const auto part = [&](const std::string& suffix, const std::string& meaning, double Share::*member) {
      column(name + suffix, "1", meaning, [of, member](const SweepCell& cell, std::size_t) {
        const auto share = cell.transients ? of(*cell.transients) : std::nullopt;
        return share ? *share.*member : no_number;
      });
    };
    part("", words, &Share::share);
    part("_low", io::lower_end, &Share::low);
    part("_high", io::upper_end, &Share::high);
  }

  const SweepResult& result_;
  const io::CellRecords records_;
  io::CellDataset data_;
  std::vector<int> codes_;
  std::size_t outcome_ = 0;
};

// Their content depends only on the result, not on how long it took.
void write_sweep(const std::string& path, const std::string& identity, const SweepResult& result) {
  io::write_netcdf_file(path, SweepColumns(identity, result).data());
}

}  // namespace

void write_sweep_file(const std::string& path, const SweepResult& result) {
  write_sweep(io::path_for_whole_results(path), result.identity, result);
}

StoredSweep read_sweep(const std::string& path) {
  StoredSweep sweep;
  const io::CellFile file(io::sweep_kind, path, taken_into(sweep.cells));
  sweep.identity = file.identity();
  sweep.loss = file.loss();
  return sweep;
}

namespace io {

std::unique_ptr<CellFile> open_sweep_file(const std::string& path, const std::string& identity, SweepCells& cells) {
  return std::make_unique<CellFile>(sweep_kind, path, identity, cells.size(), taken_into(cells));
}

void finish_sweep_file(CellFile& file, const SweepResult& result) {
  file.finish([&](const std::string& path) { write_sweep(path, file.identity(), result); },
              result.complete() ? CellFile::Rest::nothing : CellFile::Rest::notes);
}

}  // namespace io
}  // namespace equipoise

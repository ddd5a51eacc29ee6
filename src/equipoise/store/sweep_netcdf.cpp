// Coordinates, shares, motions and transients of all cells; behind them every cell as the program reads it back.
#include "equipoise/store/sweep_netcdf.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <netcdf.h>

#include "equipoise/base/version.hpp"
#include "equipoise/files/netcdf.hpp"
#include "equipoise/results/branches_result.hpp"
#include "equipoise/store/basin_file.hpp"
#include "equipoise/store/sweep_cells.hpp"

namespace equipoise::store {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::string variable_name(const std::string& key) {
  std::string name = key;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

class SweepWriter {
 public:
  SweepWriter(NetcdfFile& file, const std::string& identity, const SweepResult& result)
      : file_(file), identity_(identity), result_(result) {
    const auto note = [&](int code, const std::string& name, const std::string& alias) {
      kinds_.try_emplace(code, name, alias);
    };
    for (const auto& cell : result.cells) {
      if (!cell) continue;
      for (const SweepOutcome& o : cell->outcomes) note(o.id, o.name, o.alias);
      if (cell->stalled) note(stalled_code, "stalled", "");
    }
    note(undecided_code, "undecided", "");
    note(diverged_code, "diverged", "");
    note(failed_code, "failed", "");
    for (const auto& [code, names] : kinds_) codes_.push_back(code);
    // Attractors first, as people list them.
    std::stable_partition(codes_.begin(), codes_.end(), [](int code) { return code > 0; });
    for (const int code : codes_) {
      names_.push_back(kinds_.at(code).first);
      aliases_.push_back(kinds_.at(code).second);
    }
    for (const auto& cell : result.cells) {
      const std::vector<std::uint8_t> bytes = cell ? bytes_of(*cell) : std::vector<std::uint8_t>{};
      records_.insert(records_.end(), bytes.begin(), bytes.end());
      record_ends_.push_back(static_cast<double>(records_.size()));
    }
  }

  void write() {
    define();
    for (const auto& [variable, values] : coordinates_) file_.write(variable, {0}, {values->size()}, values->data());
    for (const Column& column : columns_) write_column(column);
    for (std::size_t k = 0; k < codes_.size(); ++k) file_.write(code_, {k}, {1}, &codes_[k]);
    file_.write_texts(name_, names_);
    file_.write_texts(alias_, aliases_);
    for (std::size_t k = 0; k < reported_quantiles.size(); ++k) {
      if (quantile_ >= 0) file_.write(quantile_, {k}, {1}, &reported_quantiles[k]);
    }
    if (!records_.empty()) file_.write(record_, {0}, {records_.size()}, records_.data());
    file_.write(record_end_, {0}, {record_ends_.size()}, record_ends_.data());
  }

 private:
  // Values of a cell, `width` of them; missing ones are not-a-number.
  struct Column {
    int variable = -1;
    std::size_t width = 1;
    std::function<void(const SweepCell&, double*)> values;
  };

  void define() {
    define_axes();
    outcome_ = file_.dimension("outcome", codes_.size());
    code_ = file_.variable("outcome", NC_INT, {outcome_}, "1",
                           "identifier of an attractor, the same in all cells; 0 undecided, negative: lost or stalled");
    name_ = file_.text_variable("name", outcome_, names_, "name of the outcome");
    alias_ = file_.text_variable("alias", outcome_, aliases_, "name that Wright and Peng (2019) give it");
    column("starts", "1", "starts counted", 1,
           [](const SweepCell& c, double* v) { *v = static_cast<double>(c.starts); });
    column("balanced_stable", "1", "1: a linearly stable balanced state exists", 1,
           [](const SweepCell& c, double* v) { *v = c.balanced_stable; });
    define_shares();
    define_motions();
    if (result_.transients) define_transients();
    const int bytes = file_.dimension("record_byte", std::max<std::size_t>(records_.size(), 1));
    const int cells = file_.dimension("cell", result_.cells.size());
    record_ =
        file_.variable("record", NC_BYTE, {bytes}, "1", "all that is known of every cell, for the program (CBOR)");
    record_end_ = file_.variable("record_end", NC_DOUBLE, {cells}, "1", "where in record a cell ends, in bytes");
    define_attributes();
    file_.end_definitions();
  }

  void define_axes() {
    for (const SweepAxis& axis : result_.axes) {
      const bool zipped = axis.parameters.size() > 1;
      const std::string first = variable_name(axis.parameters.front().key);
      const int dimension = file_.dimension(zipped ? "step" : first, axis.size());
      axis_dimensions_.push_back(dimension);
      for (const SweepParameter& p : axis.parameters) {
        const int variable = file_.variable(variable_name(p.key), NC_DOUBLE, {dimension}, p.unit.empty() ? "1" : p.unit,
                                            fmt::format("{}: {}", p.key, parameter_label(p.key)));
        coordinates_.emplace_back(variable, &p.values);
        if (zipped) along_ += (along_.empty() ? "" : " ") + variable_name(p.key);
      }
    }
  }

  void column(const std::string& name, const char* units, const std::string& meaning, std::size_t width,
              const std::function<void(const SweepCell&, double*)>& values, int dimension = -1) {
    std::vector<int> dimensions = axis_dimensions_;
    if (dimension >= 0) dimensions.push_back(dimension);
    const int variable = file_.variable(name, NC_DOUBLE, dimensions, units, meaning);
    file_.fill(variable, &none);
    if (!along_.empty()) file_.attribute(variable, "coordinates", along_);
    columns_.push_back({variable, dimension >= 0 ? width : 0, values});
  }

  void define_shares() {
    const auto of_outcomes = [&](const char* name, const char* meaning, double (*value)(const Share&)) {
      column(
          name, "1", meaning, codes_.size(),
          [this, value](const SweepCell& cell, double* values) {
            for (std::size_t k = 0; k < codes_.size(); ++k)
              if (const Share* share = share_of(cell, codes_[k])) values[k] = value(*share);
          },
          outcome_);
    };
    of_outcomes("count", "starts with the outcome", [](const Share& s) { return static_cast<double>(s.count); });
    of_outcomes("share", "share of the starts", [](const Share& s) { return s.share; });
    of_outcomes("share_low", "lower end of its 95 % interval", [](const Share& s) { return s.low; });
    of_outcomes("share_high", "upper end of its 95 % interval", [](const Share& s) { return s.high; });
    of_outcomes("share_least", "lower bound whatever undecided starts come to", [](const Share& s) { return s.least; });
    of_outcomes("share_most", "upper bound whatever undecided starts come to", [](const Share& s) { return s.most; });
  }

  // Null: the cell does not have it.
  static const Share* share_of(const SweepCell& cell, int code) {
    if (code == undecided_code) return &cell.undecided;
    if (code == diverged_code) return &cell.diverged;
    if (code == failed_code) return &cell.failed;
    if (code == stalled_code) return cell.stalled ? &*cell.stalled : nullptr;
    for (const SweepOutcome& o : cell.outcomes)
      if (o.id == code) return &o.share;
    return nullptr;
  }

  void define_motions() {
    const auto of_motions = [&](const char* name, const char* meaning, double (*value)(const SweepOutcome&)) {
      column(
          name, "1", meaning, codes_.size(),
          [this, value](const SweepCell& cell, double* values) {
            for (const SweepOutcome& o : cell.outcomes)
              values[std::find(codes_.begin(), codes_.end(), o.id) - codes_.begin()] = value(o);
          },
          outcome_);
    };
    of_motions("mean_time", "mean time to the decision, in 1/omega_c",
               [](const SweepOutcome& o) { return o.share.count > 0 ? o.mean_time : none; });
    of_motions("r_min", "smallest distance of the rotor's centre from the axis, in race radii",
               [](const SweepOutcome& o) { return o.r_min.value_or(none); });
    of_motions("r_mean", "mean distance of the rotor's centre from the axis, in race radii",
               [](const SweepOutcome& o) { return o.r_mean.value_or(none); });
    of_motions("r_max", "largest distance of the rotor's centre from the axis, in race radii",
               [](const SweepOutcome& o) { return o.r_max.value_or(none); });
    of_motions("period", "period of a periodic motion, in 1/omega_c",
               [](const SweepOutcome& o) { return o.period > 0.0 ? o.period : none; });
  }

  void define_transients() {
    const int quantile = file_.dimension("quantile", reported_quantiles.size());
    quantile_ = file_.variable("quantile", NC_DOUBLE, {quantile}, "1", "probability of a quantile");
    for (std::size_t k = 0; k < transient_columns.size(); ++k) {
      const auto of_quantiles = [&](const std::string& suffix, const std::string& words,
                                    double QuantileEstimate::*part) {
        column(
            transient_columns[k].name + suffix, "1", words + transient_columns[k].long_name, reported_quantiles.size(),
            [k, part](const SweepCell& cell, double* values) {
              for (std::size_t q = 0; cell.transients && q < reported_quantiles.size(); ++q)
                values[q] = cell.transients->figures[k].quantiles[q].*part;
            },
            quantile);
      };
      of_quantiles("", "quantile over starts: ", &QuantileEstimate::value);
      of_quantiles("_low", "lower end of its 95 % interval: ", &QuantileEstimate::low);
      of_quantiles("_high", "upper end of its 95 % interval: ", &QuantileEstimate::high);
    }
    for (std::size_t k = 0; k < transient_limit_names.size(); ++k) {
      const std::string limit = transient_limit_names[k];
      const auto exceeded = [&](const std::string& name, const std::string& words, double Share::*part) {
        column(name, "1", words, 1, [k, part](const SweepCell& cell, double* value) {
          if (cell.transients && cell.transients->exceeded[k]) *value = *cell.transients->exceeded[k].*part;
        });
      };
      exceeded("exceeded_" + limit, "share of starts above limits." + limit, &Share::share);
      exceeded("exceeded_" + limit + "_low", "lower end of its 95 % interval", &Share::low);
      exceeded("exceeded_" + limit + "_high", "upper end of its 95 % interval", &Share::high);
    }
  }

  void define_attributes() {
    const std::string study = to_toml(result_.study);
    file_.attribute(NC_GLOBAL, "Conventions", "CF-1.8");
    file_.attribute(NC_GLOBAL, "title", "Where a rotor with an automatic ball balancer ends, over parameters");
    file_.attribute(NC_GLOBAL, "source", fmt::format("equipoise {}", version_string));
    file_.attribute(NC_GLOBAL, "kind", "sweep");
    file_.attribute(NC_GLOBAL, "identity", identity_);
    file_.attribute(NC_GLOBAL, "study", study);
    file_.attribute(NC_GLOBAL, "complete", result_.complete() ? "yes" : "no");
  }

  void write_column(const Column& column) {
    std::vector<double> values(std::max<std::size_t>(column.width, 1));
    for (std::size_t index = 0; index < result_.cells.size(); ++index) {
      if (!result_.cells[index]) continue;
      std::fill(values.begin(), values.end(), none);
      column.values(*result_.cells[index], values.data());
      std::vector<std::size_t> start = result_.place(index), count(start.size(), 1);
      if (column.width > 0) {
        start.push_back(0);
        count.push_back(column.width);
      }
      file_.write(column.variable, start, count, values.data());
    }
  }

  NetcdfFile& file_;
  const std::string& identity_;
  const SweepResult& result_;
  std::map<int, std::pair<std::string, std::string>> kinds_;
  std::vector<int> codes_, axis_dimensions_;
  std::vector<std::string> names_, aliases_;
  std::vector<std::uint8_t> records_;
  std::vector<double> record_ends_;
  std::vector<std::pair<int, const std::vector<double>*>> coordinates_;
  std::vector<Column> columns_;
  std::string along_;  // coordinates of zipped parameters
  int outcome_ = -1, code_ = -1, name_ = -1, alias_ = -1, quantile_ = -1, record_ = -1, record_end_ = -1;
};

}  // namespace

void write_sweep_netcdf(const std::string& path, const std::string& identity, const SweepResult& result) {
  write_netcdf_file(
      path, [&](NetcdfFile& file) { SweepWriter(file, identity, result).write(); }, NetcdfFile::Mode::create_large);
}

}  // namespace equipoise::store

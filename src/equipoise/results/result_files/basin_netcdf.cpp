// Dimensions, variables and attributes of an ensemble's results.
#include "equipoise/results/result_files/basin_netcdf.hpp"

#include <algorithm>
#include <limits>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <netcdf.h>

#include "equipoise/core/base/version.hpp"
#include "equipoise/results/io/netcdf.hpp"
#include "equipoise/results/io/replacement.hpp"
#include "equipoise/results/io/sealed_file.hpp"
#include "equipoise/results/result_files/result_identity.hpp"
#include "equipoise/results/result_files/share_columns.hpp"
#include "equipoise/results/words/files.hpp"
#include "equipoise/study/sampling/scrambled_sobol.hpp"

namespace equipoise::io {

namespace {

// Starts copied at a time.
constexpr std::size_t block = 65536;

class BasinWriter {
 public:
  BasinWriter(NetcdfFile& file, const BasinContents& contents)
      : file_(file), c_(contents), random_(contents.header.method == SamplingMethod::random) {
    for (const OutcomeShare& s : c_.summary) {
      names_.push_back(s.name);
      aliases_.push_back(s.alias);
      intervals_.emplace_back(interval_names[static_cast<std::size_t>(s.share.by)]);
    }
  }

  void write() {
    file_.leave_unfilled();
    define();
    write_coordinates();
    for (std::size_t k = 0; k < columns_.size(); ++k) copy_column(k);
    for (std::size_t k = 0; k < c_.discoveries.size(); ++k)
      file_.write(discovery_, {k, 0}, {1, c_.discoveries[k].size()}, c_.discoveries[k].data());
    write_summary();
    if (c_.all) write_within();
    if (c_.without_balls) write_one_bodies();
  }

 private:
  // Counts are integers as far as those go, which is enough for any run of this century.
  bool counts_are_short() const { return c_.starts <= static_cast<std::uint64_t>(std::numeric_limits<int>::max()); }
  int count_type() const { return counts_are_short() ? NC_INT : NC_DOUBLE; }

  void define() {
    const std::size_t balls = static_cast<std::size_t>(c_.header.balls);
    const int start = file_.dimension("start", c_.starts);
    const int ball = file_.dimension("ball", balls);
    start_ = file_.variable("start", count_type(), {start}, "1", words::files::index_of_start);
    ball_ = file_.variable("ball", NC_INT, {ball}, "1", words::files::number_of_ball);
    define_columns(start, ball);
    define_kinds(file_.dimension("outcome_kind", c_.summary.size()));
    if (!c_.discoveries.empty()) {
      const int met = file_.dimension("discovery", c_.discoveries.size());
      const int component = file_.dimension("component", components().size());
      component_ = file_.text_variable("component", component, components(), "entry of discovery_state");
      discovery_ = file_.variable(
          "discovery_state", NC_DOUBLE, {met, component}, "1",
          c_.header.drawn.empty() ? words::files::state_met_in_run : words::files::start_that_met_motion);
    }
    define_attributes();
    if (c_.header.transients) define_transients();
    if (c_.all) define_within();
    if (c_.without_balls) define_one_bodies();
    file_.end_definitions();
  }

  void define_columns(int start, int ball) {
    const bool whole = c_.header.full_starts;
    const int rotor = whole ? file_.dimension("rotor_component", rotor_components().size()) : -1;
    if (whole) rotor_ = file_.text_variable("rotor_component", rotor, rotor_components(), "entry of rotor_state");
    const std::vector<std::string>& drawn = c_.header.drawn;
    const int value = drawn.empty() ? -1 : file_.dimension("uncertain_value", drawn.size());
    if (!drawn.empty()) {
      value_ = file_.text_variable("uncertain_value", value, drawn, words::files::key_of_study);
      unit_ = file_.text_variable("uncertain_unit", value, c_.header.drawn_units, words::files::unit_of_drawn);
    }
    for (const StartColumn& c : c_.columns) {
      std::vector<int> along{start};
      if (!c.along.empty()) along.push_back(c.along == "ball" ? ball : c.along == "rotor_component" ? rotor : value);
      columns_.push_back(file_.variable(c.name, c.type, along, c.cf_units(), c.long_name()));
      if (std::string_view(c.name) == "outcome") describe_outcomes(columns_.back());
      if (std::string_view(c.name) == "decided_by") describe_grounds(columns_.back());
      if (c.type == NC_FLOAT) file_.fill(columns_.back(), &missing_figure);
    }
    file_.leave_unfilled();  // setting a fill value turns filling on
  }

  void describe_outcomes(int variable) {
    std::vector<short> codes;
    std::string words;
    for (const OutcomeShare& s : c_.summary) {
      codes.push_back(static_cast<short>(s.id));
      words += (words.empty() ? "" : " ") + flag_word(s.name);
    }
    file_.attribute(variable, "flag_values", codes);
    file_.attribute(variable, "flag_meanings", words);
  }

  void describe_grounds(int variable) {
    std::vector<signed char> values;
    for (int k = 0; k < decided_by_count; ++k) values.push_back(static_cast<signed char>(k));
    file_.attribute(variable, "flag_values", values);
    file_.attribute(variable, "flag_meanings", fmt::format("{}", fmt::join(decided_by_names, " ")));
  }

  void define_kinds(int kind) {
    kind_code_ = file_.variable("kind_code", NC_SHORT, {kind}, "1", "value of outcome");
    kind_name_ = file_.text_variable("kind_name", kind, names_, words::files::name_of_outcome);
    kind_alias_ = file_.text_variable("kind_alias", kind, aliases_, words::files::name_by_wright_and_peng);
    kind_count_ = file_.variable("kind_count", count_type(), {kind}, "1", words::files::starts_with_outcome);
    for (std::size_t k = 0; k < share_columns.size(); ++k)
      kind_share_[k] = file_.variable(std::string("kind_") + share_columns[k].name, NC_DOUBLE, {kind}, "1",
                                      share_columns[k].of_ensemble);
    define_left_unbalance(kind);
    if (random_) return;  // random starts need no more than their counts
    kind_interval_ = file_.text_variable("kind_interval", kind, intervals_, words::files::interval_from);
    kind_effective_ = file_.variable("kind_effective_starts", NC_DOUBLE, {kind}, "1", words::files::effective_starts);
  }

  void define_left_unbalance(int kind) {
    if (!c_.header.sticks) return;
    const int quantile = file_.dimension("unbalance_quantile", unbalance_quantiles.size());
    quantile_ =
        file_.variable("unbalance_quantile", NC_DOUBLE, {quantile}, "1", words::files::share_of_starts_of_outcome);
    left_ = file_.variable("kind_left_unbalance", NC_DOUBLE, {kind, quantile}, "1", words::files::unbalance_left);
    if (c_.header.scales)
      grade_ =
          file_.variable("kind_left_balance_grade", NC_DOUBLE, {kind, quantile}, "mm s-1", words::files::grade_left);
  }

  void define_attributes() {
    const auto say = [&](const char* name, const std::string& text) { file_.attribute(NC_GLOBAL, name, text); };
    say("Conventions", "CF-1.8");
    say("title", words::files::basins);
    say("source", fmt::format("equipoise {}", version_string));
    say("identity", identity_of(c_.header));
    say("cpu_target", fmt::format("{}", fmt::join(c_.cpu_targets, ", ")));
    say("study", c_.study);
    say("complete", c_.complete ? "yes" : "no");
    say("seconds", fmt::format("{:.3f}", c_.time.seconds));
    say("cpu_seconds", fmt::format("{:.3f}", c_.time.cpu_seconds));
    if (!c_.header.own_starts.empty()) say("own_starts", c_.header.own_starts);
    say("sampling_method", sampling_method_names[static_cast<std::size_t>(c_.header.method)]);
    if (c_.header.method != SamplingMethod::sobol) return;
    say("sampling_replicates", fmt::format("{}", sobol_replicates));
    say("sampling_points_per_replicate", fmt::format("{}", c_.starts / sobol_replicates));
  }

  // Dimensionless like everything else; a study in physical units states its scales.
  void define_transients() {
    const auto say = [&](const char* name, double value) {
      file_.attribute(NC_GLOBAL, name, fmt::format("{}", value));
    };
    const TransientSettings& asked = *c_.header.transients;
    say("transients_window", asked.window);
    say("limits_displacement", asked.displacement);
    say("limits_settled", asked.settled);
    const std::array<double, 2>& places = asked.shaft.places;
    if (places != std::array<double, 2>{})
      file_.attribute(NC_GLOBAL, "displacements_at", fmt::format("{}, {}", places[0], places[1]));
    if (!asked.shaft.bearings.empty()) file_.attribute(NC_GLOBAL, "forces_of", "bearing");
    if (!c_.header.scales) return;
    say("unit_of_length_m", c_.header.scales->length);
    say("unit_of_force_N", c_.header.scales->force());
    say("unit_of_velocity_m_per_s", c_.header.scales->velocity());
    say("unit_of_time_s", c_.header.scales->time());
    say("unit_of_energy_J", c_.header.scales->torque());
  }

  // Starts within all stated limits.
  void define_within() {
    for (std::size_t k = 0; k < within_names.size(); ++k)
      if (c_.all->within[k]) {
        within_.push_back(*c_.all->within[k]);
        within_names_.emplace_back(within_names[k]);
      }
    if (within_.empty()) return;
    const int kept = file_.dimension("limits_kept", within_.size());
    kept_name_ = file_.text_variable("limits_kept", kept, within_names_, words::files::within_all_limits);
    for (std::size_t c = 0; c < share_columns.size(); ++c)
      kept_share_[c] = file_.variable(std::string("limits_kept_") + share_columns[c].name, NC_DOUBLE, {kept}, "1",
                                      share_columns[c].of_ensemble);
  }

  // The rotor without balls, and with balls held where they start.
  void define_one_bodies() {
    for (const TransientFigure& f : transient_figures)
      if (f.of_bare_rotor) figure_names_.emplace_back(f.name);
    const int body = file_.dimension("one_body", 2), figure = file_.dimension("one_body_figure", figure_names_.size()),
              quantile = file_.dimension("figure_quantile", reported_quantiles.size());
    body_name_ = file_.text_variable("one_body", body, one_bodies(), words::files::what_rotor_carries);
    figure_name_ = file_.text_variable("one_body_figure", figure, figure_names_, words::files::column_of_transients);
    figure_quantile_ = file_.variable("figure_quantile", NC_DOUBLE, {quantile}, "1", words::files::share_of_runs_below);
    body_runs_ = file_.variable("one_body_runs", NC_DOUBLE, {body}, "1", "runs followed");
    body_stalled_ = file_.variable("one_body_stalled", NC_DOUBLE, {body}, "1", words::files::runs_stalled);
    body_mean_ = file_.variable("one_body_mean", NC_DOUBLE, {body, figure}, "1", words::files::mean_of_runs);
    body_quantile_ =
        file_.variable("one_body_quantile", NC_DOUBLE, {body, figure, quantile}, "1", words::files::quantile_of_runs);
  }

  static const std::vector<std::string>& one_bodies() {
    static const std::vector<std::string> names{words::files::no_balls, words::files::balls_held};
    return names;
  }

  void write_within() {
    if (within_.empty()) return;
    file_.write_texts(kept_name_, within_names_);
    for (std::size_t k = 0; k < within_.size(); ++k)
      for (std::size_t c = 0; c < share_columns.size(); ++c)
        file_.write(kept_share_[c], {k}, {1}, &(within_[k].*share_columns[c].value));
  }

  void write_one_bodies() {
    constexpr std::size_t width = reported_quantiles.size();
    file_.write_texts(body_name_, one_bodies());
    file_.write_texts(figure_name_, figure_names_);
    file_.write(figure_quantile_, {0}, {width}, reported_quantiles.data());
    std::size_t b = 0;
    for (const OneBodyRuns* body : {&c_.without_balls->bare, &c_.without_balls->held}) {
      const double runs = static_cast<double>(body->runs), stalled = static_cast<double>(body->stalled);
      file_.write(body_runs_, {b}, {1}, &runs);
      file_.write(body_stalled_, {b}, {1}, &stalled);
      std::size_t place = 0;
      for (std::size_t k = 0; k < transient_figures.size(); ++k) {
        if (!transient_figures[k].of_bare_rotor) continue;
        const SampleSummary& s = body->figures.figures[k];
        const double missing = std::numeric_limits<double>::quiet_NaN(), mean = s.open < s.count ? s.mean : missing;
        std::array<double, width> values;
        for (std::size_t q = 0; q < width; ++q) values[q] = s.count > 0 ? s.quantiles[q].value : missing;
        file_.write(body_mean_, {b, place}, {1, 1}, &mean);
        file_.write(body_quantile_, {b, place, 0}, {1, 1, width}, values.data());
        ++place;
      }
      ++b;
    }
  }

  static const std::vector<std::string>& rotor_components() {
    static const std::vector<std::string> names{"x", "y", "x_dot", "y_dot"};
    return names;
  }

  std::vector<std::string> components() const {
    return c_.header.drawn.empty() ? c_.header.variables : std::vector<std::string>{"start"};
  }

  void write_coordinates() {
    for (std::uint64_t first = 0; first < c_.starts; first += block) write_indices(first);
    for (int i = 0; i < c_.header.balls; ++i) {
      const int number = i + 1;
      file_.write(ball_, {static_cast<std::size_t>(i)}, {1}, &number);
    }
    if (c_.header.full_starts) file_.write_texts(rotor_, rotor_components());
    if (!c_.header.drawn.empty()) {
      file_.write_texts(value_, c_.header.drawn);
      file_.write_texts(unit_, c_.header.drawn_units);
    }
    if (!c_.discoveries.empty()) file_.write_texts(component_, components());
  }

  void write_indices(std::uint64_t first) {
    const std::size_t count = std::min<std::uint64_t>(block, c_.starts - first);
    if (counts_are_short()) return write_numbers<int>(first, count);
    write_numbers<double>(first, count);
  }

  template <class T>
  void write_numbers(std::uint64_t first, std::size_t count) {
    std::vector<T> numbers(count);
    for (std::size_t i = 0; i < count; ++i) numbers[i] = static_cast<T>(first + i);
    file_.write(start_, {first}, {count}, numbers.data());
  }

  void copy_column(std::size_t k) {
    const StartColumn& c = c_.columns[k];
    std::vector<char> values(block * c.bytes());
    for (std::uint64_t first = 0; first < c_.starts; first += block) {
      const std::size_t count = std::min<std::uint64_t>(block, c_.starts - first);
      c_.read(k, first, count, values.data());
      std::vector<std::size_t> begin{first}, length{count};
      if (!c.along.empty()) begin.push_back(0), length.push_back(c.width);
      file_.write(columns_[k], begin, length, values.data());
    }
  }

  void write_summary() {
    for (std::size_t k = 0; k < c_.summary.size(); ++k) {
      const OutcomeShare& s = c_.summary[k];
      const short code = static_cast<short>(s.id);
      const int few = static_cast<int>(s.share.count);
      const double many = static_cast<double>(s.share.count);
      file_.write(kind_code_, {k}, {1}, &code);
      file_.write(kind_count_, {k}, {1}, counts_are_short() ? static_cast<const void*>(&few) : &many);
      for (std::size_t c = 0; c < share_columns.size(); ++c)
        file_.write(kind_share_[c], {k}, {1}, &(s.share.*share_columns[c].value));
      if (!random_) file_.write(kind_effective_, {k}, {1}, &s.share.effective_starts);
    }
    if (quantile_ >= 0) write_left_unbalance();
    file_.write_texts(kind_name_, names_);
    file_.write_texts(kind_alias_, aliases_);
    if (!random_) file_.write_texts(kind_interval_, intervals_);
  }

  void write_left_unbalance() {
    constexpr std::size_t width = unbalance_quantiles.size();
    const std::vector<double> none(width, std::numeric_limits<double>::quiet_NaN());
    file_.write(quantile_, {0}, {width}, unbalance_quantiles.data());
    for (std::size_t k = 0; k < c_.summary.size(); ++k) {
      const auto row = [&](int variable, const std::vector<double>& values) {
        if (variable >= 0) file_.write(variable, {k, 0}, {1, width}, (values.empty() ? none : values).data());
      };
      row(left_, c_.summary[k].unbalance);
      row(grade_, c_.summary[k].grade);
    }
  }

  NetcdfFile& file_;
  const BasinContents& c_;
  bool random_;
  std::vector<std::string> names_, aliases_, intervals_;
  std::vector<int> columns_;
  int start_ = -1, ball_ = -1, rotor_ = -1, component_ = -1, discovery_ = -1, value_ = -1, unit_ = -1;
  int kind_code_ = -1, kind_name_ = -1, kind_alias_ = -1, kind_count_ = -1, kind_interval_ = -1, kind_effective_ = -1;
  std::array<int, share_columns.size()> kind_share_{};
  int quantile_ = -1, left_ = -1, grade_ = -1;
  std::vector<Share> within_;
  std::vector<std::string> within_names_, figure_names_;
  int kept_name_ = -1, body_name_ = -1, figure_name_ = -1, figure_quantile_ = -1, body_runs_ = -1, body_stalled_ = -1;
  int body_mean_ = -1, body_quantile_ = -1;
  std::array<int, share_columns.size()> kept_share_{};
};

}  // namespace

void write_basin_netcdf(const std::string& path, const BasinContents& contents) {
  constexpr std::uint64_t large = std::uint64_t{1} << 31;  // bytes of a variable
  bool any_large = false;
  for (const StartColumn& c : contents.columns) any_large = any_large || contents.starts >= large / c.bytes();
  Replacement place(path, ".new");
  {
    using Mode = NetcdfFile::Mode;
    NetcdfFile file(place.file(), any_large ? Mode::create_large : Mode::create, path);
    BasinWriter(file, contents).write();
    file.close();
  }
  seal(place.file(), path);
  place.commit();
}

}  // namespace equipoise::io

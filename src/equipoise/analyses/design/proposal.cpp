// A [design] for a study that states none.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "equipoise/analyses/design/problem.hpp"
#include "equipoise/analyses/design/search.hpp"
#include "equipoise/analyses/design/settings.hpp"
#include "equipoise/classification/attractor_search/search.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/machine/datasheet/oils.hpp"
#include "equipoise/machine/datasheet/materials.hpp"
#include "equipoise/study/reading/table_reader.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise {

namespace {

// Trajectories that take a minute or two of two cores: of balls that strike each other every turn or of rotors that
// each start draws, of touching balls, and of others.
constexpr int dear_budget = 3000, contact_budget = 40'000, plain_budget = 3000;
constexpr double usual_share = 0.95, greatest_share = 0.99;
constexpr double fewest_that_prove = 3.9;  // starts times (1 - share): if all do it, that share does (95 % confidence)
constexpr int most_balls_proposed = 8, more_touching_balls = 2;
constexpr double around_size = 1.6, around_drag = 5.0, around_mass = 3.0, around_release = 3.0;

class Proposal {
 public:
  explicit Proposal(const StudySource& source)
      : tree_(study::parse_study_file(source.toml, source.name, source.overrides).root),
        name_(source.name),
        study_(source.with()) {
    tree_.erase("design");
    tree_.erase("sweep");
    dear_ = is_dear(study_.system()) || !study_.uncertain.empty();
  }

  std::string toml() {
    number_of_balls();
    size();
    drag();
    latch();
    if (vary_.empty())
      throw InputError(name_, "design", "",
                       "missing, and this study states no number, size or drag of equal balls that could be chosen; "
                       "must be a table that says what may be varied and what is wanted");
    const double share = std::min(study_.limits.share.value_or(usual_share), greatest_share);
    const int starts = 100 * static_cast<int>(std::ceil(fewest_that_prove / (1.0 - share) / 100.0));
    const int budget = std::max(20 * starts, dear_                               ? dear_budget
                                             : study_.parameters.balls_collide() ? contact_budget
                                                                                 : plain_budget);
    std::string text = fmt::format("\n[design]\nobjective = [\"peak_radial.{:.6g}\"]\nstarts = {}\ntrajectories = {}\n",
                                   share, starts, budget);
    if (!optimisers_built_in()) text += "method = \"latin\"\n";
    text += "\n[design.vary]\n" + vary_ + "\n[design.require]\n";
    text += fmt::format("balanced = {{ above = {:.6g} }}\n", share);
    if (study_.limits.any()) text += fmt::format("limits_kept = {{ above = {:.6g} }}\n", share);
    return text;
  }

 private:
  bool valid(const std::string& key, const StudyValue& value) const {
    try {
      StudyValue tree = tree_;
      set_in(tree, {{key, value}});
      study_from(tree, name_);
      return true;
    } catch (const InputError&) {
      return false;
    }
  }

  void add(const std::string& key, const std::string& form) { vary_ += fmt::format("\"{}\" = {}\n", key, form); }

  // Of a plain number or a quantity of this key.
  std::optional<StudyValue> stated(const std::string& key) const {
    const StudyValue* value = tree_.find_path(key);
    if (!value || !(value->is_number() || value->string())) return std::nullopt;
    return *value;
  }

  void number_of_balls() {
    const StudyValue* given = tree_.find_path("balancer.balls");
    if (!given || !given->integer() || tree_.find_path("initial.phi") || tree_.find_path("initial.phi_dot")) return;
    const int now = study_.parameters.balls;
    int low = now, high = now;
    while (low > 2 && valid("balancer.balls", low - 1)) --low;
    const bool touch = study_.parameters.balls_collide();  // many that do are costly to follow
    const int most = touch ? std::min(now + more_touching_balls, most_balls_proposed) : most_balls_proposed;
    while (high < most && valid("balancer.balls", high + 1)) ++high;
    if (low < high) add("balancer.balls", fmt::format("[{}, {}]", low, high));
  }

  void size() {
    const auto given = stated("balancer.ball_diameter");
    if (!given || !given->string() || !study_.scales) {
      around("balancer.mass", around_mass);
      return;
    }
    const study::Measured length = study::measure(*given->string(), {study::Dimension::length});
    const double mm = 1e3 * length.value;
    std::vector<double> sizes;
    for (const double d : model::stock_ball_diameters)
      if (d * around_size >= mm && d <= around_size * mm && valid("balancer.ball_diameter", fmt::format("{} mm", d)))
        sizes.push_back(d);
    const bool beyond = mm > model::stock_ball_diameters.back();  // larger ones are made to order
    if (sizes.size() > 1 && !beyond)
      add("balancer.ball_diameter", fmt::format("{{ stock = [\"{} mm\", \"{} mm\"] }}", sizes.front(), sizes.back()));
    if (beyond) whole_mm(mm);
  }

  void whole_mm(double mm) {
    const auto fits = [&](double d) { return valid("balancer.ball_diameter", fmt::format("{:.0f} mm", d)); };
    double low = std::round(mm), high = low;
    if (!fits(low)) return;
    while ((low - 1.0) * around_size >= mm && fits(low - 1.0)) --low;
    while (high + 1.0 <= around_size * mm && fits(high + 1.0)) ++high;
    if (low < high)
      add("balancer.ball_diameter",
          fmt::format("{{ range = [\"{:.0f} mm\", \"{:.0f} mm\"], step = \"1 mm\" }}", low, high));
  }

  void drag() {
    if (around("balancer.drag", around_drag) || around("balancer.oil_viscosity", around_drag)) return;
    const auto grade = stated("balancer.oil.grade");
    if (!grade || !grade->string() || tree_.find_path("balancer.oil.viscosity_100")) return;
    if (grade->string()->starts_with("silicone")) return;
    std::vector<double> classes;
    for (const double middle : model::iso_viscosity_grades)
      if (middle >= 10.0 && middle <= 460.0 && valid("balancer.oil.grade", fmt::format("ISO VG {:.0f}", middle)))
        classes.push_back(middle);
    if (classes.size() > 1)
      add("balancer.oil.grade",
          fmt::format("{{ stock = [\"ISO VG {:.0f}\", \"ISO VG {:.0f}\"] }}", classes.front(), classes.back()));
  }

  // A latch is one that holds the balls for some time.
  void latch() {
    if (const auto time = stated("release.time"); time && number_of(*time) > 0.0)
      around("release.time", around_release);
    around("release.speed", around_release);
  }

  // From the number over `factor` to its product with it, or as near to that as makes a study.
  bool around(const std::string& key, double factor) {
    const auto given = stated(key);
    const double number = given ? number_of(*given) : 0.0;
    if (!(number > 0.0)) return false;
    const std::string unit = unit_of_value(*given);
    const auto end = [&](double exponent) -> std::optional<StudyValue> {
      for (const double part : {1.0, 0.5, 0.2}) {
        StudyValue value = two_digits(number * std::pow(factor, exponent * part), unit);
        if (valid(key, value)) return value;
      }
      return std::nullopt;
    };
    const auto low = end(-1.0), high = end(1.0);
    if (!low || !high || !(number_of(*low) < number_of(*high))) return false;
    add(key, fmt::format("{{ range = [{}, {}], scale = \"log\", digits = 2 }}", text_of(*low), text_of(*high)));
    return true;
  }

  static StudyValue two_digits(double number, const std::string& unit) {
    const double step = std::pow(10.0, std::floor(std::log10(number)) - 1.0);
    return value_of(std::round(number / step) * step, unit);
  }

  StudyValue tree_;
  std::string name_;
  Study study_;
  bool dear_ = false;
  std::string vary_;
};

}  // namespace

std::string proposed_design(const StudySource& source) { return Proposal(source).toml(); }

}  // namespace equipoise

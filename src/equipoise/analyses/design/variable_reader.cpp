// Ranges, choices and spin-ups.
#include "equipoise/analyses/design/variable_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/analyses/design/problem.hpp"
#include "equipoise/analyses/design/settings.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/machine/datasheet/oils.hpp"
#include "equipoise/machine/datasheet/materials.hpp"
#include "equipoise/machine/drives/spin_up_shape.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise {

namespace {

constexpr char must_be_few_digits[] = "digits must be 1, 2 or 3";

using study::Dimension;

constexpr const char* forms =
    "must be [low, high], { range = [low, high], scale = \"log\", digits = 2 }, { range = [low, high], step = STEP }, "
    "{ choices = [..] }, { stock = [low, high] }, or for \"speed\" { points = 2, until = 500.0, range = [0.0, 3.0], "
    "slope = 0.05 }; put a study's keys in quotes";

// Properties of a machine; how starts are drawn or decided is not the designer's choice.
constexpr std::array<std::string_view, 5> tables{"rotor", "balancer", "speed", "release", "initial"};

bool of_a_machine(const std::string& key) {
  const std::size_t dot = key.find('.');
  return key == "speed" ||
         (dot != std::string::npos && std::find(tables.begin(), tables.end(), key.substr(0, dot)) != tables.end());
}

bool whole_number(const std::string& key) { return key == "balancer.balls"; }

void read_range(const DesignEntry& entry, const StudyValue& written, DesignVariable& variable) {
  const auto [low, high] = entry.range(written);
  variable.low = low.value;
  variable.high = high.value;
  variable.unit = low.unit;
  variable.whole = whole_number(variable.key);
  if (variable.whole && (std::floor(variable.low) != variable.low || std::floor(variable.high) != variable.high))
    entry.fail("must have whole numbers at both ends");
}

void read_choices(const DesignEntry& entry, const StudyValue& written, DesignVariable& variable) {
  const StudyValue::Array* array = written.array();
  if (!array || array->size() < 2) entry.fail("choices must be an array of two or more values");
  for (const StudyValue& choice : *array) {
    if (choice.table() || choice.array() || choice.other()) entry.fail("choices must be numbers, quantities or words");
    for (const StudyValue& other : variable.choices)
      if (text_of(other) == text_of(choice)) entry.fail(fmt::format("has {} twice", text_of(choice)));
    variable.choices.push_back(choice);
  }
  variable.unit = unit_of_value(variable.choices.front());
}

// Only these values may be chosen.
void allow(const DesignEntry& entry, DesignVariable& variable, const std::vector<double>& numbers) {
  if (numbers.size() < 2) entry.fail("leaves fewer than two values to choose from; must have a wider range");
  variable.numbers = numbers;
  for (const double n : numbers)
    variable.choices.push_back(variable.prefix.empty() ? value_of(n, variable.unit)
                                                       : StudyValue(fmt::format("{}{:.6g}", variable.prefix, n)));
  variable.low = numbers.front();
  variable.high = numbers.back();
}

constexpr double most_allowed = 10'000.0;
constexpr double rounded = 1e-9;  // relative: multiples of a step are rounded

std::vector<double> multiples(const DesignEntry& entry, double step, double low, double high) {
  if (!(step > 0.0) || (high - low) / step > most_allowed)
    entry.fail(fmt::format("step must be greater than 0 and leave {:.0f} values at most", most_allowed));
  std::vector<double> numbers;
  for (double k = std::ceil(low / step - rounded); k * step <= high + rounded * step; ++k)
    numbers.push_back(k * step + 0.0);  // not -0
  return numbers;
}

// Numbers with `digits` digits; in a range from 0, those above a thousandth of its end.
std::vector<double> of_digits(const DesignEntry& entry, double digits, double low, double high) {
  if (!(digits >= 1.0 && digits <= 3.0 && std::floor(digits) == digits)) entry.fail(must_be_few_digits);
  if (low < 0.0) entry.fail("must begin at 0 or above where digits are given");
  std::vector<double> numbers;
  if (low == 0.0) numbers.push_back(0.0);
  const double from = low > 0.0 ? low : 1e-3 * high;
  for (double decade = std::floor(std::log10(from) + rounded); decade <= std::log10(high); ++decade) {
    const double step = std::pow(10.0, decade - digits + 1.0);
    for (double k = std::pow(10.0, digits - 1.0); k < std::pow(10.0, digits) - 0.5; ++k)
      if (k * step >= from * (1.0 - rounded) && k * step <= high * (1.0 + rounded))
        numbers.push_back(k * step + 0.0);  // not -0
  }
  if (static_cast<double>(numbers.size()) > most_allowed) entry.fail("has too many values with that number of digits");
  return numbers;
}

double in_mm(const DesignEntry& entry, const StudyValue& written) {
  const std::string* text = written.string();
  const study::Measured length = study::measure(text ? *text : "", {Dimension::length});
  if (!text || !length.problem.empty()) entry.fail("stock must have two lengths, such as [\"6 mm\", \"12 mm\"]");
  return 1e3 * length.value;
}

double oil_class(const DesignEntry& entry, const StudyValue& written) {
  constexpr std::string_view name = "ISO VG ";
  if (const std::string* text = written.string(); text && text->starts_with(name))
    for (const double middle : model::iso_viscosity_grades)
      if (fmt::format("{}{:.0f}", name, middle) == *text) return middle;
  entry.fail("stock must have two classes of ISO 3448, such as [\"ISO VG 10\", \"ISO VG 220\"]");
}

// Stock sizes of steel balls, or classes of oil, from the first to the second.
void read_stock(const DesignEntry& entry, const StudyValue& written, const Study& study, DesignVariable& variable) {
  const bool balls = variable.key == "balancer.ball_diameter", oils = variable.key == "balancer.oil.grade";
  if (!balls && !oils) entry.fail("stock is only for \"balancer.ball_diameter\" and \"balancer.oil.grade\"");
  if (!study.scales) entry.fail("stock needs a study in physical units");
  const StudyValue::Array* ends = written.array();
  if (!ends || ends->size() != 2) entry.fail("stock must have two ends, [low, high]");
  if (oils && entry.stated("balancer.oil.viscosity_100"))
    entry.fail("needs a study without balancer.oil.viscosity_100, which is of one grade");
  const auto number = [&](const StudyValue& end) { return balls ? in_mm(entry, end) : oil_class(entry, end); };
  const double low = number((*ends)[0]) * (1.0 - rounded), high = number((*ends)[1]) * (1.0 + rounded);
  std::vector<double> numbers;
  const auto add = [&](double n) {
    if (n >= low && n <= high) numbers.push_back(n);
  };
  if (balls)
    for (const double size : model::stock_ball_diameters) add(size);
  else
    for (const double middle : model::iso_viscosity_grades) add(middle < 10.0 ? std::round(middle) : middle);
  if (numbers.size() < 2 && balls)
    entry.fail(fmt::format("leaves fewer than two stock sizes, which are from {} to {} mm; others go into choices",
                           model::stock_ball_diameters.front(), model::stock_ball_diameters.back()));
  if (balls) variable.unit = "mm";
  if (oils) variable.prefix = "ISO VG ";
  variable.logarithmic = oils;
  allow(entry, variable, numbers);
}

void read_rounding(const DesignEntry& entry, DesignVariable& variable) {
  const bool steps = entry.value().find("step"), digits = entry.value().find("digits");
  if (!steps && !digits) return;
  if (steps && digits) entry.fail("must give either step or digits");
  if (variable.whole) entry.fail("is of whole numbers anyway; step and digits are of others");
  const WrittenNumber written = entry.need(steps ? "step" : "digits", steps ? "a number" : "1, 2 or 3");
  if (written.unit != (steps ? variable.unit : ""))
    entry.fail(steps ? fmt::format("step must have the unit of the range, \"{}\"", variable.unit) : must_be_few_digits);
  allow(entry, variable,
        steps ? multiples(entry, written.value, variable.low, variable.high)
              : of_digits(entry, written.value, variable.low, variable.high));
}

// One of the unit as a dimensionless number.
double unit_worth(const DesignEntry& entry, const Study& study, Dimension dimension, const std::string& unit) {
  if (!study.scales) {
    if (!unit.empty())
      entry.fail(fmt::format("has the unit \"{}\"; must be plain numbers: this study has no units", unit));
    return 1.0;
  }
  const study::Measured one = study::measure("1 " + unit, {dimension});
  if (unit.empty() || !one.problem.empty())
    entry.fail(
        fmt::format("must be {}, such as \"{}\"", study::words(dimension).name, study::words(dimension).example));
  return one.value / study::scale_of(dimension, *study.scales);
}

// "200 rpm/s" in the units of the speeds and times.
double slope_in(const DesignEntry& entry, const Study& study, const WrittenNumber& slope, double speed, double time) {
  if (!study.scales) return slope.value;
  const std::size_t over = slope.unit.rfind('/');
  if (over == std::string::npos) entry.fail("slope must be a speed of rotation a time, such as \"200 rpm/s\"");
  return slope.value * unit_worth(entry, study, Dimension::speed, slope.unit.substr(0, over)) /
         unit_worth(entry, study, Dimension::time, slope.unit.substr(over + 1)) / (speed / time);
}

void read_spin_up(const DesignEntry& entry, const Study& study, DesignVariable& variable) {
  entry.allow_only({"points", "until", "range", "slope"});
  if (study.speed.driven()) entry.fail("needs a prescribed speed; this rotor is driven by a motor (speed.profile)");
  SpinUpShape shape;
  const double points = entry.need("points", "a whole number").value;
  if (!(points >= 1 && points <= most_spin_up_points && std::floor(points) == points))
    entry.fail(fmt::format("points must be a whole number from 1 to {}", most_spin_up_points));
  shape.points = static_cast<int>(points);
  const WrittenNumber until = entry.need("until", "a time");
  const StudyValue* range = entry.value().find("range");
  if (!range) entry.fail("lacks range, the speeds of its points");
  const auto [low, high] = entry.range(*range);
  const double speed = unit_worth(entry, study, Dimension::speed, low.unit);
  const double time = unit_worth(entry, study, Dimension::time, until.unit);
  const model::SpeedProfile profile = study.speed_profile();
  shape.until = until.value;
  shape.time_unit = until.unit;
  shape.low = low.value;
  shape.high = high.value;
  shape.initial = profile.ramp_function(0.0) / speed;
  shape.final = profile.final_speed() / speed;
  if (study.speed.profile == Profile::constant) shape.initial = 0.0;  // a constant speed is reached from rest
  if (study.speed.law != model::SpeedLaw::kinematic)
    shape.law = speed_law_names[static_cast<std::size_t>(study.speed.law)];
  if (entry.value().find("slope"))
    shape.slope = slope_in(entry, study, entry.need("slope", "a change of speed in a time"), speed, time);
  if (!(shape.until > 0.0)) entry.fail("until must be greater than 0");
  if (shape.slope && !(*shape.slope > 0.0)) entry.fail("slope must be greater than 0");
  for (const double end : {shape.initial, shape.final})
    if (!(end >= shape.low && end <= shape.high))
      entry.fail(fmt::format("range must hold the speeds that the spin-up begins and ends with, {:.6g} and {:.6g}",
                             shape.initial, shape.final));
  if (const double least = shortest_spin_up(shape); least > shape.until)
    entry.fail(fmt::format("with this slope the final speed takes {:.6g}, longer than until", least));
  variable.unit = low.unit;
  variable.low = shape.low;
  variable.high = shape.high;
  variable.spin_up = shape;
}

}  // namespace

void DesignEntry::fail(const std::string& problem) const {
  const std::string dotted = table_ + "." + key_;
  throw InputError(file_.where(table_, &value_), shown_text(dotted), file_.value_text(dotted, value_), problem);
}

void DesignEntry::allow_only(std::initializer_list<std::string_view> members) const {
  for (const auto& [name, value] : *value_.table())
    if (std::find(members.begin(), members.end(), name) == members.end())
      fail(fmt::format("has an unknown entry \"{}\"; {}", shown_text(name), forms));
}

std::optional<WrittenNumber> DesignEntry::number(const StudyValue& written) const {
  if (!written.is_number() && !written.string()) return std::nullopt;
  const WrittenNumber number{number_of(written), unit_of_value(written)};
  if (!std::isfinite(number.value) || (written.string() && number.unit.empty())) return std::nullopt;
  return number;
}

WrittenNumber DesignEntry::need(std::string_view member, const char* wanted) const {
  const StudyValue* written = value_.find(member);
  const auto found = written ? number(*written) : std::nullopt;
  if (!found) fail(fmt::format("{} must be {}", member, wanted));
  return *found;
}

std::array<WrittenNumber, 2> DesignEntry::range(const StudyValue& written) const {
  const StudyValue::Array* ends = written.array();
  if (!ends || ends->size() != 2) fail(forms);
  const auto low = number((*ends)[0]), high = number((*ends)[1]);
  if (!low || !high) fail("must have numbers, or quantities with their units, at both ends");
  if (low->unit != high->unit)
    fail(fmt::format("mixes the units \"{}\" and \"{}\"; must be one", low->unit, high->unit));
  if (!(low->value < high->value)) fail("is reversed or empty; the first end must be below the second");
  return {*low, *high};
}

DesignVariable read_variable(const DesignEntry& entry, const Study& study) {
  DesignVariable variable;
  variable.key = entry.key();
  if (!of_a_machine(variable.key))
    entry.fail(fmt::format("must be a key of {}, in quotes, such as \"balancer.mass\", or \"speed\", a spin-up",
                           fmt::join(tables, ", ")));
  for (const UncertainValue& drawn : study.uncertain.values)
    if (drawn.key == variable.key)
      entry.fail("is drawn with each start of this study; must be a plain value there to be chosen");
  const StudyValue& value = entry.value();
  if (!value.table()) {
    if (variable.key == "speed") entry.fail(forms);
    read_range(entry, value, variable);
  } else if (variable.key == "speed") {
    read_spin_up(entry, study, variable);
  } else if (const StudyValue* choices = value.find("choices")) {
    entry.allow_only({"choices"});
    read_choices(entry, *choices, variable);
  } else if (const StudyValue* stock = value.find("stock")) {
    entry.allow_only({"stock"});
    read_stock(entry, *stock, study, variable);
  } else if (const StudyValue* range = value.find("range")) {
    entry.allow_only({"range", "scale", "step", "digits"});
    read_range(entry, *range, variable);
    const StudyValue* scale = value.find("scale");
    const std::string* word = scale ? scale->string() : nullptr;
    if (scale && (!word || (*word != "log" && *word != "linear"))) entry.fail("scale must be \"log\" or \"linear\"");
    variable.logarithmic = word && *word == "log";
    if (variable.logarithmic && !(variable.low > 0.0)) entry.fail("must begin above 0 where the scale is \"log\"");
    read_rounding(entry, variable);
  } else {
    entry.fail(forms);
  }
  return variable;
}

}  // namespace equipoise

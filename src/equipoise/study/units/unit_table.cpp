// The table, and products of its units. What is not metric is exact by definition: A. Thompson and B. N. Taylor, NIST
// SP 811 (2008), appendix B [SP811].
#include "equipoise/study/units/unit_table.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

#include "equipoise/core/base/angles.hpp"

namespace equipoise::study {

namespace {

struct NamedUnit {
  std::string_view name;
  TableUnit unit;
  enum class Form {
    symbol,
    word,
    alone
  } form;  // symbol: takes the prefixes k and m; word: takes kilo, and a plural
           // s; alone: neither
};
using Form = NamedUnit::Form;

constexpr TableUnit gram{0.001, 1, 0, 0, 0}, metre{1.0, 0, 1, 0, 0}, second{1.0, 0, 0, 1, 0}, radian{1.0, 0, 0, 0, 1},
    degree{pi / 180.0, 0, 0, 0, 1}, inch{2.54 * 0.01, 0, 1, 0, 0}, foot{12.0 * (2.54 * 0.01), 0, 1, 0, 0},
    pound{0.45359237, 1, 0, 0, 0}, tonne{1000.0, 1, 0, 0, 0}, minute{60.0, 0, 0, 1, 0}, hour{3600.0, 0, 0, 1, 0},
    turn{2.0 * pi, 0, 0, 0, 1}, rpm{2.0 * pi / 60.0, 0, 0, -1, 1}, rps{2.0 * pi, 0, 0, -1, 1}, hertz{1.0, 0, 0, -1, 0},
    newton{1.0, 1, 1, -2, 0}, pascal{1.0, 1, -1, -2, 0}, joule{1.0, 1, 2, -2, 0}, watt{1.0, 1, 2, -3, 0},
    stokes{1e-4, 0, 2, -1, 0}, kilogram_force{9.80665, 1, 1, -2, 0}, pound_force{0.45359237 * 9.80665, 1, 1, -2, 0},
    ounce{0.45359237 / 16.0, 1, 0, 0, 0}, ounce_force{0.45359237 * 9.80665 / 16.0, 1, 1, -2, 0},
    litre{1e-3, 0, 3, 0, 0}, horsepower{550.0 * (0.45359237 * 9.80665) * (12.0 * (2.54 * 0.01)), 1, 2, -3, 0};

constexpr std::array<NamedUnit, 98> units{{
    {"g", gram, Form::symbol},
    {"gram", gram, Form::word},
    {"m", metre, Form::symbol},
    {"meter", metre, Form::word},
    {"metre", metre, Form::word},
    {"s", second, Form::symbol},
    {"second", second, Form::word},
    {"sec", second, Form::alone},
    {"rad", radian, Form::symbol},
    {"radian", radian, Form::word},
    {"degree", degree, Form::word},
    {"°", degree, Form::alone},
    {"in", inch, Form::alone},
    {"inch", inch, Form::alone},
    {"inches", inch, Form::alone},
    {"ft", foot, Form::alone},
    {"foot", foot, Form::alone},
    {"feet", foot, Form::alone},
    {"lb", pound, Form::alone},
    {"pound", pound, Form::word},
    {"t", tonne, Form::alone},
    {"tonne", tonne, Form::word},
    {"min", minute, Form::alone},
    {"minute", minute, Form::word},
    {"h", hour, Form::alone},
    {"hr", hour, Form::alone},
    {"hour", hour, Form::word},
    {"turn", turn, Form::word},
    {"revolution", turn, Form::word},
    {"rpm", rpm, Form::alone},
    {"rps", rps, Form::alone},
    {"Hz", hertz, Form::symbol},
    {"hertz", hertz, Form::alone},
    {"N", newton, Form::symbol},
    {"newton", newton, Form::word},
    {"Pa", pascal, Form::symbol},
    {"pascal", pascal, Form::word},
    {"J", joule, Form::symbol},
    {"joule", joule, Form::word},
    {"W", watt, Form::symbol},
    {"watt", watt, Form::word},
    {"St", stokes, Form::symbol},
    {"stokes", stokes, Form::alone},
    {"micron", {1e-6, 0, 1, 0, 0}, Form::word},
    {"bar", {1e5, 1, -1, -2, 0}, Form::symbol},
    {"kmh", {1000.0 / 3600.0, 0, 1, -1, 0}, Form::alone},
    {"kph", {1000.0 / 3600.0, 0, 1, -1, 0}, Form::alone},
    {"mph", {63360.0 * (2.54 * 0.01) / 3600.0, 0, 1, -1, 0}, Form::alone},
    {"kgf", kilogram_force, Form::alone},
    {"lbf", pound_force, Form::alone},
    {"psi", {0.45359237 * 9.80665 / ((2.54 * 0.01) * (2.54 * 0.01)), 1, -1, -2, 0}, Form::alone},
    {"poise", {0.1, 1, -1, -1, 0}, Form::word},
    {"gravity", {9.80665, 0, 1, -2, 0}, Form::alone},
    {"lbs", pound, Form::alone},
    {"oz", ounce, Form::alone},  // of mass
    {"ounce", ounce, Form::word},
    {"ozf", ounce_force, Form::alone},
    {"ounce_force", ounce_force, Form::alone},
    {"pound_force", pound_force, Form::alone},
    {"kilogram_force", kilogram_force, Form::alone},
    {"kp", kilogram_force, Form::alone},
    {"gf", {0.001 * 9.80665, 1, 1, -2, 0}, Form::alone},
    {"dyn", {1e-5, 1, 1, -2, 0}, Form::alone},
    {"dyne", {1e-5, 1, 1, -2, 0}, Form::word},
    {"erg", {1e-7, 1, 2, -2, 0}, Form::word},
    {"hp", horsepower, Form::alone},
    {"horsepower", horsepower, Form::alone},
    {"slug", {0.45359237 * 9.80665 / (12.0 * (2.54 * 0.01)), 1, 0, 0, 0}, Form::word},
    {"mil", {0.001 * (2.54 * 0.01), 0, 1, 0, 0}, Form::word},
    {"yd", {36.0 * (2.54 * 0.01), 0, 1, 0, 0}, Form::alone},
    {"yard", {36.0 * (2.54 * 0.01), 0, 1, 0, 0}, Form::word},
    {"l", litre, Form::symbol},
    {"L", litre, Form::symbol},
    {"liter", litre, Form::word},
    {"litre", litre, Form::word},
    {"d", {86400.0, 0, 0, 1, 0}, Form::alone},
    {"day", {86400.0, 0, 0, 1, 0}, Form::word},
    {"rev", turn, Form::alone},
    {"r", turn, Form::alone},
    {"rotation", turn, Form::word},
    {"cycle", turn, Form::word},
    {"P", {0.1, 1, -1, -1, 0}, Form::alone},
    {"cP", {0.1 * 1e-2, 1, -1, -1, 0}, Form::alone},
    // Products that are often written without a blank.
    {"Nm", joule, Form::symbol},
    {"Nmm", {0.001, 1, 2, -2, 0}, Form::symbol},
    {"Ns", {1.0, 1, 1, -1, 0}, Form::symbol},
    {"Nms", {1.0, 1, 2, -1, 0}, Form::symbol},
    {"Pas", {1.0, 1, -1, -1, 0}, Form::symbol},
    {"gmm", {0.001 * 0.001, 1, 1, 0, 0}, Form::symbol},
    {"gcm", {0.001 * 0.01, 1, 1, 0, 0}, Form::symbol},
    {"deg", degree, Form::alone},
    {"lbm", pound, Form::alone},
    {"RPM", rpm, Form::alone},
    {"U", turn, Form::alone},  // U/min
    {"arcmin", {pi / 180.0 / 60.0, 0, 0, 0, 1}, Form::alone},
    {"arcsec", {pi / 180.0 / 3600.0, 0, 0, 0, 1}, Form::alone},
    {"′", {pi / 180.0 / 60.0, 0, 0, 0, 1}, Form::alone},
    {"″", {pi / 180.0 / 3600.0, 0, 0, 0, 1}, Form::alone},
}};

struct Prefix {
  std::string_view symbol, word;
  double factor;
};
constexpr std::array<Prefix, 14> prefixes{{{"k", "kilo", 1e3},
                                           {"m", "milli", 1e-3},
                                           {"c", "centi", 1e-2},
                                           {"d", "deci", 1e-1},
                                           {"u", "micro", 1e-6},
                                           {"µ", "micro", 1e-6},
                                           {"μ", "micro", 1e-6},
                                           {"n", "nano", 1e-9},
                                           {"M", "mega", 1e6},
                                           {"G", "giga", 1e9},
                                           {"h", "hecto", 1e2},
                                           {"da", "deca", 1e1},
                                           {"p", "pico", 1e-12},
                                           {"T", "tera", 1e12}}};

std::optional<TableUnit> named(std::string_view name) {
  for (const NamedUnit& u : units) {
    if (u.name == name) return u.unit;
    if (u.form == Form::word && name.size() == u.name.size() + 1 && name.ends_with('s') && name.starts_with(u.name))
      return u.unit;
  }
  return std::nullopt;
}

bool takes(std::string_view name, Form form) {
  for (const NamedUnit& u : units)
    if (u.form == form && (u.name == name || (form == Form::word && name.ends_with('s') && name.starts_with(u.name))))
      return true;
  return false;
}

std::optional<TableUnit> with_prefix(std::string_view name) {
  for (const Prefix& p : prefixes)
    for (const auto& [before, form] : {std::pair{p.word, Form::word}, std::pair{p.symbol, Form::symbol}}) {
      if (!name.starts_with(before) || !takes(name.substr(before.size()), form)) continue;
      std::optional<TableUnit> unit = named(name.substr(before.size()));
      if (!unit) continue;
      unit->si *= p.factor;
      return unit;
    }
  return std::nullopt;
}

TableUnit product(const TableUnit& a, const TableUnit& b) {
  return {a.si * b.si, a.kilogram + b.kilogram, a.metre + b.metre, a.second + b.second, a.radian + b.radian};
}

TableUnit power(const TableUnit& a, int n) {
  return {std::pow(a.si, n), n * a.kilogram, n * a.metre, n * a.second, n * a.radian};
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// The text must follow the grammar of UnitText.
class ProductReader {
 public:
  explicit ProductReader(std::string_view text) : text_(text) {}

  std::optional<TableUnit> read() {
    TableUnit result;
    for (bool divides = false;;) {
      const std::optional<TableUnit> next = factor();
      if (!next) return std::nullopt;
      result = product(result, divides ? power(*next, -1) : *next);
      divides = false;
      while (!over() && std::string_view(" .*-/").find(text_[at_]) != std::string_view::npos)
        divides = text_[at_++] == '/' || divides;
      if (over() || text_[at_] == ')') return result;
    }
  }

 private:
  bool over() const { return at_ == text_.size(); }

  std::optional<TableUnit> factor() {
    if (over()) return std::nullopt;
    std::optional<TableUnit> unit;
    if (text_[at_] == '(') {
      ++at_;
      unit = read();
      if (!unit || over()) return std::nullopt;
      ++at_;
    } else if (is_digit(text_[at_])) {
      double number = 0.0;
      for (; !over() && is_digit(text_[at_]); ++at_) number = 10.0 * number + (text_[at_] - '0');
      return TableUnit{number};
    } else {
      const std::size_t begin = at_;
      while (!over() && !is_digit(text_[at_]) &&
             std::string_view("^ .*-/()").find(text_[at_]) == std::string_view::npos)
        ++at_;
      const std::string_view name = text_.substr(begin, at_ - begin);
      unit = named(name);
      if (!unit) unit = with_prefix(name);
      if (!unit) return std::nullopt;
    }
    return raised(*unit);
  }

  TableUnit raised(const TableUnit& unit) {
    std::size_t at = at_ + (!over() && text_[at_] == '^');
    const bool minus = at + 1 < text_.size() && text_[at] == '-' && is_digit(text_[at + 1]);
    at += minus;
    if (at >= text_.size() || !is_digit(text_[at])) return unit;
    const int n = text_[at] - '0';
    at_ = at + 1;
    return power(unit, minus ? -n : n);
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

std::optional<TableUnit> table_unit(const std::string& text) { return ProductReader(text).read(); }

double TableUnit::worth_in(const TableUnit& other) const {
  const double one = si / other.si;
  return same_kind(other) && one > 0.0 && std::isfinite(one) ? one : 0.0;
}

}  // namespace equipoise::study

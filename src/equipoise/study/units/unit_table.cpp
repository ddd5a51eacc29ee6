// The table, its products and their typographic spellings. What is not metric is exact by definition: A. Thompson and
// B. N. Taylor, NIST SP 811 (2008), appendix B [SP811].
#include "equipoise/study/units/unit_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/display_text.hpp"

namespace equipoise::study {

namespace {

// Names are between blanks. Symbols take the prefixes k and m, words kilo and a plural s, the others neither.
struct NamedUnit {
  TableUnit unit;
  std::string_view symbols, words{}, others{};
};

constexpr double an_inch = 2.54 * 0.01, a_foot = 12.0 * an_inch, a_pound = 0.45359237, g_0 = 9.80665;

constexpr auto units = std::to_array<NamedUnit>({
    {{0.001, 1}, "g", "gram"},
    {{1.0, 0, 1}, "m", "meter metre"},
    {{1.0, 0, 0, 1}, "s", "second", "sec"},
    {{1.0, 0, 0, 0, 1}, "rad", "radian"},
    {{pi / 180.0, 0, 0, 0, 1}, "", "degree", "deg °"},
    {{an_inch, 0, 1}, "", "", "in inch inches"},
    {{a_foot, 0, 1}, "", "", "ft foot feet"},
    {{a_pound, 1}, "", "pound", "lb lbs lbm"},
    {{1000.0, 1}, "", "tonne", "t"},
    {{60.0, 0, 0, 1}, "", "minute", "min"},
    {{3600.0, 0, 0, 1}, "", "hour", "h hr"},
    {{2.0 * pi, 0, 0, 0, 1}, "", "turn revolution rotation cycle", "rev r U"},  // U/min
    {{2.0 * pi / 60.0, 0, 0, -1, 1}, "", "", "rpm RPM"},
    {{2.0 * pi, 0, 0, -1, 1}, "", "", "rps"},
    {{1.0, 0, 0, -1}, "Hz", "", "hertz"},
    {{1.0, 1, 1, -2}, "N", "newton"},
    {{1.0, 1, -1, -2}, "Pa", "pascal"},
    {{1.0, 1, 2, -2}, "J Nm", "joule"},
    {{1.0, 1, 2, -3}, "W", "watt"},
    {{1e-4, 0, 2, -1}, "St", "", "stokes"},
    {{1e-6, 0, 1}, "", "micron"},
    {{1e5, 1, -1, -2}, "bar"},
    {{1000.0 / 3600.0, 0, 1, -1}, "", "", "kmh kph"},
    {{63360.0 * an_inch / 3600.0, 0, 1, -1}, "", "", "mph"},
    {{g_0, 1, 1, -2}, "", "", "kgf kp kilogram_force"},
    {{a_pound * g_0, 1, 1, -2}, "", "", "lbf pound_force"},
    {{a_pound * g_0 / (an_inch * an_inch), 1, -1, -2}, "", "", "psi"},
    {{0.1, 1, -1, -1}, "", "poise", "P"},
    {{0.1 * 1e-2, 1, -1, -1}, "", "", "cP"},
    {{g_0, 0, 1, -2}, "", "", "gravity"},
    {{a_pound / 16.0, 1}, "", "ounce", "oz"},  // of mass
    {{a_pound * g_0 / 16.0, 1, 1, -2}, "", "", "ozf ounce_force"},
    {{0.001 * g_0, 1, 1, -2}, "", "", "gf"},
    {{1e-5, 1, 1, -2}, "", "dyne", "dyn"},
    {{1e-7, 1, 2, -2}, "", "erg"},
    {{550.0 * (a_pound * g_0) * a_foot, 1, 2, -3}, "", "", "hp horsepower"},
    {{a_pound * g_0 / a_foot, 1}, "", "slug"},
    {{0.001 * an_inch, 0, 1}, "", "mil"},
    {{36.0 * an_inch, 0, 1}, "", "yard", "yd"},
    {{1e-3, 0, 3}, "l L", "liter litre"},
    {{86400.0, 0, 0, 1}, "", "day", "d"},
    {{pi / 180.0 / 60.0, 0, 0, 0, 1}, "", "", "arcmin ′"},
    {{pi / 180.0 / 3600.0, 0, 0, 0, 1}, "", "", "arcsec ″"},
    // Products that are often written without a blank.
    {{0.001, 1, 2, -2}, "Nmm"},
    {{1.0, 1, 1, -1}, "Ns"},
    {{1.0, 1, 2, -1}, "Nms"},
    {{1.0, 1, -1, -1}, "Pas"},
    {{0.001 * 0.001, 1, 1}, "gmm"},
    {{0.001 * 0.01, 1, 1}, "gcm"},
});

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

using Names = std::string_view NamedUnit::*;
struct Found {
  const TableUnit* unit = nullptr;
  Names among{};
};
using UnitsByName = std::map<std::string_view, Found>;

UnitsByName by_name() {
  UnitsByName all;
  for (const NamedUnit& unit : units)
    for (const Names among : {&NamedUnit::symbols, &NamedUnit::words, &NamedUnit::others})
      for (std::string_view rest = unit.*among; !rest.empty();) {
        const std::string_view name = rest.substr(0, rest.find(' '));
        all.emplace(name, Found{&unit.unit, among});
        rest.remove_prefix(std::min(name.size() + 1, rest.size()));
      }
  return all;
}

Found find_unit(std::string_view name) {
  static const UnitsByName all = by_name();
  if (const auto found = all.find(name); found != all.end()) return found->second;
  const auto one = name.ends_with('s') ? all.find(name.substr(0, name.size() - 1)) : all.end();
  return one != all.end() && one->second.among == &NamedUnit::words ? one->second : Found{};
}

std::optional<TableUnit> named(std::string_view name) {
  if (const Found found = find_unit(name); found.unit) return *found.unit;
  for (const Prefix& p : prefixes)
    for (const auto& [before, names] :
         {std::pair{p.word, &NamedUnit::words}, std::pair{p.symbol, &NamedUnit::symbols}}) {
      const Found found = name.starts_with(before) ? find_unit(name.substr(before.size())) : Found{};
      if (!found.unit || found.among != names) continue;
      TableUnit unit = *found.unit;
      unit.si *= p.factor;
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

// Characters, and the plain sign of each. The latter: the middle dot and the dot operator; no-break, narrow no-break
// and thin spaces.
struct Signs {
  std::string_view characters, plain;
};
constexpr Signs raised{"⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-"}, dots_and_spaces{"\u00B7\u22C5\u00A0\u202F\u2009", "..   "};

char meaning(const Signs& signs, std::string_view character) {
  std::size_t k = 0;
  for (std::size_t at = 0; at < signs.characters.size(); at += character_length(signs.characters, at), ++k)
    if (signs.characters.substr(at).starts_with(character)) return signs.plain[k];
  return 0;
}

std::string in_plain_signs(std::string_view text) {
  std::string plain;
  bool in_power = false;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = std::max<std::size_t>(1, character_length(text, at));
    const std::string_view character = text.substr(at, length);
    at += length;
    const bool ascii = length == 1;
    const char power = ascii ? 0 : meaning(raised, character), sign = ascii ? 0 : meaning(dots_and_spaces, character);
    if (power && !in_power) plain += '^';
    in_power = power != 0;
    if (power || sign)
      plain += power ? power : sign;
    else
      plain += character;
  }
  return std::string(trimmed(plain));
}

// Reads the text of `into`. Its functions return nothing if the text has another form. Unknown units count as 1.
class UnitReader {
 public:
  explicit UnitReader(UnitText& into) : into_(into), text_(into.text) {}

  void read() {
    constexpr std::size_t longest = 60;
    const auto unit = text_.size() <= longest ? product(0) : std::nullopt;
    into_.is_product = unit && over();
    if (into_.is_product && known_) into_.unit = unit;
  }

 private:
  using Unit = std::optional<TableUnit>;

  Unit product(int depth) {
    TableUnit result;
    for (bool divides = false;;) {
      const Unit next = factor(depth);
      if (!next) return {};
      result = study::product(result, divides ? power(*next, -1) : *next);
      const std::size_t end = at_;
      skip_blanks();
      if (over() || text_[at_] == ')') return result;
      divides = text_[at_] == '/';
      if (take("./*-"))
        skip_blanks();
      else if (at_ == end)
        return {};
    }
  }

  Unit factor(int depth) {
    Unit unit;
    if (take("(")) {
      unit = depth == 0 ? product(1) : std::nullopt;
      if (!unit || !take(")")) return {};
    } else if (digit()) {
      double number = 0.0;
      for (int count = 0; digit(); ++at_) {
        if (++count > 6) return {};
        number = 10.0 * number + (text_[at_] - '0');
      }
      return TableUnit{number};
    } else if (!(unit = name())) {
      return {};
    }
    const bool caret = take("^");
    const bool minus = at_ + 1 < text_.size() && text_[at_] == '-' && is_digit(text_[at_ + 1]);
    at_ += minus;
    if (!digit()) return caret ? std::nullopt : unit;
    const int n = text_[at_++] - '0';
    return digit() ? std::nullopt : Unit(power(*unit, minus ? -n : n));
  }

  Unit name() {
    const std::size_t begin = at_;
    while (const std::size_t length = letter()) at_ += length;
    const std::string_view word = text_.substr(begin, at_ - begin);
    if (word.empty() && !take("%")) return {};
    constexpr std::array<std::string_view, 5> grammar{"per", "after", "from", "since", "ref"};
    const auto same = [](char a, char b) { return (a | 0x20) == b; };
    for (const std::string_view other : grammar)
      if (std::equal(word.begin(), word.end(), other.begin(), other.end(), same)) return {};
    const Unit unit = named(word);
    into_.names += !word.empty();
    if (!unit && into_.unknown.empty()) into_.unknown = word;
    known_ = known_ && unit;
    return unit.value_or(TableUnit{});
  }

  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
  // Bytes of the letter here; 0 if there is none. Everything beyond ASCII counts as a letter: units have µ and °.
  std::size_t letter() const {
    const std::size_t length = at_ < text_.size() ? character_length(text_, at_) : 0;
    const char c = length == 1 ? text_[at_] : 'a';
    return c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ? length : 0;
  }
  bool over() const { return at_ == text_.size(); }
  bool digit() const { return !over() && is_digit(text_[at_]); }
  bool take(std::string_view any_of) {
    const bool there = !over() && any_of.find(text_[at_]) != std::string_view::npos;
    at_ += there;
    return there;
  }
  void skip_blanks() {
    while (!over() && text_[at_] == ' ') ++at_;
  }

  UnitText& into_;
  const std::string_view text_;
  std::size_t at_ = 0;
  bool known_ = true;
};

}  // namespace

UnitText::UnitText(std::string_view given) : text(in_plain_signs(given)) { UnitReader(*this).read(); }

double TableUnit::worth_in(const TableUnit& other) const {
  const double one = si / other.si;
  return same_kind(other) && one > 0.0 && std::isfinite(one) ? one : 0.0;
}

}  // namespace equipoise::study

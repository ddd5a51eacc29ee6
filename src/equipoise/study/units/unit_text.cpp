// The grammar of units, and its typographic spellings.
#include "equipoise/study/units/unit_text.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "equipoise/core/base/display_text.hpp"

namespace equipoise::study {

namespace {

constexpr std::array<std::pair<std::string_view, char>, 11> raised{{{"⁰", '0'},
                                                                    {"¹", '1'},
                                                                    {"²", '2'},
                                                                    {"³", '3'},
                                                                    {"⁴", '4'},
                                                                    {"⁵", '5'},
                                                                    {"⁶", '6'},
                                                                    {"⁷", '7'},
                                                                    {"⁸", '8'},
                                                                    {"⁹", '9'},
                                                                    {"⁻", '-'}}};
// The middle dot and the dot operator; no-break, narrow no-break and thin spaces.
constexpr std::array<std::pair<std::string_view, char>, 5> signs{
    {{"\u00B7", '.'}, {"\u22C5", '.'}, {"\u00A0", ' '}, {"\u202F", ' '}, {"\u2009", ' '}}};

template <class Table>
char meaning(const Table& table, std::string_view character) {
  const auto at = std::find_if(table.begin(), table.end(), [&](const auto& entry) { return entry.first == character; });
  return at == table.end() ? 0 : at->second;
}

std::string in_plain_signs(std::string_view text) {
  std::string plain;
  bool in_power = false;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = std::max<std::size_t>(1, character_length(text, at));
    const std::string_view character = text.substr(at, length);
    at += length;
    const char power = meaning(raised, character), sign = meaning(signs, character);
    if (power && !in_power) plain += '^';
    in_power = power != 0;
    if (power || sign)
      plain += power ? power : sign;
    else
      plain += character;
  }
  plain.erase(0, plain.find_first_not_of(' '));
  plain.erase(plain.find_last_not_of(' ') + 1);
  return plain;
}

class UnitGrammar {
 public:
  explicit UnitGrammar(std::string_view text) : text_(text) {}

  bool holds() {
    constexpr std::size_t longest = 60;
    return text_.size() <= longest && product(0) && at_ == text_.size();
  }
  const std::vector<std::string>& names() const { return names_; }

 private:
  bool product(int depth) {
    for (;;) {
      if (!power(depth)) return false;
      const std::size_t end = at_;
      skip_blanks();
      if (at_ == text_.size() || text_[at_] == ')') return true;
      if (take("./*-"))
        skip_blanks();
      else if (at_ == end)
        return false;
    }
  }

  bool power(int depth) {
    if (at_ == text_.size()) return false;
    if (take("(")) {
      if (depth > 0 || !product(depth + 1) || !take(")")) return false;
    } else if (digit()) {
      for (int count = 0; digit(); ++at_)
        if (++count > 6) return false;
      return true;
    } else if (!name()) {
      return false;
    }
    const bool caret = take("^");
    at_ += at_ + 1 < text_.size() && text_[at_] == '-' && is_digit(text_[at_ + 1]);
    if (!digit()) return !caret;
    ++at_;
    return !digit();
  }

  bool name() {
    const std::size_t begin = at_;
    while (const std::size_t length = letter()) at_ += length;
    if (at_ == begin) return take("%");
    std::string word(text_.substr(begin, at_ - begin));
    names_.push_back(word);
    for (char& c : word) c = static_cast<char>(c | 0x20);
    constexpr std::array<std::string_view, 5> grammar{"per", "after", "from", "since", "ref"};
    return std::find(grammar.begin(), grammar.end(), word) == grammar.end();
  }

  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
  // Bytes of the letter here; 0 if there is none. Everything beyond ASCII counts as a letter: units have µ and °.
  std::size_t letter() const {
    const std::size_t length = at_ < text_.size() ? character_length(text_, at_) : 0;
    const char c = length == 1 ? text_[at_] : 'a';
    return c == '_' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ? length : 0;
  }
  bool digit() const { return at_ < text_.size() && is_digit(text_[at_]); }
  bool take(std::string_view any_of) {
    const bool there = at_ < text_.size() && any_of.find(text_[at_]) != std::string_view::npos;
    at_ += there;
    return there;
  }
  void skip_blanks() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<std::string> names_;
};

}  // namespace

UnitText::UnitText(std::string_view given) : text(in_plain_signs(given)) {
  const std::string plain = text;
  UnitGrammar grammar(plain);
  is_product = grammar.holds();
  if (!is_product) return;
  names = grammar.names();
}

}  // namespace equipoise::study

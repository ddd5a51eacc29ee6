// Uses std::from_chars() where it reads doubles, else the C library on a copy of the number's text, in the locale "C".
#include "equipoise/core/base/read_number.hpp"

#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <version>

#include <locale.h>
#ifdef __APPLE__
#include <xlocale.h>
#endif

namespace equipoise {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

const char* digits(const char* at, const char* end) {
  while (at < end && is_digit(*at)) ++at;
  return at;
}

// "inf", "infinity", "nan", "nan(word)", in upper or lower case.
const char* word(const char* at, const char* end) {
  const auto starts = [&](const char* letters) {
    const char* here = at;
    for (; *letters; ++letters, ++here)
      if (here == end || (*here | 0x20) != *letters) return false;
    return true;
  };
  if (starts("infinity")) return at + 8;
  if (starts("inf")) return at + 3;
  if (!starts("nan")) return at;
  const char* close = at + 3;
  if (close == end || *close != '(') return at + 3;
  for (++close;
       close < end && (is_digit(*close) || *close == '_' || ((*close | 0x20) >= 'a' && (*close | 0x20) <= 'z'));)
    ++close;
  return close < end && *close == ')' ? close + 1 : at + 3;
}

// End of the number that begins at `begin`; `begin` if there is none.
const char* number_end(const char* begin, const char* end) {
  const char* first = begin < end && *begin == '-' ? begin + 1 : begin;
  const char* at = digits(first, end);
  std::ptrdiff_t count = at - first;
  if (at < end && *at == '.') {
    const char* after = digits(at + 1, end);
    count += after - at - 1;
    if (count > 0) at = after;
  }
  if (count == 0) {
    const char* after = word(first, end);
    return after == first ? begin : after;
  }
  if (at < end && (*at | 0x20) == 'e') {
    const char* power = at + 1;
    if (power < end && (*power == '-' || *power == '+')) ++power;
    const char* after = digits(power, end);
    if (after > power) at = after;
  }
  return at;
}

}  // namespace

NumberRead read_number_by_c(const char* begin, const char* end, double& value) {
  const char* last = number_end(begin, end);
  if (last == begin) return {begin, std::errc::invalid_argument};
  const std::string text(begin, last);
  const int before = errno;
  errno = 0;
  static const locale_t plain = newlocale(LC_ALL_MASK, "C", static_cast<locale_t>(nullptr));
  const double read = strtod_l(text.c_str(), nullptr, plain);
  const bool out_of_range = errno == ERANGE && (read == 0.0 || read > 1e300 || read < -1e300);
  errno = before;
  if (out_of_range) return {last, std::errc::result_out_of_range};
  value = read;
  return {last, std::errc()};
}

NumberRead read_number(const char* begin, const char* end, double& value) {
#ifdef __cpp_lib_to_chars
  const auto [after, error] = std::from_chars(begin, end, value);
  return {after, error};
#else
  return read_number_by_c(begin, end, value);
#endif
}

std::optional<double> number_of_all(std::string_view text) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  const NumberRead read = read_number(text.data(), end, value);
  return read.error == std::errc() && read.end == end ? std::optional(value) : std::nullopt;
}

double number_in(const std::string& text) {
  double value = 0.0;
  (void)read_number(text.data(), text.data() + text.size(), value);  // an error leaves 0
  return value;
}

}  // namespace equipoise

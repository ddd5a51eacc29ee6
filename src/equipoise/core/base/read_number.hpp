// Reads a double from text, also where the standard library cannot.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace equipoise {

struct NumberRead {
  const char* end;  ///< first character after the number; where reading began if there is none
  std::errc error;  ///< invalid_argument: no number; result_out_of_range: too large or too small for a double
};

/// The one way in which this program reads a number from text: that of a locale plays no part.
///
/// Like std::from_chars() for a double in general form: digits, point and exponent, "inf" or "nan", without leading
/// blank or plus sign, rounded to nearest. An error leaves `value` unchanged.
NumberRead read_number(const char* begin, const char* end, double& value);

/// The number that all of `text` is; none if it is no number, or too large or too small for a double.
std::optional<double> number_of_all(std::string_view text);

/// The number that `text` begins with; 0 if it begins with none. For texts that this program wrote or has checked.
double number_in(const std::string& text);

/// Like read_number() with the C library, for standard libraries whose std::from_chars() reads no doubles.
NumberRead read_number_by_c(const char* begin, const char* end, double& value);

}  // namespace equipoise

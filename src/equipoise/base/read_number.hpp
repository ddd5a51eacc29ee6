// A number from its digits, where a standard library reads none.
#pragma once

#include <system_error>

namespace equipoise {

struct NumberRead {
  const char* end;  ///< first character that is no part of it; where reading began if there is none
  std::errc error;  ///< invalid_argument: none; result_out_of_range: too large or too small for a double
};

/// std::from_chars() of a double in general form: digits, point and exponent, "inf" or "nan", with no blank nor plus
/// sign before; rounded to nearest. `value` is left as it is where there is an error.
NumberRead read_number(const char* begin, const char* end, double& value);

/// The same by the C library, for standard libraries without std::from_chars() of a double.
NumberRead read_number_by_c(const char* begin, const char* end, double& value);

}  // namespace equipoise

// The ending of a counted noun.
#pragma once

namespace equipoise {

/// "" after one, "s" after any other number: "1 cell", "0 cells".
template <class Number>
constexpr const char* plural(Number count) {
  return count == 1 ? "" : "s";
}

}  // namespace equipoise

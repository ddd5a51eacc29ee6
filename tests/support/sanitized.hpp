// Sizes of tests that sanitizers would make last for hours: instrumented kernels run at a tenth of the speed.
#pragma once

namespace equipoise {

#ifdef EQUIPOISE_SANITIZE
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

/// `usual`, or `fewer` under sanitizers: the same code is run, what is counted is counted from fewer.
template <class T>
constexpr T sized(T usual, T fewer) {
  return sanitized ? fewer : usual;
}

}  // namespace equipoise

// Sizes of tests that would take hours under sanitizers, where kernels run at a tenth of the speed.
#pragma once

namespace equipoise {

#ifdef EQUIPOISE_SANITIZE
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

/// `usual`, or `fewer` under sanitizers: the same code runs, with fewer repetitions.
template <class T>
constexpr T sized(T usual, T fewer) {
  return sanitized ? fewer : usual;
}

}  // namespace equipoise

// What the printed tables show, as contrasts between two ensembles each, to be tested under either speed law.
#pragma once

#include <string>
#include <vector>

namespace equipoise {

/// The balanced share of `second` compared with that of `first`; names of studies in studies/paper.
struct Contrast {
  std::string first, second;
};

/// One conclusion that a reader draws from the printed numbers.
struct Conclusion {
  enum class Kind {
    rises,      ///< every second share is larger than its first
    unchanged,  ///< every pair differs by less than `margin`
  };
  std::string text;
  int table = 0;
  Kind kind = Kind::rises;
  std::vector<Contrast> contrasts;
};

/// Differences below one percentage point do not matter to anyone who chooses a spin-up.
inline constexpr double unchanged_margin = 0.01;

const std::vector<Conclusion>& conclusions();

}  // namespace equipoise

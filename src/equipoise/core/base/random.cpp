// The counter-based generator, and numbers made from its words.
#include "equipoise/core/base/random.hpp"

#include <cmath>

#include <Random123/philox.h>

#include "equipoise/core/base/angles.hpp"

namespace equipoise {

RandomWords random_words(const std::array<std::uint64_t, 2>& key, const RandomWords& counter) {
  const r123::Philox4x64::key_type k = {{key[0], key[1]}};
  const r123::Philox4x64::ctr_type c = {{counter[0], counter[1], counter[2], counter[3]}};
  const auto words = r123::Philox4x64()(c, k);
  return {words[0], words[1], words[2], words[3]};
}

double RandomStream::uniform() {
  if (used_ == words_.size()) {
    words_ = random_words({seed_, 1}, {blocks_++, 0, 0, 0});
    used_ = 0;
  }
  return fraction(words_[used_++]);
}

// G. E. P. Box, M. E. Muller, Ann. Math. Statist. 29 (1958) 610. 1 - u lies in (0, 1]: its logarithm is finite.
double RandomStream::normal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return radius * std::cos(two_pi * uniform());
}

}  // namespace equipoise

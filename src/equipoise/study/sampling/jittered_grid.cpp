// A jittered grid: cells by rank in shuffled order, and jitter within a cell.
#include "equipoise/study/sampling/sampling.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/random.hpp"
#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/study/sampling/starts.hpp"

namespace equipoise {

namespace {

// Ways to choose k of n. Above `limit` any larger number is returned, so that nothing overflows.
std::uint64_t choose(std::uint64_t n, int k, std::uint64_t limit) {
  if (n < static_cast<std::uint64_t>(k)) return 0;
  const std::uint64_t fewer = std::min(static_cast<std::uint64_t>(k), n - static_cast<std::uint64_t>(k));
  std::uint64_t ways = 1;
  for (std::uint64_t j = 1; j <= fewer && ways <= limit; ++j)  // up to n/2 the count grows with j
    ways = ways * (n - j + 1) / j;                             // exact: j! divides the product of j consecutive numbers
  return ways;
}

std::uint64_t count_cells(std::uint64_t side, int balls, bool exchange, std::uint64_t limit) {
  const std::uint64_t n = static_cast<std::uint64_t>(balls);
  if (exchange) return choose(side + n - 1, balls, limit);
  std::uint64_t cells = 1;
  for (int i = 0; i < balls && cells <= limit; ++i) cells *= side;
  return cells;
}

// The position of `place` < count in an order that depends on the seed: a Feistel network over the next power of four,
// repeated until its output is below `count` (M. Luby, C. Rackoff, SIAM J. Comput. 17 (1988) 373, require four rounds).
std::uint64_t shuffled(std::uint64_t seed, std::uint64_t place, std::uint64_t count) {
  const int half = std::max(1, (static_cast<int>(std::bit_width(count - 1)) + 1) / 2);
  const std::uint64_t mask = (std::uint64_t{1} << half) - 1;
  do {
    std::uint64_t left = place >> half, right = place & mask;
    for (std::uint64_t round = 0; round < 6; ++round) {
      const auto purpose = static_cast<std::uint64_t>(StartNumbers::cell_order);
      const std::uint64_t mixed = left ^ (random_words({seed, 0}, {right, round, purpose, 0})[0] & mask);
      left = right;
      right = mixed;
    }
    place = left << half | right;
  } while (place >= count);
  return place;
}

// The last number from `begin` - 1 to `end` - 1 for which `holds`; it holds for the first ones.
template <class Holds>
std::uint64_t last_of(std::uint64_t begin, std::uint64_t end, const Holds& holds) {
  while (begin < end) {  // by hand: the browser's library lacks std::ranges
    const std::uint64_t middle = begin + (end - begin) / 2;
    if (holds(middle))
      begin = middle + 1;
    else
      end = middle;
  }
  return begin - 1;
}

}  // namespace

JitteredGrid::JitteredGrid(int balls, bool exchange, std::uint64_t starts) : balls_(balls), exchange_(exchange) {
  const std::uint64_t limit = starts / 2;
  const auto fits = [&](std::uint64_t side) { return count_cells(side, balls, exchange, limit) <= limit; };
  std::uint64_t above = 2;
  while (fits(above)) above *= 2;
  side_ = last_of(2, above, fits);
  cells_ = count_cells(side_, balls, exchange, limit);
}

double JitteredGrid::all_cells() const { return std::pow(static_cast<double>(side_), balls_); }

// Without exchange the coordinates are the digits of the rank. With exchange d_k = c_k + k increases strictly, and the
// rank is the sum of C(d_k, k + 1): the combinatorial number system.
void JitteredGrid::cell(std::uint64_t seed, std::uint64_t index, std::uint64_t* coordinates) const {
  std::uint64_t rank = shuffled(seed, index / 2, cells_);
  if (!exchange_) {
    for (int i = 0; i < balls_; ++i, rank /= side_) coordinates[i] = rank % side_;
    return;
  }
  for (int k = balls_ - 1; k >= 0; --k) {
    const std::uint64_t shift = static_cast<std::uint64_t>(k);
    coordinates[k] = last_of(1, side_, [&](std::uint64_t c) { return choose(c + shift, k + 1, rank) <= rank; });
    rank -= choose(coordinates[k] + shift, k + 1, cells_);
  }
}

void JitteredGrid::angles(std::uint64_t seed, std::uint64_t index, double* phi) const {
  std::uint64_t c[model::max_balls];
  cell(seed, index, c);
  start_angles(seed, index, balls_, phi);
  for (int i = 0; i < balls_; ++i) phi[i] = (static_cast<double>(c[i]) * two_pi + phi[i]) / static_cast<double>(side_);
}

double JitteredGrid::weight(std::uint64_t seed, std::uint64_t index) const {
  if (!exchange_) return 1.0;
  std::uint64_t c[model::max_balls];
  cell(seed, index, c);
  double orders = 1.0;  // n! over the product of the factorials of each coordinate's multiplicity
  for (int i = 0, same = 1; i < balls_; ++i) {
    same = i > 0 && c[i] == c[i - 1] ? same + 1 : 1;
    orders *= static_cast<double>(i + 1) / static_cast<double>(same);
  }
  return std::round(orders);
}

}  // namespace equipoise

// In a given order of balls, a row of touching balls cancels the most. The least is found by descent: each group of
// neighbours in turn moves to where the sum is smallest.
#include "equipoise/machine/balance/cancelling.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numeric>
#include <utility>

#include "equipoise/core/base/angles.hpp"

namespace equipoise::model {

namespace {

// All of eight balls. One costs up to a millisecond.
constexpr double most_orders_tried = 5040.0;

// Masses and widths in the order of the balls round the race.
struct Ring {
  std::vector<double> mass, width;

  int size() const { return static_cast<int>(mass.size()); }
  // Of ball i and the next, when touching.
  double apart(int i) const { return 0.5 * (width[i] + width[(i + 1) % size()]); }
  double spare() const { return two_pi - std::accumulate(width.begin(), width.end(), 0.0); }
};

// Angles of a row of touching balls that begins with `first`.
std::vector<double> row(const Ring& ring, int first) {
  const int n = ring.size();
  std::vector<double> phi(n);
  for (int k = 1; k < n; ++k) phi[(first + k) % n] = phi[(first + k - 1) % n] + ring.apart((first + k - 1) % n);
  return phi;
}

std::complex<double> sum(const Ring& ring, const std::vector<double>& phi) {
  std::complex<double> result;
  for (int i = 0; i < ring.size(); ++i) result += std::polar(ring.mass[i], phi[i]);
  return result;
}

double most_of(const Ring& ring) {
  double most = 0.0;
  for (int first = 0; first < ring.size(); ++first) most = std::max(most, std::abs(sum(ring, row(ring, first))));
  return most;
}

// Descent to the least sum for one order of the balls.
class Turning {
 public:
  Turning(const Ring& ring, std::vector<double> phi) : ring_(ring), phi_(std::move(phi)) {
    for (int i = 0; i < ring_.size(); ++i) arms_.push_back(std::polar(ring_.mass[i], phi_[i]));
  }

  // If no group can lower the sum, no move can: every move of touching balls consists of turns of groups.
  double least(double nothing) {
    constexpr int most_rounds = 200;
    for (int round = 0; round < most_rounds; ++round) {
      sum_ = std::accumulate(arms_.begin(), arms_.end(), std::complex<double>());
      const double before = std::abs(sum_);
      for (int first = 0; first < ring_.size(); ++first) {
        std::complex<double> group;
        for (int count = 1; count < ring_.size(); ++count) {
          group += arms_[(first + count - 1) % ring_.size()];
          group *= turn(first, count, group);
        }
      }
      if (std::abs(sum_) <= nothing || std::abs(sum_) > before * (1.0 - 1e-6)) break;
    }
    return std::abs(sum_);
  }

 private:
  // Free angle between ball i and the next. Angles grow along the ring and wrap after its last ball.
  double gap(int i) const {
    return std::max(0.0, wrapped_positive(phi_[(i + 1) % ring_.size()] - phi_[i]) - ring_.apart(i));
  }

  // Turns `count` balls from `first` on, with arms summing to `group`, within their gaps to the least total; returns
  // the turn.
  std::complex<double> turn(int first, int count, std::complex<double> group) {
    const int n = ring_.size();
    const std::complex<double> others = sum_ - group;
    if (group == 0.0 || others == 0.0) return 1.0;
    const double back = gap((first + n - 1) % n), ahead = gap((first + count - 1) % n);
    const double opposite = std::arg(-others / group);
    double best = std::abs(sum_), by = 0.0;
    for (const double way : {opposite, opposite - two_pi, opposite + two_pi, -back, ahead}) {
      if (way < -back || way > ahead) continue;
      const double made = std::abs(others + group * std::polar(1.0, way));
      if (made >= best) continue;
      best = made;
      by = way;
    }
    if (by == 0.0) return 1.0;
    const std::complex<double> turned = std::polar(1.0, by);
    for (int k = 0; k < count; ++k) {
      phi_[(first + k) % n] += by;
      arms_[(first + k) % n] *= turned;
    }
    sum_ = others + group * turned;
    return turned;
  }

  const Ring& ring_;
  std::vector<double> phi_;
  std::vector<std::complex<double>> arms_;
  std::complex<double> sum_;
};

// Starts from even gaps. If the balls fill more than half the race, also from rows, where the sum may have a minimum.
double least_of(const Ring& ring, double nothing) {
  const int n = ring.size();
  std::vector<double> even(static_cast<std::size_t>(n));
  for (int i = 1; i < n; ++i) even[i] = even[i - 1] + ring.apart(i - 1) + ring.spare() / n;
  double least = Turning(ring, even).least(nothing);
  for (int first = 0; first < n && least > nothing && ring.spare() < pi; ++first)
    least = std::min(least, Turning(ring, row(ring, first)).least(nothing));
  return least > nothing ? least : 0.0;
}

// Of each ball, the first that is the same.
std::vector<int> kinds(const Parameters& p, const std::vector<double>& width) {
  std::vector<int> kind(static_cast<std::size_t>(p.balls));
  for (int i = 0; i < p.balls; ++i) {
    kind[i] = i;
    for (int k = 0; k < i && kind[i] == i; ++k)
      if (p.mass[k] == p.mass[i] && width[k] == width[i]) kind[i] = k;
  }
  return kind;
}

Ring ring_of(const Parameters& p, const std::vector<double>& width, const std::vector<int>& balls) {
  Ring ring;
  for (const int i : balls) {
    ring.mass.push_back(p.mass[i]);
    ring.width.push_back(width[i]);
  }
  return ring;
}

// Orders in which the first ball comes first.
double number_of_orders(const std::vector<int>& kind) {
  double orders = 1.0;
  for (std::size_t i = 1; i < kind.size(); ++i) {
    const auto alike = std::count(kind.begin() + 1, kind.begin() + static_cast<std::ptrdiff_t>(i) + 1, kind[i]);
    orders *= static_cast<double>(i) / static_cast<double>(alike);
  }
  return orders;
}

// Every order of the balls round the race, up to rotation, reflection and exchange of alike balls.
std::vector<Ring> all_orders(const Parameters& p, const std::vector<double>& width, std::vector<int> kind) {
  std::sort(kind.begin() + 1, kind.end());
  std::vector<Ring> orders;
  do {
    if (std::lexicographical_compare(kind.rbegin(), kind.rend() - 1, kind.begin() + 1, kind.end())) continue;
    orders.push_back(ring_of(p, width, kind));
  } while (std::next_permutation(kind.begin() + 1, kind.end()));
  return orders;
}

// Where there are too many: the heaviest in the middle of a row, which of balls of one size cancels the most (a longer
// arm counts for more the nearer it lies to the middle); heavy and light ones in turn; and both with any two balls
// exchanged.
std::vector<Ring> some_orders(const Parameters& p, const std::vector<double>& width) {
  std::vector<int> falling(static_cast<std::size_t>(p.balls));
  std::iota(falling.begin(), falling.end(), 0);
  std::stable_sort(falling.begin(), falling.end(), [&](int a, int b) { return p.mass[a] > p.mass[b]; });
  std::vector<int> middle, in_turn;
  for (int k = 0; k < p.balls; ++k) {
    middle.insert(k % 2 ? middle.end() : middle.begin(), falling[k]);
    in_turn.push_back(falling[k % 2 ? p.balls - 1 - k / 2 : k / 2]);
  }
  std::vector<Ring> orders;
  for (std::vector<int> balls : {middle, in_turn}) {
    orders.push_back(ring_of(p, width, balls));
    for (int i = 0; i < p.balls; ++i)
      for (int k = 0; k < i; ++k) {
        std::swap(balls[i], balls[k]);
        orders.push_back(ring_of(p, width, balls));
        std::swap(balls[i], balls[k]);
      }
  }
  return orders;
}

std::vector<std::array<double, 2>> joined(std::vector<std::array<double, 2>> ranges, double gap) {
  std::sort(ranges.begin(), ranges.end());
  std::vector<std::array<double, 2>> result;
  for (const auto& range : ranges)
    if (!result.empty() && range[0] <= result.back()[1] + gap)
      result.back()[1] = std::max(result.back()[1], range[1]);
    else
      result.push_back(range);
  return result;
}

}  // namespace

bool Cancelling::cancels(double unbalance) const {
  return std::any_of(ranges.begin(), ranges.end(), [&](const auto& range) {
    return range[0] - uncertain <= unbalance && unbalance <= range[1] + uncertain;
  });
}

const char* Cancelling::why_not(double unbalance) const {
  if (!fit()) return "the balls do not fit into the race";
  if (lone) return lone_ball;
  if (!all_tried) return "of many orders of these balls in the race, none that was tried cancels just the unbalance";
  if (unbalance > most()) return "balls of this size, side by side, cancel less than the unbalance";
  if (unbalance < least()) return "balls of this size have no room to cancel as little as the unbalance";
  return "no order of these balls in the race cancels just the unbalance";
}

Cancelling cancelling(const Parameters& p, const std::vector<double>& width) {
  constexpr double equal_within = 1e-12, turned_within = 1e-6;  // rounding; residual of the descent
  const double total = p.total_mass(), heaviest = *std::max_element(p.mass.begin(), p.mass.begin() + p.balls);
  const double least = std::max(0.0, 2.0 * heaviest - total);  // for balls without size
  Cancelling result;
  result.lone = p.balls == 1;
  result.uncertain = (width.empty() ? equal_within : turned_within) * total;
  if (width.empty()) {
    result.ranges = {{least, total}};
    return result;
  }
  constexpr double rounding = 1e-12;  // accepts widths that fill the race exactly
  if (std::accumulate(width.begin(), width.end(), 0.0) > two_pi * (1.0 + rounding)) return result;
  const std::vector<int> kind = kinds(p, width);
  const bool every = number_of_orders(kind) <= most_orders_tried;
  std::vector<Ring> orders = every ? all_orders(p, width, kind) : some_orders(p, width);
  std::stable_sort(orders.begin(), orders.end(), [](const Ring& a, const Ring& b) { return most_of(a) > most_of(b); });
  for (const Ring& ring : orders) {
    result.ranges.push_back({least_of(ring, result.uncertain), most_of(ring)});
    // The first order reaches the most. If it also reaches the least, the other orders add nothing.
    if (result.ranges.size() == 1 && result.ranges[0][0] <= least + result.uncertain) break;
  }
  const bool one_size = std::all_of(width.begin(), width.end(), [&](double w) { return w == width.front(); });
  result.all_tried =
      every || (one_size && result.ranges.size() == 1 && result.ranges[0][0] <= least + result.uncertain);
  result.ranges = joined(std::move(result.ranges), result.uncertain);
  return result;
}

Cancelling cancelling(const Parameters& p) {
  if (!p.balls_collide()) return cancelling(p, {});
  return cancelling(p, std::vector<double>(static_cast<std::size_t>(p.balls), p.contact_angle));
}

std::array<double, max_balls> fan(const Parameters& p, const std::vector<double>& width) {
  std::vector<std::size_t> order(width.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return p.mass[a] > p.mass[b]; });
  std::vector<std::size_t> row;
  for (std::size_t k = 0; k < order.size(); ++k) row.insert(k % 2 ? row.end() : row.begin(), order[k]);
  const double filled = std::accumulate(width.begin(), width.end(), 0.0);
  std::array<double, max_balls> phi{};
  const auto spread = [&](double gap) {
    std::complex<double> sum;
    double at = 0.0;
    for (const std::size_t i : row) {
      phi[i] = at + 0.5 * width[i];
      at += width[i] + gap;
      sum += std::polar(p.mass[i], phi[i]);
    }
    for (const std::size_t i : row) phi[i] += pi - std::arg(sum);
    return std::abs(sum);
  };
  double narrow = 0.0, wide = (two_pi - filled) / static_cast<double>(row.size());
  for (int k = 0; k < 60; ++k) {  // down to rounding
    const double middle = 0.5 * (narrow + wide);
    (spread(middle) > p.eccentricity ? narrow : wide) = middle;
  }
  spread(narrow);
  return phi;
}

std::array<double, max_balls> inscribed_polygon(const Parameters& p) {
  const auto sides = static_cast<std::size_t>(p.balls) + 1;
  std::array<double, max_balls + 1> side{p.eccentricity}, half{};  // half: of the angles at the centre
  std::copy_n(p.mass.begin(), p.balls, side.begin() + 1);
  const std::size_t longest =
      static_cast<std::size_t>(std::max_element(side.begin(), side.begin() + sides) - side.begin());
  // Of the others where the longest has the half angle t, or pi - t.
  const auto others = [&](double t) {
    double sum = 0.0;
    for (std::size_t k = 0; k < sides; ++k)
      if (k != longest) sum += half[k] = std::asin(std::min(1.0, side[k] / side[longest] * std::sin(t)));
    return sum;
  };
  const bool centre_inside = others(0.5 * pi) >= 0.5 * pi;
  double low = 0.0, high = 0.5 * pi;
  for (int k = 0; k < 60; ++k) {  // down to rounding
    const double middle = 0.5 * (low + high);
    (centre_inside == (others(middle) < (centre_inside ? pi - middle : middle)) ? low : high) = middle;
  }
  half[longest] = centre_inside ? low : pi - low;
  others(low);
  std::array<double, max_balls> phi{};
  double turned = 0.0;
  for (std::size_t k = 1; k < sides; ++k) {
    turned += half[k - 1] + half[k];
    phi[k - 1] = turned;
  }
  return phi;
}

}  // namespace equipoise::model

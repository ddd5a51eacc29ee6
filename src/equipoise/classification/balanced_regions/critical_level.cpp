// Searches for the level at which a Lyapunov function first fails to decrease.
#include "equipoise/classification/balanced_regions/balanced_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "equipoise/attractors/periodic_orbits/tangent_flow-inl.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/machine/model/ball_count.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE;

// dV/dt along rays z* + s e from one balanced state, with V(e) = 1.
template <class Flow>
class RaySearch {
 public:
  // Sizes are known at run time, storage at compile time.
  static constexpr int most = Flow::dimension;
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most, 1>;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>;

  RaySearch(const model::System& system, const Flow& flow, const Matrix& centre, const Matrix& form,
            const Matrix& factor, bool closely)
      : n(system.balls()),
        size(system.dimension()),
        system_(system),
        flow_(flow),
        form_(form),
        factor_(factor),
        centre_(centre),
        closely_(closely) {}

  // e, where V equals 1, and half of V's gradient there.
  struct Ray {
    Vector e, gradient;
  };

  // For a direction in coordinates in which V is the squared length.
  Ray edge(const Vector& direction) const {
    Vector e = factor_.template triangularView<Eigen::Upper>().solve(direction.normalized());
    Vector gradient = form_ * e;
    return {std::move(e), std::move(gradient)};
  }

  // Smallest s <= limit with dV/dt >= 0 at z* + s e, or limit.
  double first_growth(const Ray& ray, double limit) const {
    static constexpr std::array<double, 7> fractions{0.15, 0.3, 0.45, 0.6, 0.75, 0.88, 1.0};
    static constexpr std::array<double, 2> few{0.5, 1.0};
    double good = 0.0;
    for (const double fraction : closely_ ? std::span<const double>(fractions) : few) {
      double bad = fraction * limit;
      if (!grows(ray, bad)) {
        good = bad;
        continue;
      }
      for (int i = 0; i < 20 && bad - good > 1e-6 * bad; ++i) {
        const double middle = 0.5 * (good + bad);
        (grows(ray, middle) ? bad : good) = middle;
      }
      return bad;
    }
    return limit;
  }

  // Half of dV/dt at z* + s e, over s.
  double slope(const Ray& ray, double s) const { return ray.gradient.dot(rate(centre_ + s * ray.e)); }

  bool grows(const Ray& ray, double s) const { return slope(ray, s) >= 0.0; }

  // The direction in which dV/dt rises fastest at V^(1/2) = s along a direction; both in the coordinates of edge().
  Vector uphill(const Vector& direction, double s) const {
    const Vector d = s * edge(direction).e, z = centre_ + d;
    const Vector rise = form_ * rate(z) + model::jacobian(system_, z).transpose() * (form_ * d);
    return into_unit(rise).normalized();
  }

  // Directions, in the coordinates of edge(), of the extremes of dV/dt close to balance.
  Eigen::MatrixXd principal_directions() const {
    const Eigen::MatrixXd half = form_ * model::jacobian(system_, centre_);
    const Eigen::MatrixXd once = into_unit(half + half.transpose());
    return dense::symmetric_eigenvectors(into_unit(once.transpose()));
  }

  // The s at which some angle deviates by half a turn: no level set may wrap around the race.
  double half_turn() const {
    const Eigen::MatrixXd inverse = dense::inverse(Eigen::MatrixXd(form_));
    double widest = 0.0;
    for (int i = 0; i < n; ++i) widest = std::max(widest, inverse(4 + i, 4 + i));
    return 3.1 / std::sqrt(widest);
  }

 private:
  Vector rate(const Vector& z) const {
    Vector result(size);
    flow_(0.0, z.data(), result.data());
    return result;
  }

  // Takes gradients into coordinates in which V is the squared length.
  Eigen::MatrixXd into_unit(const Eigen::MatrixXd& gradients) const {
    return factor_.transpose().template triangularView<Eigen::Lower>().solve(gradients);
  }

  const int n, size;
  const model::System& system_;
  const Flow flow_;
  Matrix form_, factor_;
  Vector centre_;
  const bool closely_;  // to find the level, and not only the form with the higher one
};

// The least V^(1/2) below `limit` with dV/dt >= 0 that is found by turning a direction to where dV/dt rises fastest: on
// the critical level the gradients of V and dV/dt point the same way. Stiff rotors have narrow level sets with few
// directions of early growth, which random ones miss.
template <class Flow>
double descend(const RaySearch<Flow>& search, typename RaySearch<Flow>::Vector direction, double limit) {
  using Vector = typename RaySearch<Flow>::Vector;
  constexpr int most_steps = 200;
  constexpr double least_part = 1e-5;
  double reach = search.first_growth(search.edge(direction), limit), part = 0.5;
  for (int step = 0; step < most_steps && part > least_part; ++step) {
    const Vector turned = ((1.0 - part) * direction + part * search.uphill(direction, reach)).normalized();
    const auto before = search.edge(direction), after = search.edge(turned);
    const double shorter = search.first_growth(after, reach);
    // If V falls along the whole ray, the rate at its end shows where to look.
    const bool better = shorter < reach || (reach == limit && search.slope(after, limit) > search.slope(before, limit));
    part = better ? std::min(2.0 * part, 1.0) : 0.25 * part;
    if (!better) continue;
    direction = turned;
    reach = shorter;
  }
  return reach;
}

// The same by random directions, and random steps from the worst of them.
template <class Flow>
double sample(const RaySearch<Flow>& search, int size, int rays, Directions& vectors) {
  using Vector = typename RaySearch<Flow>::Vector;
  std::size_t next = 0;

  struct Ray {
    double reach;
    Vector direction;
  };
  constexpr int kept = 12;
  std::vector<Ray> worst;
  double best = search.half_turn();
  for (int ray = 0; ray < rays; ++ray) {
    const Vector direction = vectors[next++];
    const double limit = 1.3 * best;  // look a little beyond, to keep several worst rays
    const double reach = search.first_growth(search.edge(direction), limit);
    if (reach >= limit) continue;
    best = std::min(best, reach);
    worst.push_back({reach, direction});
    std::sort(worst.begin(), worst.end(), [](const Ray& a, const Ray& b) { return a.reach < b.reach; });
    if (worst.size() > kept) worst.pop_back();
  }
  for (Ray& ray : worst) {
    double amplitude = 0.3;
    for (int step = 0; step < 300; ++step) {
      const Vector direction =
          (ray.direction + amplitude * vectors.unscaled(next++) / std::sqrt(double(size))).normalized();
      const double reach = search.first_growth(search.edge(direction), ray.reach);
      if (reach < ray.reach)
        ray = {reach, direction};
      else
        amplitude = std::max(amplitude * 0.97, 1e-4);
    }
    best = std::min(best, ray.reach);
  }
  return best;
}

// Least level of a search of `rays` rays, with or without a descent.
template <class Flow>
double least_level(const model::System& system, const Flow& flow, const Eigen::VectorXd& centre,
                   const Eigen::MatrixXd& form, int rays, Directions& vectors, bool descending) {
  const dense::Cholesky cholesky(form);
  if (!cholesky.definite()) return 0.0;
  const RaySearch<Flow> search(system, flow, centre, form, cholesky.upper(), descending);
  double least = sample(search, system.dimension(), rays, vectors);
  if (!descending) return least * least;
  const Eigen::MatrixXd principal = search.principal_directions();
  for (Eigen::Index k = 0; k < principal.cols(); ++k)
    for (const double sign : {1.0, -1.0})
      least = descend(search, typename RaySearch<Flow>::Vector(sign * principal.col(k)), least);
  return least * least;
}

}  // namespace

const Eigen::VectorXd& Directions::unscaled(std::size_t number) {
  while (made_.size() <= number) {
    made_.emplace_back(size_);
    for (double& x : made_.back()) x = random_.normal();
  }
  return made_[number];
}

double critical_level(const model::System& system, const Eigen::VectorXd& centre, const Eigen::MatrixXd& form, int rays,
                      Directions& vectors, bool descending) {
  constexpr int unrolled = 2;  // balls: with more, balanced states form continua
  const auto least = [&]<class Source>(Source) {
    return least_level(system, Source::template make<double>(system, 0.0), centre, form, rays, vectors, descending);
  };
  if (system.tilts()) return least(kernels::TiltSource{});
  if (!system.plain()) return least(kernels::GeneralSource{});
  return model::with_ball_count<unrolled>(system.balls(),
                                          [&](auto room) { return least(kernels::Autonomous<room>{}); });
}

}  // namespace equipoise

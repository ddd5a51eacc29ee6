// Search for the level at which a Lyapunov function first fails to decrease.
#include "equipoise/traps/critical_level.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "equipoise/base/random.hpp"
#include "equipoise/math/dense.hpp"
#include "equipoise/model/ball_count.hpp"
#include "equipoise/model/flow-inl.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE;
constexpr kernels::Terms autonomous{false, false, false};

// dV/dt along rays z* + s e of one balanced state, e of unit V.
class RaySearch {
 public:
  // Sizes known at run time, storage at compile time.
  static constexpr int most = model::dimension(model::max_balls);
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most, 1>;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most, most>;

  RaySearch(const model::Parameters& p, double speed, const double* phi, const Matrix& form, const Matrix& factor)
      : n(p.balls),
        size(model::dimension(n)),
        flow_(p, model::Segment{0.0, 0.0, 0.0, speed, 0.0, false}),
        form_(form),
        factor_(factor),
        centre_(Vector::Zero(size)) {
    for (int i = 0; i < n; ++i) centre_[model::index::phi(i)] = phi[i];
  }

  // Where V equals 1 along a direction given in coordinates in which V is the squared length.
  Vector edge(const Vector& direction) const {
    return factor_.triangularView<Eigen::Upper>().solve(direction.normalized());
  }

  // Smallest s <= limit with dV/dt >= 0 at z* + s e, or limit.
  double first_growth(const Vector& e, double limit) const {
    static constexpr std::array<double, 7> fractions{0.15, 0.3, 0.45, 0.6, 0.75, 0.88, 1.0};
    double good = 0.0;
    for (double fraction : fractions) {
      double bad = fraction * limit;
      if (!grows(e, bad)) {
        good = bad;
        continue;
      }
      for (int i = 0; i < 20 && bad - good > 1e-6 * bad; ++i) {
        const double middle = 0.5 * (good + bad);
        (grows(e, middle) ? bad : good) = middle;
      }
      return bad;
    }
    return limit;
  }

  bool grows(const Vector& e, double s) const {
    const Vector z = centre_ + s * e;
    Vector rate(size);
    flow_(0.0, z.data(), rate.data());
    return e.dot(form_ * rate) >= 0.0;
  }

  // The s at which some angle deviates by half a turn: no level set may wrap around the race.
  double half_turn() const {
    const Eigen::MatrixXd inverse = dense::inverse(Eigen::MatrixXd(form_));
    double widest = 0.0;
    for (int i = 0; i < n; ++i) widest = std::max(widest, inverse(4 + i, 4 + i));
    return 3.1 / std::sqrt(widest);
  }

 private:
  const int n, size;
  kernels::FreeFlow<double, model::any_count, autonomous> flow_;
  Matrix form_, factor_;
  Vector centre_;
};

}  // namespace

double critical_level(const model::Parameters& p, double speed, const double* phi, const Eigen::MatrixXd& form,
                      int rays) {
  using Vector = RaySearch::Vector;
  const dense::Cholesky cholesky(form);
  if (!cholesky.definite()) return 0.0;
  const RaySearch search(p, speed, phi, form, cholesky.upper());
  const int size = model::dimension(p.balls);

  RandomStream random;
  const auto random_vector = [&] {
    Vector v(size);
    for (int i = 0; i < size; ++i) v[i] = random.normal();
    return v;
  };

  struct Ray {
    double reach;
    Vector direction;
  };
  constexpr int kept = 12;
  std::vector<Ray> worst;
  double best = search.half_turn();
  for (int ray = 0; ray < rays; ++ray) {
    const Vector direction = random_vector().normalized();
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
      const Vector direction = (ray.direction + amplitude * random_vector() / std::sqrt(double(size))).normalized();
      const double reach = search.first_growth(search.edge(direction), ray.reach);
      if (reach < ray.reach)
        ray = {reach, direction};
      else
        amplitude = std::max(amplitude * 0.97, 1e-4);
    }
    best = std::min(best, ray.reach);
  }
  return best * best;
}

}  // namespace equipoise

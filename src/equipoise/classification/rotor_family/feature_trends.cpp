// Fits that grow from sure examples to those that agree with them.
#include "equipoise/classification/rotor_family/feature_trends.hpp"

#include <algorithm>
#include <utility>

#include "equipoise/core/math/polynomial_terms.hpp"
#include "equipoise/simulation/rule/window_features.hpp"

namespace equipoise {

namespace {

constexpr int highest_degree = 3;
// How far the nearest rotors may differ from the first, before a trend is known.
constexpr double as_neighbours = 0.3;

class Fit {
 public:
  // Uses the highest degree with at least twice as many examples as terms. Degree 0 takes the first example.
  Fit(const std::vector<const ShownFeatures*>& used, int balls) : count_(feature_count(balls)) {
    while (degree_ < highest_degree && used.size() >= 2 * terms(*used.front(), degree_ + 1)) ++degree_;
    std::vector<Eigen::VectorXd> rows, values;
    for (const ShownFeatures* s : used) {
      rows.push_back(polynomial_terms(s->coordinates, degree_));
      values.push_back(Eigen::Map<const Eigen::VectorXd>(s->features.data(), count_));
      if (degree_ == 0) break;
    }
    coefficients_ = polynomial_fit(rows, values);
  }

  int degree() const { return degree_; }
  const Eigen::MatrixXd& coefficients() const { return coefficients_; }
  Features at(const std::vector<double>& coordinates) const {
    Features result{};
    Eigen::Map<Eigen::VectorXd>(result.data(), count_) =
        coefficients_.transpose() * polynomial_terms(coordinates, degree_);
    return result;
  }

 private:
  static std::size_t terms(const ShownFeatures& s, int degree) {
    return static_cast<std::size_t>(polynomial_terms(s.coordinates, degree).size());
  }

  int count_, degree_ = 0;
  Eigen::MatrixXd coefficients_;
};

// Whether chaos lasts for all of the nearest rotors tried: two on each side for one value, twice as many for each more.
bool lasts_beside(const OwnRotor& rotor, const std::vector<FeatureTrends::Lasting>& tried) {
  const std::size_t asked =
      std::min(tried.size(), std::size_t{2} << std::min<std::size_t>(rotor.coordinates.size(), 20));
  std::vector<std::pair<double, bool>> all;
  for (const FeatureTrends::Lasting& t : tried)
    all.emplace_back(squared_distance(t.coordinates, rotor.coordinates), t.lasts);
  std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(asked), all.end());
  return std::all_of(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(asked),
                     [](const auto& t) { return t.second; });
}

}  // namespace

int FeatureTrends::add(int balls, double agreement, const ShownFeatures& first, std::vector<ShownFeatures> others) {
  std::stable_sort(others.begin(), others.end(), [&](const ShownFeatures& a, const ShownFeatures& b) {
    return squared_distance(a.coordinates, first.coordinates) < squared_distance(b.coordinates, first.coordinates);
  });
  std::vector<const ShownFeatures*> used{&first};
  for (const ShownFeatures& s : others) {
    const Fit fit(used, balls);
    const double tolerance = fit.degree() == 0 ? as_neighbours : agreement;
    if (same_motion(fit.at(s.coordinates), s.features, balls, tolerance)) used.push_back(&s);
  }
  // Examples accepted before the trend was clear are also judged by it.
  for (int round = 0; round < 3; ++round) {
    const Fit fit(used, balls);
    if (fit.degree() == 0) return -1;
    used = {&first};
    for (const ShownFeatures& s : others)
      if (same_motion(fit.at(s.coordinates), s.features, balls, agreement)) used.push_back(&s);
  }
  const Fit fit(used, balls);
  if (fit.degree() == 0) return -1;
  trends_.push_back({fit.degree(), fit.coefficients()});
  return static_cast<int>(trends_.size()) - 1;
}

int FeatureTrends::add_chaos(std::vector<Lasting> tried) {
  chaos_.push_back(std::move(tried));
  return static_cast<int>(chaos_.size()) - 1;
}

void FeatureTrends::place(OwnRotor& rotor) const {
  rotor.chaos_lasts.clear();
  for (const std::vector<Lasting>& tried : chaos_) rotor.chaos_lasts.push_back(lasts_beside(rotor, tried));
  rotor.shifts.clear();
  for (const Trend& trend : trends_) {
    const std::vector<double> middle(rotor.coordinates.size(), 0.5);
    const Eigen::VectorXd shift = trend.coefficients.transpose() * (polynomial_terms(rotor.coordinates, trend.degree) -
                                                                    polynomial_terms(middle, trend.degree));
    rotor.shifts.insert(rotor.shifts.end(), shift.begin(), shift.end());
  }
}

}  // namespace equipoise

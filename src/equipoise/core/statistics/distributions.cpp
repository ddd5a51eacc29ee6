// The only file that compiles Boost.Math.
#include "equipoise/core/statistics/distributions.hpp"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/gamma.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace equipoise {

namespace {
boost::math::binomial law(const Binomial& b) { return {b.trials, b.probability}; }
}  // namespace

double normal_half_width(double confidence) { return quantile(boost::math::normal(), 0.5 + 0.5 * confidence); }

double normal_quantile(double probability) { return quantile(boost::math::normal(), probability); }

double normal_up_to(double value) { return cdf(boost::math::normal(), value); }

double students_t_half_width(double freedom, double confidence) {
  return quantile(boost::math::students_t(freedom), 0.5 + 0.5 * confidence);
}

double gamma_quantile(double shape, double probability) {
  return quantile(boost::math::gamma_distribution<>(shape), probability);
}

double Binomial::mass(std::uint64_t k) const { return pdf(law(*this), static_cast<double>(k)); }

double Binomial::up_to(std::uint64_t k) const { return cdf(law(*this), static_cast<double>(k)); }

double Binomial::above(std::uint64_t k) const { return cdf(complement(law(*this), static_cast<double>(k))); }

}  // namespace equipoise

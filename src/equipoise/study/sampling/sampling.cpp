// One interface to the three sampling methods.
#include "equipoise/study/sampling/sampling.hpp"

#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/study/sampling/scrambled_sobol.hpp"
#include "equipoise/study/sampling/starts.hpp"

namespace equipoise {

// [sampling.box] can ask for at most this: angles, x, y, x_dot, y_dot and the balls' rates.
static_assert(4 + 2 * model::max_balls <= most_sobol_dimensions);
// Values with names take coordinates up to this one, so that what a seed draws does not change with
// most_sobol_dimensions.
constexpr int most_named_dimensions = 24;
static_assert(most_named_dimensions <= most_sobol_dimensions);

Sampler::Sampler(SamplingMethod method, int balls, std::uint64_t starts, bool exchange)
    : method_(method), balls_(balls) {
  if (method == SamplingMethod::grid) grid_.emplace(balls, exchange, starts);
}

void Sampler::angles(std::uint64_t seed, std::uint64_t index, double* phi) const {
  if (method_ == SamplingMethod::random) return start_angles(seed, index, balls_, phi);
  if (grid_) return grid_->angles(seed, index, phi);
  sobol_fractions(seed, index, 0, balls_, phi);
  for (int i = 0; i < balls_; ++i) phi[i] *= two_pi;
}

void Sampler::fractions(std::uint64_t seed, std::uint64_t index, int count, const bool* drawn,
                        double* fractions) const {
  if (method_ != SamplingMethod::sobol) return start_fractions(seed, index, count, fractions);
  int next = balls_;
  for (int k = 0; k < count; ++k)
    if (drawn[k]) sobol_fractions(seed, index, next++, 1, &fractions[k]);
}

double Sampler::named(std::uint64_t seed, std::uint64_t index, int wanted, int place, std::string_view name) const {
  const int coordinate = balls_ + wanted + place;
  if (method_ != SamplingMethod::sobol || coordinate >= most_named_dimensions) return start_fraction(seed, index, name);
  double number = 0.0;
  sobol_fractions(seed, index, coordinate, 1, &number);
  return number;
}

double Sampler::weight(std::uint64_t seed, std::uint64_t index) const {
  return grid_ ? grid_->weight(seed, index) : 1.0;
}

}  // namespace equipoise

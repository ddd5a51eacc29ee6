// The sum of all unbalances, in doubles.
#include "equipoise/machine/model/unbalance.hpp"

#include "equipoise/machine/model/equation_terms-inl.hpp"

namespace equipoise::model {

std::complex<double> unbalance(const Parameters& p, const double* phi) {
  const double balls = p.total_mass();
  if (p.tilts()) {  // no race is off its centre
    const std::complex<double> own = std::polar(p.eccentricity, p.eccentricity_angle);
    const auto all = HWY_NAMESPACE::sum_of_unbalances(HWY_NAMESPACE::Vector2<double>{own.real(), own.imag()}, p.balls,
                                                      p.mass.data(), phi);
    return {all.x, all.y};
  }
  const HWY_NAMESPACE::Vector2<double> of_rotor{p.eccentricity + balls * p.race_offset[0], balls * p.race_offset[1]};
  const auto sum = HWY_NAMESPACE::sum_of_unbalances(of_rotor, p.balls, p.mass.data(), phi);
  return {sum.x, sum.y};
}

}  // namespace equipoise::model

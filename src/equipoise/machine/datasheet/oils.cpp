// The temperature laws of oils.
#include "equipoise/machine/datasheet/oils.hpp"

#include <cmath>

namespace equipoise::model {

namespace {

// ASTM D2270: viscosities at 40 degC of the reference oils of index 0 (L) and 100 (H) that have the viscosity y at 100
// degC, each a quadratic from `from` to the next line.
struct ReferenceOils {
  double from, l2, l1, l0, h2, h1, h0;
};
constexpr std::array<ReferenceOils, 16> reference_oils{{
    {2.0, 1.14673, 1.7576, -0.109, 0.84155, 1.5521, -0.077},
    {3.8, 3.38095, -15.4952, 33.196, 0.78571, 1.7929, -0.183},
    {4.4, 2.5000, -7.2143, 13.812, 0.82143, 1.5679, 0.119},
    {5.0, 0.10100, 16.6350, -45.469, 0.04985, 9.1613, -18.557},
    {6.4, 3.35714, -23.5643, 78.466, 0.22619, 7.7369, -16.656},
    {7.0, 0.01191, 21.4750, -72.870, 0.79762, -0.7321, 14.610},
    {7.7, 0.41858, 16.1558, -56.040, 0.05794, 10.5156, -28.240},
    {9.0, 0.88779, 7.5527, -16.600, 0.26665, 6.7015, -10.810},
    {12.0, 0.76720, 10.7972, -38.180, 0.20073, 8.4658, -22.490},
    {15.0, 0.97305, 5.3135, -2.200, 0.28889, 5.9741, -4.930},
    {18.0, 0.97256, 5.2500, -0.980, 0.24504, 7.4160, -16.730},
    {22.0, 0.91413, 7.4759, -21.820, 0.20323, 9.1267, -34.230},
    {28.0, 0.87031, 9.7157, -50.770, 0.18411, 10.1015, -46.750},
    {40.0, 0.84703, 12.6752, -133.310, 0.17029, 11.4866, -80.620},
    {55.0, 0.85921, 11.1009, -83.190, 0.17130, 11.3680, -76.940},
    {70.0, 0.83531, 14.6731, -216.246, 0.16841, 11.8493, -96.947},
}};

// The viscosity at 40 degC of an oil of this index that has `at_100` at 100 degC.
double viscosity_at_40(double at_100, double index) {
  const ReferenceOils* line = &reference_oils.front();
  for (const ReferenceOils& next : reference_oils)
    if (next.from <= at_100) line = &next;
  const double low = (line->l2 * at_100 + line->l1) * at_100 + line->l0;
  const double high = (line->h2 * at_100 + line->h1) * at_100 + line->h0;
  return low - 0.01 * index * (low - high);
}

// Of Z: felt below 2 mm^2/s.
double thin_term(double nu) { return std::exp(-1.47 - (1.84 + 0.51 * nu) * nu); }

double walther(double nu) { return std::log10(std::log10(nu + 0.7 + thin_term(nu))); }

double viscosity_of(double walther_number) {
  const double z = std::pow(10.0, std::pow(10.0, walther_number)) - 0.7;
  double nu = z;
  for (int k = 0; k < 60; ++k) nu = z - thin_term(nu);  // each time a third of the error is left, or less
  return nu;
}

}  // namespace

std::optional<double> viscosity_at_100(double at_40, double viscosity_index) {
  double low = least_indexed_viscosity, high = at_40;
  if (!(viscosity_at_40(low, viscosity_index) <= at_40)) return std::nullopt;
  for (int k = 0; k < 60; ++k) {  // to the last digit
    const double middle = 0.5 * (low + high);
    (viscosity_at_40(middle, viscosity_index) <= at_40 ? low : high) = middle;
  }
  return low;
}

double mineral_oil_viscosity(double at_40, double at_100, double kelvin) {
  const double cool = std::log10(celsius_zero + 40.0), hot = std::log10(celsius_zero + 100.0);
  const double slope = (walther(at_100) - walther(at_40)) / (hot - cool);
  return viscosity_of(walther(at_40) + slope * (std::log10(kelvin) - cool));
}

double silicone_viscosity(double at_25, double kelvin) {
  return at_25 * std::pow(10.0, 763.1 * (1.0 / kelvin - 1.0 / (celsius_zero + 25.0)));
}

}  // namespace equipoise::model

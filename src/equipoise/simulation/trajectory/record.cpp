// A trajectory's quantities, computed from a state.
#include "equipoise/simulation/trajectory/record.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "equipoise/machine/mechanics/energy.hpp"
#include "equipoise/machine/mechanics/frames.hpp"
#include "equipoise/machine/model/equation_terms-inl.hpp"
#include "equipoise/machine/model/state_layout.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"

namespace equipoise {

namespace {

void record_bearings(Trajectory& out, const Study& study, double psi, const double* z, const double* tilt) {
  const model::Parameters& p = study.parameters;
  const std::vector<double>& places = study.bearings;
  const std::vector<model::Bearing> each = study.each_bearing();
  using namespace model::index;
  const std::array<double, 2> rest = model::rest_position(p, psi);
  const double slope = model::static_slope(p);
  const double slope_x = slope * std::sin(psi), slope_y = slope * std::cos(psi);
  out.bearing_radial.resize(places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    out.bearing_radial[i].push_back(
        std::hypot(z[x] - rest[0] + places[i] * (tilt[0] - slope_x), z[y] - rest[1] + places[i] * (tilt[1] - slope_y)));
  out.bearing_force.resize(each.size());
  const HWY_NAMESPACE::RotorMotion<double> rotor{0.0, 0.0, std::sin(psi), std::cos(psi)};
  for (std::size_t i = 0; i < each.size(); ++i) {
    const double at = each[i].at;
    const double section[] = {z[x] + at * tilt[0], z[y] + at * tilt[1], z[u] + at * tilt[2], z[v] + at * tilt[3]};
    const auto force = HWY_NAMESPACE::BearingForce<double>(each[i]).of(rotor, section);
    out.bearing_force[i].push_back(std::hypot(force.x, force.y));
  }
}

}  // namespace

void record(Trajectory& out, const model::Parameters& p, double psi, double w, double t, const double* z,
            const double* tilt) {
  using namespace model::index;
  out.t.push_back(t);
  out.psi.push_back(psi);
  out.psi_dot.push_back(w);
  out.x.push_back(z[x]);
  out.y.push_back(z[y]);
  const std::array<double, 2> velocity = model::rotating_velocity(w, z);
  out.x_dot.push_back(velocity[0]);
  out.y_dot.push_back(velocity[1]);
  if (tilt) {
    out.tilt_x.push_back(tilt[0]);
    out.tilt_y.push_back(tilt[1]);
    const std::array<double, 2> rate = model::rotating_velocity(w, tilt);
    out.tilt_x_dot.push_back(rate[0]);
    out.tilt_y_dot.push_back(rate[1]);
  }
  for (int i = 0; i < p.balls; ++i) {
    out.phi[i].push_back(z[phi(i)]);
    out.phi_dot[i].push_back(z[q(i, p.balls)]);
  }
  const std::array<double, 2> rest = model::rest_position(p, psi);
  out.radial.push_back(std::hypot(z[x] - rest[0], z[y] - rest[1]));
  const auto force = model::bearing_force(p, psi, z, tilt);
  out.bearing_x.push_back(force[0]);
  out.bearing_y.push_back(force[1]);
}

void record(Trajectory& out, const Study& study, double t, const double* z) {
  const model::StateLayout layout = model::machine_layout(study.parameters);
  const double* tilt = study.parameters.tilts() ? z + layout.tilt : nullptr;
  record(out, study.parameters, z[layout.psi], z[layout.speed], t, z, tilt);
  if (tilt) record_bearings(out, study, z[layout.psi], z, tilt);
}

}  // namespace equipoise

// The engine's equations as a plain C function, for rivals in other languages (two balls, one problem a process).
#include <optional>

#include "equipoise/machine/model/flow-inl.hpp"

namespace {

namespace kernels = equipoise::HWY_NAMESPACE;

// With psi'' as a term: zero at constant speed, at the cost of four operations that no interpreter notices.
using Flow = kernels::FreeFlow<double, 2, kernels::paper_terms(true)>;

std::optional<Flow> flow;

}  // namespace

// `numbers`: lambda, zeta, kappa, mu_1, mu_2, beta_1, beta_2, then begin, psi, psi', psi'' of the segment.
extern "C" void set_problem(const double* numbers) {
  equipoise::model::Parameters p;
  p.balls = 2;
  p.eccentricity = numbers[0];
  p.damping = {numbers[1], numbers[1]};
  p.stiffness = {numbers[2], numbers[2]};
  p.mass[0] = numbers[3];
  p.mass[1] = numbers[4];
  p.drag[0] = numbers[5];
  p.drag[1] = numbers[6];
  flow.emplace(p, equipoise::model::Segment{numbers[7], 0.0, numbers[8], numbers[9], numbers[10], false});
}

// dz = z' at time t; 8 numbers each. set_problem() has been called.
extern "C" void rhs(double t, const double* z, double* dz) { (*flow)(t, z, dz); }

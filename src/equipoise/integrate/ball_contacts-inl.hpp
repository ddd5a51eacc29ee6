// Balls on one race that cannot pass each other: contact with restitution, and balls that stay together. Included once
// per CPU target.
#if defined(EQUIPOISE_INTEGRATE_BALL_CONTACTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_INTEGRATE_BALL_CONTACTS_INL
#undef EQUIPOISE_INTEGRATE_BALL_CONTACTS_INL
#else
#define EQUIPOISE_INTEGRATE_BALL_CONTACTS_INL
#endif

#include <algorithm>
#include <array>
#include <cmath>

#include "equipoise/base/angles.hpp"
#include "equipoise/model/machine-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// Pair k: the ball in place k around the race and the next one. Its gap is the angle between them beyond touching.
template <int room>
class BallContacts {
 public:
  static constexpr int dimension = model::machine_dimension(room);

  explicit BallContacts(const model::Parameters& p) : n(p.balls), pairs(n > 1 ? n : 0), p_(p) {}

  // Orders the balls around the race as they lie at `z`.
  void begin(const double* z, MachineFlow<room>& flow) {
    std::array<double, room> angle;
    for (int i = 0; i < n; ++i) {
      angle[i] = wrapped_positive(z[4 + i]);
      flow.order[i] = i;
      flow.joined[i] = false;
    }
    std::sort(flow.order, flow.order + n, [&](int a, int b) { return angle[a] < angle[b]; });
    for (int k = 0; k < pairs; ++k) {
      const int a = flow.order[k], b = flow.order[(k + 1) % n];
      const double ahead = angle[b] - angle[a] + (k == n - 1 ? two_pi : 0.0);
      turns_[k] = std::round((ahead - (z[4 + b] - z[4 + a])) / two_pi) * two_pi;
    }
  }

  double gap(int k, const double* z, const MachineFlow<room>& flow) const {
    return z[4 + flow.order[(k + 1) % n]] - z[4 + flow.order[k]] + turns_[k] - p_.contact_angle;
  }
  double gap_rate(int k, const double* z, const MachineFlow<room>& flow) const {
    return z[4 + n + flow.order[(k + 1) % n]] - z[4 + n + flow.order[k]];
  }

  // Whether pairs can meet, or joined ones part, in a step between two states: apart by more than both rates allow,
  // with a margin of three for what they do in between, they cannot.
  bool may_meet(double h, const double* from, const double* to, const MachineFlow<room>& flow) const {
    for (int k = 0; k < pairs; ++k) {
      const double rates = std::fabs(gap_rate(k, from, flow)) + std::fabs(gap_rate(k, to, flow));
      if (flow.joined[k] || std::min(gap(k, from, flow), gap(k, to, flow)) < 3.0 * h * rates + 0.1 * h * h) return true;
    }
    return false;
  }

  // Marks pairs that touch, and joined ones that pull instead of press. True if there is any.
  bool look(double t, const double* z, const MachineFlow<room>& flow, std::array<bool, room>& pair) const {
    bool any = false, evaluated = false;
    for (int k = 0; k < pairs; ++k) {
      if (flow.joined[k]) {
        double dz[dimension];
        if (!evaluated) flow.evaluate(t, z, dz);
        evaluated = true;
        pair[k] = flow.pressure(k) < 0.0;
      } else {
        pair[k] = gap(k, z, flow) < 0.0 && gap_rate(k, z, flow) < 0.0;
      }
      any = any || pair[k];
    }
    return any;
  }

  // Impacts of the marked pairs and of those that they push into each other, and partings of the joined.
  void pass(double t, const std::array<bool, room>& pair, double* z, MachineFlow<room>& flow) {
    std::array<bool, room> touching{};
    for (int k = 0; k < pairs; ++k) {
      if (pair[k] && flow.joined[k])
        flow.joined[k] = false;
      else
        touching[k] = pair[k] || flow.joined[k] || std::fabs(gap(k, z, flow)) < touching_gap;
    }
    // Impacts run through a row of touching balls; each takes energy away, and late ones are taken as plastic.
    const int most_impacts = 64 * n;
    for (int impact = 0; impact < 2 * most_impacts; ++impact) {
      int worst = -1;
      double fastest = -1e-14;
      for (int k = 0; k < pairs; ++k)
        if (touching[k] && gap_rate(k, z, flow) < fastest) fastest = gap_rate(k, z, flow), worst = k;
      if (worst < 0) break;
      const bool slow = p_.restitution * -fastest < joining_rate;
      strike(worst, slow || impact > most_impacts ? 0.0 : p_.restitution, z, flow);
    }
    for (int k = 0; k < pairs; ++k)
      flow.joined[k] = touching[k] && std::fabs(gap_rate(k, z, flow)) < joining_rate * 1e-3;
    part_those_that_pull(t, z, flow);
  }

 private:
  // Rebounds slower than this end a series of ever shorter ones: the balls stay together. In omega_c; the balls would
  // rise less than 1e-10 rad apart.
  static constexpr double joining_rate = 1e-6;
  static constexpr double touching_gap = 1e-9;

  // Newton's law of impact on pair k: the rate of the gap changes sign and shrinks to `restitution` of itself.
  void strike(int k, double restitution, double* z, MachineFlow<room>& flow) const {
    double change[dimension];
    flow.impulse_response(z, flow.order[k], flow.order[(k + 1) % n], change);
    const double impulse = -(1.0 + restitution) * gap_rate(k, z, flow) / gap_rate(k, change, flow);
    for (int i = 0; i < flow.size(); ++i) z[i] += impulse * change[i];
    if (restitution == 0.0) {  // exactly equal, not only to rounding
      const double rate = z[4 + n + flow.order[k]];
      z[4 + n + flow.order[(k + 1) % n]] = rate;
    }
  }

  void part_those_that_pull(double t, const double* z, MachineFlow<room>& flow) const {
    for (int round = 0; round < n; ++round) {
      double dz[dimension];
      flow.evaluate(t, z, dz);
      int worst = -1;
      for (int k = 0; k < pairs; ++k)
        if (flow.joined[k] && flow.pressure(k) < 0.0 && (worst < 0 || flow.pressure(k) < flow.pressure(worst)))
          worst = k;
      if (worst < 0) return;
      flow.joined[worst] = false;
    }
  }

  const model::BallCount<room> n;
  const int pairs;
  const model::Parameters& p_;
  std::array<double, room> turns_{};
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif

// Equations of a cycle by multiple shooting, as one vector of unknowns of size 1 for curves and branches of cycles;
// test functions of what happens to a cycle.
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/extras/planes/bifurcation_chart.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise {

/// A periodic motion in the rotating frame.
struct CycleShape {
  double period = 0.0;
  std::vector<Eigen::VectorXd> nodes;  ///< states at equally spaced times of one period, angles unwrapped
  Eigen::VectorXd turned{};            ///< whole turns of its angles in a period, in radians; empty: none
};

/// The longest period of cycles that are followed, from the one at birth: close to a homoclinic connection of a state
/// at rest, it grows without bound.
inline constexpr double longest_turns = 50.0;  ///< of the rotor; below the critical speed of one at that speed
inline constexpr double longest_growth = 2.0;  ///< at least this many times the one at birth
double longest_period(const model::System& system, const CycleShape& shape, double at_birth);

/// What follows from a shape in one system. Everything is in units of System::scale().
struct CycleArcs {
  std::vector<TangentFlight> flights;   ///< from the nodes, with the states' own units in `end`
  std::vector<Eigen::MatrixXd> slopes;  ///< of an arc's end by its node
  std::vector<Eigen::VectorXd> rates;   ///< dz/dt at an arc's end
  /// Their product: of the last arc's end by the first node.
  Eigen::MatrixXd monodromy() const;
};

/// By how much a change of the arcs' slopes changes a test function: Re(left' change(monodromy) right + shift left'
/// change(rate at the last end)). In units of System::scale().
struct CycleWeights {
  Eigen::VectorXcd left, right;
  std::complex<double> shift = 0.0;

  Eigen::VectorXd of_rate(const Eigen::VectorXcd& left_there) const {
    return shift.real() * left_there.real() - shift.imag() * left_there.imag();
  }
};

class CycleShooting {
 public:
  /// For smooth systems like this one that do not depend on the rotor's angle, and shapes with as many nodes as
  /// `first`. `tolerance`: of a step of the integrations.
  CycleShooting(const model::System& like, const CycleShape& first, double tolerance);

  /// As many nodes as a cycle of this period needs.
  static int nodes_for(double period);

  /// Period and nodes as unknowns of size 1, of which small steps are small in the plane of parameters.
  Eigen::VectorXd packed(const CycleShape& shape) const;
  CycleShape shape(const Eigen::Ref<const Eigen::VectorXd>& packed) const;
  Eigen::Index unknowns() const { return 1 + size_ * count_; }
  Eigen::Index dimension() const { return size_; }
  const Eigen::VectorXd& unit() const { return unit_; }

  /// The rate at the reference's first node, of about unit length.
  const Eigen::VectorXd& phase() const { return phase_.front(); }
  /// The phase from here on: no change along this shape's motion, on average.
  void stay_near(const model::System& system, const CycleShape& shape);

  /// Empty where an integration fails.
  std::optional<CycleArcs> arcs(const model::System& system, const CycleShape& shape) const;
  /// Mismatch of the arcs' ends, then that of the phase: as many as unknowns().
  Eigen::VectorXd equations(const CycleShape& shape, const CycleArcs& arcs) const;
  /// By the packed unknowns.
  Eigen::MatrixXd slopes(const CycleArcs& arcs) const;

  struct Change {
    Eigen::VectorXd equations;
    double test = 0.0;
  };
  /// Derivatives by a parameter, from systems that differ by `difference` in it. With weights also of their test.
  std::optional<Change> by_parameter(const model::System& below, const model::System& above, double difference,
                                     const CycleShape& shape, const CycleArcs& arcs, const CycleWeights* weights) const;
  /// Derivatives of a test by the packed unknowns.
  std::optional<Eigen::RowVectorXd> test_slopes(const model::System& system, const CycleShape& shape,
                                                const CycleArcs& arcs, const CycleWeights& weights) const;
  /// Of these the change along one of the first node (in units) and of the period, which the arcs carry along.
  double along(const Eigen::RowVectorXd& test_slopes, const CycleArcs& arcs, Eigen::VectorXd change,
               double longer) const;

  /// Floquet multipliers but that of a shift in time, with falling modulus.
  Eigen::VectorXcd multipliers(const model::System& system, const CycleShape& shape, const CycleArcs& arcs) const;

 private:
  struct Carried {
    std::vector<Eigen::VectorXcd> left, right;  // by arc: at its end, at its beginning
  };
  Carried carried(const CycleArcs& arcs, const CycleWeights& weights) const;
  double arc_time(const CycleShape& shape) const { return shape.period / static_cast<double>(count_); }
  std::optional<Eigen::MatrixXd> bent(const model::System& system, const CycleShape& shape, Eigen::Index arc,
                                      const Eigen::VectorXd& along) const;

  Eigen::Index size_, count_;
  Eigen::VectorXd unit_, turned_;
  double tolerance_, node_weight_, period_weight_;
  CycleShape reference_;
  std::vector<Eigen::VectorXd> phase_;  // by node: rates of the reference, in units
};

/// Half of what the ball covers that swings most, in radians, to a percent.
double cycle_swing(const model::System& system, const CycleShape& shape);

/// Of folds and period doublings g of [A b; c' 0] [v; g] = [0; 1] (W. Govaerts, Numerical Methods for Bifurcations of
/// Dynamical Equilibria, 2000): A is the monodromy matrix minus 1, bordered by the shift in time and the phase; or the
/// monodromy matrix plus 1. Of tori the product of the pair minus 1. All in units of System::scale().
class CycleTest {
 public:
  /// `cosine`: of the angle of a torus's pair.
  CycleTest(CurveKind change, double cosine) : change_(change), cosine_(cosine) {}

  /// The vectors b and c from a cycle near the curve. False if they are not defined.
  bool begin(const CycleArcs& arcs, const Eigen::VectorXd& phase);
  /// What values are compared with from here on.
  void stay_near(const Eigen::VectorXd& right, const Eigen::VectorXd& left, double cosine) {
    if (right.size() > 0) row_ = right, column_ = left;
    cosine_ = cosine;
  }
  void set_phase(const Eigen::VectorXd& phase) { phase_ = phase; }

  struct Value {
    double value = 0.0;
    Eigen::VectorXd right, left;  ///< of folds and period doublings: null vectors, of unit length
    double cosine = 0.0;          ///< of a torus's pair: half of its sum
    CycleWeights weights;
  };
  std::optional<Value> at(const CycleArcs& arcs) const;

 private:
  Eigen::MatrixXd matrix(const CycleArcs& arcs) const;
  std::optional<Value> torus(const CycleArcs& arcs) const;

  CurveKind change_;
  double cosine_;
  Eigen::VectorXd phase_, row_, column_;
};

}  // namespace equipoise

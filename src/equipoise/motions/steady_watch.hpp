// When a machine's trajectory has become steady, and what its balls then do: for motions that are told by measuring
// them alone (a driven rotor, balls that touch or stick), without a list of attractors.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "equipoise/model/parameters.hpp"

namespace equipoise {

/// A machine's motion at one time.
struct SteadySample {
  double r2 = 0.0;                                     ///< squared distance from the static position
  std::array<double, model::max_balls> phi{}, rate{};  ///< phi, without jumps; phi'
};

/// What the balls do in a steady motion. Names mean what motion_name() means by them, and identifiers are its own where
/// it has one; from first_free_id on they are these kinds'.
struct SteadyKind {
  int id = 0;
  std::string name;
};
/// Every kind of n balls, in the order of identifiers: `balanced`, `locked`, else by how many are captured (no mean
/// drift); if none is, by whether they drift at one rate, and then whether they pass opposite places.
std::vector<SteadyKind> steady_kinds(int balls);

/// Of a motion that never quite repeats itself: time after which its kind alone tells it. It may be a transient, of which
/// some last for ten thousand time units, chaotic or as even as a torus.
inline constexpr double unrepeated_time = 20000.0;

/// What was seen of a stretch of time.
struct SteadyStretch {
  double duration = 0.0, turned = 0.0;  ///< and psi's change
  double r2_min = 1e300, r2_max = 0.0, r2_integral = 0.0;
  struct Ball {
    double turned = 0.0, slowest = 1e300, fastest = -1e300;
  };
  std::array<Ball, model::max_balls> ball{};
  int oppositions = 0;  ///< times that two balls passed opposite places

  void add(const SteadyStretch& next);
  double speed() const { return turned / duration; }
  double r_rms() const;
};

/// How the later half of what was seen looks.
struct SteadyLook {
  bool enough = false;        ///< there are eight parts to compare
  bool speed_steady = false;  ///< the rotor's mean speed neither trends nor wanders
  bool slowing = false;       ///< it fell from part to part
  bool quickening = false;    ///< it rose
  bool trending = false;      ///< something grew or shrank from part to part
  bool repeats = false;       ///< all parts look the same
  bool resting = false;       ///< all balls stay where they are, give or take a little rocking
  int kind = 0;               ///< 0: not told yet (a ball drifts so little that it may be captured, balls pass opposite
                              ///< places now and then). Resting balls are 7 (locked) here, balanced or not
  bool swinging = false;      ///< some ball's rate exceeds a thousandth of the rotor's speed
  double speed = 0.0;         ///< mean
  double r_rms = 0.0;
};

/// Watches one trajectory in blocks of time that hold whole turns of the rotor as fast as it turns then. The later half
/// of all blocks is cut into eight parts. Nothing is steady in which a ball's drift, an extreme of r or of a ball's
/// rate, or the mean speed grows or shrinks from part to part (Kendall's rank correlation).
class SteadyWatch {
 public:
  /// `creeps`: balls at rest may move on slowly without an end to it (what gravity or a race off-centre leaves of a
  /// continuum of balanced states): a resting ball's small drift then counts for nothing.
  explicit SteadyWatch(const model::Parameters& p, bool creeps = false);

  /// Forgets all, and begins at time `t` with the rotor at angle `psi` and the balls at `phi`.
  void begin(double t, double psi, const double* phi);
  /// A step to time `t`: samples within and at its end; the rotor's angle there. True whenever a block has ended.
  bool step(double t, double psi, const std::array<SteadySample, 3>& samples);

  /// Since begin().
  std::size_t blocks() const { return blocks_.size(); }
  double watched() const { return last_ - begin_; }
  SteadyLook look() const;
  /// psi' averaged over the later half; over all that was seen if that is nothing yet.
  double mean_speed() const;

 private:
  void open(double t, double psi, const double* phi);
  int oppositions_to(const std::array<double, model::max_balls>& phi);

  const model::Parameters& p_;
  bool creeps_, interchangeable_;
  std::vector<SteadyStretch> blocks_;
  SteadyStretch open_;
  double begin_ = 0.0, last_ = 0.0, block_begin_ = 0.0, psi_ = 0.0, begin_psi_ = 0.0, last_psi_ = 0.0;
  // Of the open block: each ball's angle at its begin and by now, and the angle's integral; its mean in the block
  // before. Balls turn from mean to mean: where they are when a block ends depends on how far they rock.
  std::array<double, model::max_balls> phi_{}, last_phi_{}, angle_{}, mean_{};
  std::array<double, model::max_balls> sampled_{};  // angles of the last sample
};

}  // namespace equipoise

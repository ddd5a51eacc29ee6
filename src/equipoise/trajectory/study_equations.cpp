// The equations of motion over a study's whole drive.
#include "equipoise/trajectory/study_equations.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "equipoise/base/error.hpp"
#include "equipoise/math/gradient.hpp"
#include "equipoise/model/ball_count.hpp"
#include "equipoise/model/frames.hpp"
#include "equipoise/model/hybrid_flow-inl.hpp"
#include "equipoise/model/machine.hpp"
#include "equipoise/spin_up/initial_state.hpp"
#include "equipoise/trajectory/record.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE;
using namespace model::machine_index;

constexpr int most = model::machine_dimension(model::max_balls);
using Flow = kernels::HybridFlow<double, model::any_count>;
using Dual = Gradient<double, most>;
using SlopeFlow = kernels::HybridFlow<Dual, model::any_count>;

void check_has_equations(const Study& study) {
  check(study);
  const model::Parameters& p = study.parameters;
  const auto refuse = [&](const char* key, double value, const char* why) {
    throw InputError(study.name, key, fmt::format("{}", value), why);
  };
  if (!study.uncertain.empty())
    throw InputError(study.name, study.uncertain.values.front().key, "",
                     "is uncertain; equations are those of one rotor: with_medians() or drawn_study()");
  if (p.balls_collide())
    refuse("balancer.contact_angle", p.contact_angle,
           "balls that meet need events, as simulate() has them; must be 0, or contact = false");
  const char* sticks = "balls that stick need events, as simulate() has them; must be 0";
  for (int i = 0; i < p.balls; ++i) {
    if (p.rolling[i] > 0.0) refuse("balancer.rolling", p.rolling[i], sticks);
    if (p.stiction[i] > 0.0) refuse("balancer.stiction", p.stiction[i], sticks);
  }
}

std::vector<StudyEquations::Component> components_of(int balls, bool driven, bool error) {
  std::vector<StudyEquations::Component> c{{"x", "R", "centre O of the shaft, along the rotating x axis"},
                                           {"y", "R", "centre O of the shaft, along the rotating y axis"},
                                           {"u", "R omega_c", "inertial velocity of O along the rotating x axis"},
                                           {"v", "R omega_c", "inertial velocity of O along the rotating y axis"}};
  for (int i = 1; i <= balls; ++i)
    c.push_back({fmt::format("phi_{}", i), "rad", fmt::format("angle of ball {} in the rotating frame", i), true});
  for (int i = 1; i <= balls; ++i)
    c.push_back({fmt::format("phi_dot_{}", i), "omega_c", fmt::format("rate of ball {} in the rotating frame", i)});
  if (driven) c.push_back({"psi", "rad", "angle of the rotor", true});
  if (driven) c.push_back({"psi_dot", "omega_c", "speed of the rotor"});
  if (error) c.push_back({"speed_error_integral", "rad", "integral of what the speed lacks of the control's target"});
  return c;
}

}  // namespace

struct StudyEquations::State {
  explicit State(const Study& of) : State(of, of.drive()) {}
  State(const Study& of, model::Drive how)
      : study(of), drive(std::move(how)), free(of.parameters), held(of.parameters) {
    const int n = balls();
    if (std::isfinite(drive.release_time)) drive.release_speed.reset();
    for (int i = 0; i < n; ++i) clamped.held[i] = true;
    held.set(clamped);
    for (int i = 0; i < model::dimension(n); ++i) places.push_back(i);
    const bool driven = study.speed.driven();
    bool error = false;
    for (const model::DrivePiece& p : drive.pieces) error = error || (p.driven() && p.motor.integral != 0.0);
    if (driven) places.insert(places.end(), {psi(n), speed(n)});
    if (error) places.push_back(error_integral(n));
    components = components_of(n, driven, error);
    cut();
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  int balls() const { return study.parameters.balls; }
  int size() const { return static_cast<int>(places.size()); }

  // Throws if no speed decides when the balls are let go.
  double deciding_speed() const {
    if (drive.release_speed) return *drive.release_speed;
    throw InputError(study.name, "release.speed", "", "is not what lets the balls go; must be that of a driven rotor");
  }

  const model::DrivePiece& drive_at(std::size_t piece) const { return drive.pieces[drive_of[piece]]; }
  template <class T>
  kernels::HybridFlow<T, model::any_count> flow(std::size_t piece,
                                                const kernels::ModeTable<T, model::any_count>& m) const {
    return {study.parameters, drive_at(piece), &m};
  }

  // The state of model/machine.hpp.
  void whole(std::size_t piece, double t, const double* y, double* z) const {
    const int n = balls();
    const model::DrivePiece& p = drive_at(piece);
    const double elapsed = t - p.begin;
    z[psi(n)] = p.psi + (p.speed + 0.5 * p.acceleration * elapsed) * elapsed;
    z[speed(n)] = p.speed + p.acceleration * elapsed;
    z[error_integral(n)] = 0.0;
    for (int i = 0; i < size(); ++i) z[places[i]] = y[i];
  }

  Study study;
  model::Drive drive;
  std::vector<int> places;  // of a state's components in that of model/machine.hpp
  std::vector<Component> components;
  std::vector<Piece> pieces;
  std::vector<std::size_t> drive_of;  // pieces
  model::BallMode clamped;
  kernels::ModeTable<double, model::any_count> free, held;
  std::vector<Flow> flows;  // over the pieces

 private:
  // The drive's pieces, cut where the balls are let go.
  void cut() {
    const double release = drive.release_time;
    for (std::size_t k = 0; k < drive.pieces.size(); ++k) {
      const model::DrivePiece& p = drive.pieces[k];
      const double parted = std::clamp(release, p.begin, p.end);
      if (p.begin < parted) add(k, p.begin, parted, true);
      if (parted < p.end) add(k, parted, p.end, false);
    }
    flows.reserve(pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) flows.push_back(flow(i, pieces[i].held ? held : free));
  }
  void add(std::size_t of, double begin, double end, bool balls_held) {
    pieces.push_back({begin, end, balls_held});
    drive_of.push_back(of);
  }
};

StudyEquations::StudyEquations(const Study& study) {
  check_has_equations(study);
  state_ = std::make_shared<const State>(study);
}
StudyEquations::StudyEquations(std::shared_ptr<const State> state) : state_(std::move(state)) {}
StudyEquations::StudyEquations(const StudyEquations&) = default;
StudyEquations& StudyEquations::operator=(const StudyEquations&) = default;
StudyEquations::~StudyEquations() = default;

const Study& StudyEquations::study() const { return state_->study; }
int StudyEquations::dimension() const { return state_->size(); }
const std::vector<StudyEquations::Component>& StudyEquations::components() const { return state_->components; }
const std::vector<StudyEquations::Piece>& StudyEquations::pieces() const { return state_->pieces; }

std::size_t StudyEquations::piece_at(double t) const {
  const auto& pieces = state_->pieces;
  const auto later =
      std::upper_bound(pieces.begin(), pieces.end(), t, [](double at, const Piece& p) { return at < p.begin; });
  return later == pieces.begin() ? 0 : static_cast<std::size_t>(later - pieces.begin()) - 1;
}

std::vector<double> StudyEquations::breakpoints() const {
  std::vector<double> ends;
  for (std::size_t i = 0; i + 1 < pieces().size(); ++i) ends.push_back(pieces()[i].end);
  return ends;
}

double StudyEquations::release_time() const { return state_->drive.release_time; }

std::optional<double> StudyEquations::release_speed() const { return state_->drive.release_speed; }

double StudyEquations::release_distance(const double* y) const {
  const double release = state_->deciding_speed(), speed = y[model::dimension(state_->balls()) + 1];
  return release > state_->drive.speed ? speed - release : -(speed - release);
}

StudyEquations StudyEquations::released_at(double t) const {
  state_->deciding_speed();
  model::Drive drive = state_->drive;
  if (!std::isfinite(t) || t < 0.0)
    throw InputError("release", "time", fmt::format("{}", t), "must be a finite number, 0 or more");
  drive.release_speed.reset();
  drive.release_time = t;
  return StudyEquations(std::make_shared<const State>(study(), std::move(drive)));
}

std::vector<double> StudyEquations::initial_state() const { return initial_state(study().initial); }

std::vector<double> StudyEquations::initial_state(const InitialState& start) const {
  MotionState motion{parted(study().parameters, start)};
  motion.psi_dot = state_->drive.speed;
  return state(0, 0.0, motion);
}

void StudyEquations::rhs(std::size_t piece, double t, const double* y, double* dy) const {
  double z[Flow::dimension], dz[Flow::dimension];
  state_->whole(piece, t, y, z);
  state_->flows[piece](t, z, dz);
  for (int i = 0; i < dimension(); ++i) dy[i] = dz[state_->places[i]];
}

void StudyEquations::jacobian(std::size_t piece, double t, const double* y, double* matrix) const {
  double values[Flow::dimension];
  state_->whole(piece, t, y, values);
  kernels::ModeTable<Dual, model::any_count> modes(study().parameters);
  if (pieces()[piece].held) modes.set(state_->clamped);
  Dual z[SlopeFlow::dimension], dz[SlopeFlow::dimension];
  for (int i = 0; i < model::machine_dimension(state_->balls()); ++i) z[i] = values[i];
  const int size = dimension();
  for (int k = 0; k < size; ++k) z[state_->places[k]].slope[k] = 1.0;
  state_->flow(piece, modes)(Dual(t), z, dz);
  for (int i = 0; i < size; ++i)
    for (int k = 0; k < size; ++k) matrix[i * size + k] = dz[state_->places[i]].slope[k];
}

void StudyEquations::cross(std::size_t piece, double* y) const {
  if (study().speed.driven() || piece + 1 >= pieces().size()) return;
  const model::DrivePiece &before = state_->drive_at(piece), &after = state_->drive_at(piece + 1);
  const double now = before.speed + before.acceleration * (pieces()[piece].end - before.begin);
  const double then = after.speed + after.acceleration * (pieces()[piece].end - after.begin);
  model::apply_speed_jump(then - now, y);
}

double StudyEquations::energy(std::size_t piece, double t, const double* y) const {
  double z[Flow::dimension];
  state_->whole(piece, t, y, z);
  return model::machine_energy(study().parameters, z);
}

model::Powers StudyEquations::powers(std::size_t piece, double t, const double* y) const {
  const int n = state_->balls();
  double z[Flow::dimension], dz[Flow::dimension];
  state_->whole(piece, t, y, z);
  state_->flows[piece](t, z, dz);
  const model::Segment now{t, t, z[psi(n)], z[speed(n)], dz[speed(n)], pieces()[piece].held};
  return model::powers(study().parameters, study().parameters.inertia, now, t, z);
}

MotionState StudyEquations::motion(std::size_t piece, double t, const double* y) const {
  const int n = state_->balls();
  double z[Flow::dimension];
  state_->whole(piece, t, y, z);
  MotionState m;
  m.psi = z[psi(n)];
  m.psi_dot = z[speed(n)];
  m.speed_error_integral = z[error_integral(n)];
  m.x = z[model::index::x];
  m.y = z[model::index::y];
  const auto velocity = model::rotating_velocity(m.psi_dot, z);
  m.x_dot = velocity[0];
  m.y_dot = velocity[1];
  for (int i = 0; i < n; ++i) {
    m.phi[i] = z[model::index::phi(i)];
    m.phi_dot[i] = z[model::index::q(i, n)];
  }
  return m;
}

std::vector<double> StudyEquations::state(std::size_t piece, double t, const MotionState& motion) const {
  const int n = state_->balls();
  double z[Flow::dimension];
  z[psi(n)] = motion.psi;
  z[speed(n)] = motion.psi_dot;
  z[error_integral(n)] = motion.speed_error_integral;
  const model::DrivePiece& p = state_->drive_at(piece);
  const double speed_now = p.driven() ? motion.psi_dot : p.speed + p.acceleration * (t - p.begin);
  equipoise::initial_state(motion, n, speed_now, z);
  if (pieces()[piece].held)
    for (int i = 0; i < n; ++i) z[model::index::q(i, n)] = 0.0;
  std::vector<double> y;
  for (const int place : state_->places) y.push_back(z[place]);
  return y;
}

void StudyEquations::append(double t, const double* y, Trajectory& trajectory) const {
  const int n = state_->balls();
  double z[Flow::dimension];
  state_->whole(piece_at(t), t, y, z);
  trajectory.phi.resize(static_cast<std::size_t>(n));
  trajectory.phi_dot.resize(static_cast<std::size_t>(n));
  record(trajectory, study().parameters, z[psi(n)], z[speed(n)], t, z);
}

}  // namespace equipoise

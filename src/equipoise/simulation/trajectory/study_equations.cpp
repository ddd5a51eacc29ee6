// The equations of motion over a study's whole drive.
#include "equipoise/simulation/trajectory/study_equations.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/machine/drives/full_state.hpp"
#include "equipoise/core/math/gradient.hpp"
#include "equipoise/machine/mechanics/capability.hpp"
#include "equipoise/machine/mechanics/frames.hpp"
#include "equipoise/machine/model/ball_count.hpp"
#include "equipoise/machine/model/hybrid_flow-inl.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"
#include "equipoise/simulation/trajectory/record.hpp"

namespace equipoise {

namespace {

constexpr char sticking_needs_events[] = "sticking balls need events, as simulate() has them; must be 0";
namespace kernels = HWY_NAMESPACE;

constexpr int most = model::largest_state;
template <class T, bool tilt>
using FlowOver = kernels::HybridFlow<T, model::any_count, tilt>;
constexpr int padded = FlowOver<double, true>::dimension;  // the largest array that a flow reads and writes
using Dual = Gradient<double, most>;

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
           "touching balls need events, as simulate() has them; must be 0, or contact = false");
  for (int i = 0; i < p.balls; ++i) {
    if (p.rolling[i] > 0.0) refuse("balancer.rolling", p.rolling[i], sticking_needs_events);
    if (p.stiction[i] > 0.0) refuse("balancer.stiction", p.stiction[i], sticking_needs_events);
  }
}

bool integrates_error(const model::Drive& drive) {
  return std::any_of(drive.pieces.begin(), drive.pieces.end(),
                     [](const model::DrivePiece& p) { return p.driven() && p.motor.integral != 0.0; });
}

}  // namespace

struct StudyEquations::State {
  explicit State(const Study& of) : State(of, of.drive()) {}
  State(const Study& of, model::Drive how)
      : study(of),
        drive(std::move(how)),
        machine(model::machine_layout(of.parameters)),
        own(model::StateLayout::of(of.parameters.balls, of.speed.driven(), of.speed.driven(), integrates_error(drive),
                                   of.parameters.tilts())),
        variables(model::state_variables(own)),
        free(of.parameters),
        held(of.parameters) {
    const int n = balls();
    if (std::isfinite(drive.release_time)) drive.release_speed.reset();
    for (int i = 0; i < n; ++i) clamped.held[i] = true;
    held.set(clamped);
    cut();
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  int balls() const { return study.parameters.balls; }

  // Throws if no speed triggers the release.
  double deciding_speed() const {
    if (drive.release_speed) return *drive.release_speed;
    throw InputError(study.name, "release.speed", "", "does not release the balls; must be that of a driven rotor");
  }

  const model::DrivePiece& drive_at(std::size_t piece) const { return drive.pieces[drive_of[piece]]; }
  template <bool tilt, class T>
  FlowOver<T, tilt> flow(std::size_t piece, const kernels::ModeTable<T, model::any_count>& modes) const {
    return {study.parameters, drive_at(piece), &modes};
  }

  // Rates of the full layout into `dz`. Returns the torque on the rotor.
  double rates(std::size_t piece, double t, const double* z, double* dz) const {
    kernels::BallForces<double, model::any_count> forces;
    return study.parameters.tilts() ? tilting[piece].evaluate(t, z, dz, forces).torque
                                    : flows[piece].evaluate(t, z, dz, forces).torque;
  }

  // The state in the full layout of `machine`.
  template <class T>
  void whole(std::size_t piece, double t, const T* y, T* z) const {
    const model::Segment now = drive_at(piece).motion(false);
    z[machine.psi] = T(now.psi_at(t));
    z[machine.speed] = T(now.speed_at(t));
    z[machine.error] = T(0.0);
    model::copy_state(own, y, machine, z);
  }

  Study study;
  model::Drive drive;
  model::StateLayout machine, own;
  std::vector<model::StateVariable> variables;
  std::vector<Piece> pieces;
  std::vector<std::size_t> drive_of;  // drive piece of each entry in `pieces`
  model::BallMode clamped;
  kernels::ModeTable<double, model::any_count> free, held;
  // One per entry of `pieces`, in one of the two.
  std::vector<FlowOver<double, false>> flows;
  std::vector<FlowOver<double, true>> tilting;

 private:
  // Cuts the drive's pieces where the balls are released.
  void cut() {
    const double release = drive.release_time;
    for (std::size_t k = 0; k < drive.pieces.size(); ++k) {
      const model::DrivePiece& p = drive.pieces[k];
      const double parted = std::clamp(release, p.begin, p.end);
      if (p.begin < parted) add(k, p.begin, parted, true);
      if (parted < p.end) add(k, parted, p.end, false);
    }
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const auto& modes = pieces[i].held ? held : free;
      if (study.parameters.tilts())
        tilting.push_back(flow<true>(i, modes));
      else
        flows.push_back(flow<false>(i, modes));
    }
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
int StudyEquations::dimension() const { return state_->own.size; }
const std::vector<model::StateVariable>& StudyEquations::variables() const { return state_->variables; }
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
  double z[padded], dz[padded];
  state_->whole(piece, t, y, z);
  state_->rates(piece, t, z, dz);
  model::copy_state(state_->machine, dz, state_->own, dy);
}

void StudyEquations::jacobian(std::size_t piece, double t, const double* y, double* matrix) const {
  kernels::ModeTable<Dual, model::any_count> modes(study().parameters);
  if (pieces()[piece].held) modes.set(state_->clamped);
  Dual variables[most], rates[most], z[padded], dz[padded];
  const int size = dimension();
  for (int k = 0; k < size; ++k) variables[k] = Dual(y[k], k);
  state_->whole(piece, t, variables, z);
  if (study().parameters.tilts())
    state_->flow<true>(piece, modes)(Dual(t), z, dz);
  else
    state_->flow<false>(piece, modes)(Dual(t), z, dz);
  model::copy_state(state_->machine, dz, state_->own, rates);
  for (int i = 0; i < size; ++i) std::copy_n(rates[i].slope, size, matrix + i * size);
}

void StudyEquations::cross(std::size_t piece, double* y) const {
  if (study().speed.driven() || piece + 1 >= pieces().size()) return;
  const model::DrivePiece &before = state_->drive_at(piece), &after = state_->drive_at(piece + 1);
  const double end = pieces()[piece].end, now = before.motion(false).speed_at(end);
  const double then = after.motion(false).speed_at(end);
  model::apply_speed_jump(then - now, y, state_->own.tilt);
}

double StudyEquations::energy(std::size_t piece, double t, const double* y) const {
  double z[padded];
  state_->whole(piece, t, y, z);
  return model::full_energy(study().parameters, z);
}

model::Powers StudyEquations::powers(std::size_t piece, double t, const double* y) const {
  const model::StateLayout& at = state_->machine;
  double z[padded], dz[padded];
  state_->whole(piece, t, y, z);
  const double torque = state_->rates(piece, t, z, dz);
  if (study().parameters.tilts()) return model::tilting_powers(study().parameters, torque, pieces()[piece].held, z);
  const model::Segment now{t, t, z[at.psi], z[at.speed], dz[at.speed], pieces()[piece].held};
  return model::powers(study().parameters, study().parameters.inertia, now, t, z);
}

MotionState StudyEquations::motion(std::size_t piece, double t, const double* y) const {
  const int n = state_->balls();
  double z[padded];
  state_->whole(piece, t, y, z);
  MotionState m;
  m.psi = z[state_->machine.psi];
  m.psi_dot = z[state_->machine.speed];
  m.speed_error_integral = z[state_->machine.error];
  m.x = z[model::index::x];
  m.y = z[model::index::y];
  const auto velocity = model::rotating_velocity(m.psi_dot, z);
  m.x_dot = velocity[0];
  m.y_dot = velocity[1];
  if (const int tilt = state_->machine.tilt; tilt >= 0) {
    const auto rate = model::rotating_velocity(m.psi_dot, z + tilt);
    m.tilt_x = z[tilt];
    m.tilt_y = z[tilt + 1];
    m.tilt_x_dot = rate[0];
    m.tilt_y_dot = rate[1];
  }
  for (int i = 0; i < n; ++i) {
    m.phi[i] = z[model::index::phi(i)];
    m.phi_dot[i] = z[model::index::q(i, n)];
  }
  return m;
}

std::vector<double> StudyEquations::state(std::size_t piece, double t, const MotionState& motion) const {
  const int n = state_->balls();
  double z[padded];
  z[state_->machine.psi] = motion.psi;
  z[state_->machine.speed] = motion.psi_dot;
  z[state_->machine.error] = motion.speed_error_integral;
  const model::DrivePiece& p = state_->drive_at(piece);
  const double speed_now = p.driven() ? motion.psi_dot : p.motion(false).speed_at(t);
  equipoise::initial_state(motion, n, speed_now, z, state_->machine.tilt);
  if (pieces()[piece].held)
    for (int i = 0; i < n; ++i) z[model::index::q(i, n)] = 0.0;
  std::vector<double> y(static_cast<std::size_t>(dimension()));
  model::copy_state(state_->machine, z, state_->own, y.data());
  return y;
}

void StudyEquations::append(double t, const double* y, Trajectory& trajectory) const {
  const int n = state_->balls();
  double z[padded];
  state_->whole(piece_at(t), t, y, z);
  trajectory.phi.resize(static_cast<std::size_t>(n));
  trajectory.phi_dot.resize(static_cast<std::size_t>(n));
  record(trajectory, study().parameters, z[state_->machine.psi], z[state_->machine.speed], t, z);
}

}  // namespace equipoise

// A watch of lanes that gathers the statistics of transients. Included once per CPU target.
#if defined(EQUIPOISE_TRANSIENTS_WATCH_TRANSIENTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_TRANSIENTS_WATCH_TRANSIENTS_INL
#undef EQUIPOISE_TRANSIENTS_WATCH_TRANSIENTS_INL
#else
#define EQUIPOISE_TRANSIENTS_WATCH_TRANSIENTS_INL
#endif

#include <cstddef>
#include <optional>

#include "equipoise/batch/batch_watch-inl.hpp"
#include "equipoise/model/drive-inl.hpp"
#include "equipoise/model/energy-inl.hpp"
#include "equipoise/model/flow-inl.hpp"
#include "equipoise/model/stroboscopic_section.hpp"
#include "equipoise/model/unbalance-inl.hpp"
#include "equipoise/transients/gather_transients-inl.hpp"
#include "equipoise/types/transient_table.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

class WatchedRotor {
 public:
  WatchedRotor(const model::Parameters& p, const model::Segment& segment, const BatchTask& task,
               const model::System* system, const TransientSettings& settings)
      : limits(settings),
        balls_(p.balls),
        plain_(p),
        turning_(p),
        motion_(segment),
        energy_(p),
        speed_(segment.speed),
        acceleration_(segment.acceleration),
        begin_(segment.begin),
        curve_(segment.curve),
        rotor_(of_rotor(p)),
        turns_(model::depends_on_rotor_angle(p)),
        held_(task.held),
        psi_place_(task.layout().psi),
        speed_place_(task.layout().speed),
        sag_(model::static_sag(p)) {
    for (int i = 0; i < model::max_balls; ++i) mass_[i] = Pack(p.mass[i]);
    if (settings.work == WorkSource::motor) motor_.emplace(p, system->drive(), task.layout(), segment.begin, 0.0);
  }

  // Lane `lane` gets the rotor of `from`.
  void take_lane(const WatchedRotor& from, int lane) {
    using W = WatchedRotor;
    limits.take_lane(from.limits, lane);
    plain_.take_lane(from.plain_, lane);
    turning_.take_lane(from.turning_, lane);
    motion_.take_lane(from.motion_, lane);
    energy_.take_lane(from.energy_, lane);
    curve_.take_lane(from.curve_, lane);
    if (motor_) motor_->take_lane(*from.motor_, lane);
    take_lane_of(*this, from, lane, &W::speed_, &W::acceleration_, &W::begin_, &W::rotor_, &W::mass_, &W::sag_);
  }

  HWY_INLINE transient::Sample<Pack> sample(Pack t, const Pack* z) const {
    const RotorMotion<Pack> rotor = rotor_at(t, z);
    transient::Sample<Pack> here =
        turns_ ? transient::sample_of({sag_ * rotor.sin_psi, sag_ * rotor.cos_psi}, turning_.bearing_force(rotor, z), z)
               : transient::sample_of({Pack(0.0), Pack(0.0)}, plain_.bearing_force(rotor, z), z);
    if (motor_) {
      const MotorState<Pack> motor = motor_->motor(t, rotor, z);
      here.power = (motor.torque + motor.taken) * rotor.speed;
    } else if (limits.working) {
      here.power = energy_.taken_by_supports(rotor, z) + energy_.taken_by_drag(z);
    }
    return here;
  }

  HWY_INLINE Pack stored(Pack t, const Pack* z) const {
    return limits.working && !motor_ ? energy_.stored(rotor_at(t, z), z) : Pack(0.0);
  }

  HWY_INLINE Pack unbalance(const Pack* z) const {
    Vector2<Pack> all{rotor_.x + z[4], rotor_.y + z[5]};
    if (!held_) all = sum_of_unbalances(rotor_, balls_, mass_, z + 4);
    return square_root(all.x * all.x + all.y * all.y);
  }

  transient::Limits<Pack> limits;

 private:
  // Includes the unbalance of the balls' masses at the race's centre.
  static Vector2<Pack> of_rotor(const model::Parameters& p) {
    const double balls = p.total_mass();
    return {Pack(p.eccentricity + balls * p.race_offset[0]), Pack(balls * p.race_offset[1])};
  }

  // sin and cos of psi only if forces or sag depend on them.
  HWY_INLINE RotorMotion<Pack> rotor_at(Pack t, const Pack* z) const {
    RotorMotion<Pack> rotor{};
    if (turns_ && psi_place_ < 0) return motion_.at(t);
    if (turns_) sin_cos(z[psi_place_], rotor.sin_psi, rotor.cos_psi);
    rotor.speed = speed_place_ < 0 ? multiply_add(acceleration_, t - begin_, speed_) : z[speed_place_];
    if (speed_place_ < 0 && curve_.present()) rotor.speed = rotor.speed + curve_.speed(t - begin_);
    return rotor;
  }

  int balls_;
  // Used for forces alone, in which balls do not appear.
  BallBalancer<Pack, 1, paper_terms(false)> plain_;
  BallBalancer<Pack, 1, Terms{}> turning_;
  SegmentMotion<Pack, Terms{}> motion_;
  RotorEnergy<Pack> energy_;
  std::optional<RotorDrive<Pack>> motor_;
  Pack speed_, acceleration_, begin_;  // of the segment
  CurveMotion<Pack> curve_;
  Vector2<Pack> rotor_;
  Pack mass_[model::max_balls];
  bool turns_, held_;
  int psi_place_, speed_place_;
  Pack sag_;
};

// Rows keep growing from one task to the next. One code serves every rotor and number of balls: it runs once a step,
// the equations twelve times.
class WatchTransients final : public BatchWatch {
 public:
  WatchTransients(const BatchTask& task, TransientTable& table)
      : task_(task),
        table_(table),
        size_(task.dimension()),
        rotors_{rotor_of(task, table), rotor_of(task, table), rotor_of(task, table)} {
    static_assert(most_batch_groups == 3);
  }

  void begin(int slot, std::size_t start, double t, const double* state) override {
    start_[slot] = start;
    if (task_.own) {
      const OwnRotor& own = *task_.own[start];
      rotors_[slot / lanes].take_lane(
          {own.system.parameters(), own.segment, task_, &own.system, table_.settings_of(start)}, slot % lanes);
    }
    Group& group = groups_[slot / lanes];
    group.load(slot % lanes, table_.rows[start], !task_.held);
    group.resume(slot % lanes, table_.rows[start], t, corner_sample(slot, t, state));
    corner(slot, t, state);
    group.restart(slot % lanes, t);
  }

  void corner(int slot, double t, const double* state) override {
    Pack z[watched_state];
    spread(state, z);
    groups_[slot / lanes].stand(slot % lanes, corner_sample(slot, t, state),
                                transient::element(rotor(slot).unbalance(z), slot % lanes));
  }

  unsigned step(const TriedStep& s) override {
    const WatchedRotor& rotor = rotors_[s.group];
    const Pack begin = s.t - s.h;
    transient::Sample<Pack> at[3] = {rotor.sample(multiply_add(Pack(transient::node1), s.h, begin), s.first),
                                     rotor.sample(multiply_add(Pack(transient::node2), s.h, begin), s.second),
                                     rotor.sample(s.t, s.z)};
    at[2].stored = rotor.stored(s.t, s.z);
    return groups_[s.group].add(rotor.limits, s.active, s.accepted, begin, s.t, s.h, at, rotor.unbalance(s.z));
  }

  void end(int slot, std::size_t start, BatchEnd, double t) override {
    groups_[slot / lanes].store(slot % lanes, t, table_.rows[start], !task_.held);
  }

  void restart(int slot, double t) override {
    groups_[slot / lanes].restart(slot % lanes, t);
    groups_[slot / lanes].end_work(slot % lanes);
  }

  bool seen_enough(int slot, int attractor) const override {
    const Group& group = groups_[slot / lanes];
    const int lane = slot % lanes;
    return group.seen_enough(lane, table_.settings_of(start_[slot]), table_.end_of(attractor), group.peak(lane));
  }

 private:
  using Group = transient::GatherTransients<Pack>;
  static constexpr int lanes = Group::lanes;

  static WatchedRotor rotor_of(const BatchTask& task, const TransientTable& table) {
    return {*task.parameters, task.segment, task, task.system, table.settings};
  }
  const WatchedRotor& rotor(int slot) const { return rotors_[slot / lanes]; }

  void spread(const double* state, Pack* z) const {
    for (int i = 0; i < size_; ++i) z[i] = Pack(state[i]);
  }

  transient::Sample<double> corner_sample(int slot, double t, const double* state) const {
    Pack z[watched_state];
    spread(state, z);
    const transient::Sample<Pack> here = rotor(slot).sample(Pack(t), z);
    const auto own = [&](const Pack& p) { return transient::element(p, slot % lanes); };
    return {own(here.r2),        own(here.slope), own(here.force2),
            own(here.velocity2), own(here.power), own(rotor(slot).stored(Pack(t), z))};
  }

  const BatchTask& task_;
  TransientTable& table_;
  const int size_;
  WatchedRotor rotors_[most_batch_groups];  // a group of lanes each
  Group groups_[most_batch_groups];
  std::size_t start_[most_batch_groups * lanes] = {};
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif

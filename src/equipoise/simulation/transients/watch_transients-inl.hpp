// A watch of lanes that gathers the statistics of transients. Included once per CPU target.
#if defined(EQUIPOISE_TRANSIENTS_WATCH_TRANSIENTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_TRANSIENTS_WATCH_TRANSIENTS_INL
#undef EQUIPOISE_TRANSIENTS_WATCH_TRANSIENTS_INL
#else
#define EQUIPOISE_TRANSIENTS_WATCH_TRANSIENTS_INL
#endif

#include <cstddef>
#include <optional>
#include <span>

#include "equipoise/simulation/batch/batch_watch-inl.hpp"
#include "equipoise/machine/model/equation_terms-inl.hpp"
#include "equipoise/machine/balance/tolerance_planes.hpp"
#include "equipoise/machine/model/drive-inl.hpp"
#include "equipoise/machine/model/energy-inl.hpp"
#include "equipoise/machine/model/flow-inl.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/simulation/transients/gather_transients-inl.hpp"
#include "equipoise/results/types/transient_table.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// What a tilting rotor has in addition: where its watched sections are, and how it loads its supports.
template <bool tilt>
class WatchedTilt {
 public:
  WatchedTilt(const model::Parameters&, int, const TransientSettings&) {}
  void take_lane(const WatchedTilt&, int) {}
};
template <>
class WatchedTilt<true> {
 public:
  // `place`: of the slope in the state.
  WatchedTilt(const model::Parameters& p, int place, const TransientSettings& settings)
      : place_(place),
        supports_(p, place),
        energy_(p, place),
        slope_(model::static_slope(p)),
        at_{Pack(settings.shaft.places[0]), Pack(settings.shaft.places[1])},
        bearing_count_(static_cast<int>(settings.shaft.bearings.size())) {
    const auto planes = model::plane_unbalances(p, settings.shaft.places);
    for (std::size_t k = 0; k < planes.size(); ++k) {
      planes_.own[k] = {Pack(planes[k].own.real()), Pack(planes[k].own.imag())};
      for (std::size_t i = 0; i < planes[k].ball.size(); ++i) planes_.ball[k][i] = Pack(planes[k].ball[i]);
    }
    for (Pack& load : load_) load = Pack(-model::total_weight(p));
    for (int k = 0; k < bearing_count_; ++k) {
      const model::Bearing& bearing = settings.shaft.bearings[static_cast<std::size_t>(k)];
      at_[k] = Pack(bearing.at);
      load_[k] = Pack(model::load_at_rest(p, bearing));
      bearings_[k] = BearingForce<Pack>(bearing);
    }
  }

  int places() const { return bearing_count_ > 2 ? bearing_count_ : 2; }

  void take_lane(const WatchedTilt& from, int lane) {
    supports_.take_lane(from.supports_, lane);
    energy_.take_lane(from.energy_, lane);
    for (int k = 0; k < bearing_count_; ++k) bearings_[k].take_lane(from.bearings_[k], lane);
    take_lane_of(*this, from, lane, &WatchedTilt::slope_, &WatchedTilt::at_, &WatchedTilt::load_,
                 &WatchedTilt::planes_);
  }

  // Section k. `sag`: where the centre rests; `force`: on the supports, for the centre's motion alone.
  HWY_INLINE transient::Sample<Pack> sample(int k, const RotorMotion<Pack>& rotor, const Pack& sag,
                                            const Vector2<Pack>& force, const Pack* z) const {
    const Pack *tilt = z + place_, &at = at_[k], rest = sag + at * slope_;
    const Pack section[4] = {z[0] + at * tilt[0], z[1] + at * tilt[1], z[2] + at * tilt[2], z[3] + at * tilt[3]};
    const Vector2<Pack> up{rotor.sin_psi, rotor.cos_psi};
    const Vector2<Pack> at_rest{load_[k] * up.x, load_[k] * up.y};
    if (bearing_count_ > 0) return transient::sample_of(up, rest, at_rest, bearings_[k].of(rotor, section), section);
    Vector2<Pack> all = force;
    Vector2<Pack> more{Pack(0.0), Pack(0.0)};
    supports_.add_supports(rotor, z, more);
    all = {all.x + more.x, all.y + more.y};
    return transient::sample_of(up, rest, at_rest, all, section);
  }
  HWY_INLINE Pack taken_by_supports(const RotorMotion<Pack>& rotor, const Pack* z) const {
    return energy_.taken_by_supports(rotor, z);
  }
  HWY_INLINE Pack stored(const RotorMotion<Pack>& rotor, const Pack* z) const { return energy_.stored(rotor, z); }
  // In both planes.
  HWY_INLINE transient::Unbalances<Pack, 4> unbalance(int balls, const Pack* phi) const {
    Vector2<Pack> a = planes_.own[0], b = planes_.own[1];
    const auto& [of_a, of_b] = planes_.ball;
    for (int i = 0; i < balls; ++i) {
      Pack sine, cosine;
      sin_cos(phi[i], sine, cosine);
      a = {multiply_add(of_a[i], cosine, a.x), multiply_add(of_a[i], sine, a.y)};
      b = {multiply_add(of_b[i], cosine, b.x), multiply_add(of_b[i], sine, b.y)};
    }
    return {{a.x, a.y, b.x, b.y}};
  }

 private:
  int place_;
  TiltConstants<Pack, 1> supports_;
  TiltEnergy<Pack> energy_;
  Pack slope_;  // where the rotor rests
  Pack at_[model::most_bearings], load_[model::most_bearings];
  int bearing_count_;
  BearingForce<Pack> bearings_[model::most_bearings];
  struct {
    Vector2<Pack> own[2];
    Pack ball[2][model::max_balls];
  } planes_;  // of plane_unbalances()
};

template <bool tilt>
class WatchedRotor {
 public:
  static constexpr int places = tilt ? 2 : 1;  // that are watched always
  static constexpr int most_places = tilt ? static_cast<int>(model::most_bearings) : 1;

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
        sag_(model::static_sag(p)),
        load_(-model::total_weight(p)),
        tilt_(p, task.layout().tilt, settings) {
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
    tilt_.take_lane(from.tilt_, lane);
    curve_.take_lane(from.curve_, lane);
    if (motor_) motor_->take_lane(*from.motor_, lane);
    take_lane_of(*this, from, lane, &W::speed_, &W::acceleration_, &W::begin_, &W::rotor_, &W::mass_, &W::sag_,
                 &W::load_);
  }

  int all_places() const {
    if constexpr (tilt) return tilt_.places();
    return places;
  }

  // At each place that is watched always.
  HWY_INLINE void sample(Pack t, const Pack* z, transient::Sample<Pack> (&here)[places]) const {
    const RotorMotion<Pack> rotor = rotor_at(t, z);
    if constexpr (tilt) {
      const Vector2<Pack> force = turning_.bearing_force(rotor, z);
      for (int k = 0; k < places; ++k) here[k] = tilt_.sample(k, rotor, sag_, force, z);
    } else {
      here[0] = turns_ ? transient::sample_of({rotor.sin_psi, rotor.cos_psi}, sag_,
                                              {load_ * rotor.sin_psi, load_ * rotor.cos_psi},
                                              turning_.bearing_force(rotor, z), z)
                       : transient::sample_of(plain_.bearing_force(rotor, z), z);
    }
    for (transient::Sample<Pack>& place : here) place.speed = rotor.speed;
    if (motor_) {
      const MotorState<Pack> motor = motor_->motor(t, rotor, z);
      here[0].power = (motor.torque + motor.taken) * rotor.speed;
    } else if (limits.working) {
      here[0].power = taken_by_supports(rotor, z) + energy_.taken_by_drag(z);
    }
  }

  // At place k, one of the further bearings.
  HWY_INLINE transient::Sample<Pack> further_sample(int k, Pack t, const Pack* z) const {
    const RotorMotion<Pack> rotor = rotor_at(t, z);
    transient::Sample<Pack> here = tilt_.sample(k, rotor, sag_, {Pack(0.0), Pack(0.0)}, z);
    here.speed = rotor.speed;
    return here;
  }

  HWY_INLINE Pack stored(Pack t, const Pack* z) const {
    if (!limits.working || motor_) return Pack(0.0);
    if constexpr (tilt)
      return tilt_.stored(rotor_at(t, z), z);
    else
      return energy_.stored(rotor_at(t, z), z);
  }

  HWY_INLINE transient::Unbalances<Pack, tilt ? 4 : 2> unbalance(const Pack* z) const {
    if constexpr (tilt) {
      return tilt_.unbalance(balls_, z + 4);
    } else {
      Vector2<Pack> all{rotor_.x + z[4], rotor_.y + z[5]};
      if (!held_) all = sum_of_unbalances(rotor_, balls_, mass_, z + 4);
      return {{all.x, all.y}};
    }
  }

  transient::Limits<Pack> limits;

 private:
  HWY_INLINE Pack taken_by_supports(const RotorMotion<Pack>& rotor, const Pack* z) const {
    if constexpr (tilt)
      return tilt_.taken_by_supports(rotor, z);
    else
      return energy_.taken_by_supports(rotor, z);
  }

  // Of a rotor in a plane; includes the unbalance of the balls' masses at the race's centre.
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
  Pack sag_, load_;
  [[no_unique_address]] WatchedTilt<tilt> tilt_;
};

// Rows keep growing from one task to the next. One code serves every rotor and number of balls: it runs once a step,
// the equations twelve times.
template <bool tilt>
class WatchTransients final : public BatchWatch {
  using Rotor = WatchedRotor<tilt>;
  static constexpr int places = Rotor::places;
  using Group = transient::GatherPlaces<Pack, Rotor::most_places, tilt ? 4 : 2>;
  static constexpr int lanes = Group::lanes;

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
    transient::Sample<double> here[Rotor::most_places];
    corner_sample(slot, t, state, here);
    group.resume(slot % lanes, table_.rows[start], t, here[0]);
    corner(slot, t, state);
    group.restart(slot % lanes, t);
  }

  void corner(int slot, double t, const double* state) override {
    Pack z[watched_state];
    spread(state, z);
    transient::Sample<double> here[Rotor::most_places];
    corner_sample(slot, t, state, here);
    TurningUnbalance unbalance{};
    const auto all = rotor(slot).unbalance(z);
    std::size_t k = 0;
    for (const Pack& part : all.part) unbalance[k++] = transient::element(part, slot % lanes);
    groups_[slot / lanes].stand(slot % lanes, t, std::span(here, static_cast<std::size_t>(rotor(slot).all_places())),
                                unbalance);
  }

  unsigned step(const TriedStep& s) override {
    const Rotor& rotor = rotors_[s.group];
    const Pack begin = s.t - s.h;
    transient::Sample<Pack> one[places], two[places], three[places];
    rotor.sample(multiply_add(Pack(transient::node1), s.h, begin), s.first, one);
    rotor.sample(multiply_add(Pack(transient::node2), s.h, begin), s.second, two);
    rotor.sample(s.t, s.z, three);
    const transient::Sample<Pack> at[3] = {one[0], two[0], with_stored(three[0], rotor.stored(s.t, s.z))};
    Group& group = groups_[s.group];
    const auto unbalance = rotor.unbalance(s.z);
    if constexpr (tilt) {
      const transient::Sample<Pack> there[3] = {one[1], two[1], three[1]};
      const unsigned full = group.add(rotor.limits, s.active, s.accepted, begin, s.t, s.h, at, there, unbalance);
      for (int k = places; k < rotor.all_places(); ++k) {
        const transient::Sample<Pack> further[3] = {
            rotor.further_sample(k, multiply_add(Pack(transient::node1), s.h, begin), s.first),
            rotor.further_sample(k, multiply_add(Pack(transient::node2), s.h, begin), s.second),
            rotor.further_sample(k, s.t, s.z)};
        group.add_place(k, rotor.limits, s.active, s.accepted, begin, s.t, s.h, further, unbalance);
      }
      return full;
    } else {
      return group.add(rotor.limits, s.active, s.accepted, begin, s.t, s.h, at, unbalance);
    }
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
  static Rotor rotor_of(const BatchTask& task, const TransientTable& table) {
    return {*task.parameters, task.segment, task, task.system, table.settings};
  }
  const Rotor& rotor(int slot) const { return rotors_[slot / lanes]; }

  void spread(const double* state, Pack* z) const {
    for (int i = 0; i < size_; ++i) z[i] = Pack(state[i]);
  }

  static HWY_INLINE transient::Sample<Pack> with_stored(transient::Sample<Pack> here, const Pack& stored) {
    here.stored = stored;
    return here;
  }

  void corner_sample(int slot, double t, const double* state,
                     transient::Sample<double> (&here)[Rotor::most_places]) const {
    Pack z[watched_state];
    spread(state, z);
    transient::Sample<Pack> all[places];
    rotor(slot).sample(Pack(t), z, all);
    all[0].stored = rotor(slot).stored(Pack(t), z);
    const auto own = [&](const Pack& p) { return transient::element(p, slot % lanes); };
    const auto put = [&](int k, const transient::Sample<Pack>& s) {
      here[k] = {own(s.r2),       own(s.slope), own(s.force2), own(s.velocity2), own(s.dynamic2),
                 own(s.upright2), own(s.power), own(s.stored), own(s.speed)};
    };
    for (int k = 0; k < places; ++k) put(k, all[k]);
    if constexpr (tilt)
      for (int k = places; k < rotor(slot).all_places(); ++k) put(k, rotor(slot).further_sample(k, Pack(t), z));
  }

  const BatchTask& task_;
  TransientTable& table_;
  const int size_;
  Rotor rotors_[most_batch_groups];  // a group of lanes each
  Group groups_[most_batch_groups];
  std::size_t start_[most_batch_groups * lanes] = {};
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif

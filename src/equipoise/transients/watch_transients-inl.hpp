// A watch of lanes that gathers the statistics of transients. Included once per CPU target.
#if defined(EQUIPOISE_TRANSIENTS_WATCH_TRANSIENTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_TRANSIENTS_WATCH_TRANSIENTS_INL
#undef EQUIPOISE_TRANSIENTS_WATCH_TRANSIENTS_INL
#else
#define EQUIPOISE_TRANSIENTS_WATCH_TRANSIENTS_INL
#endif

#include <cstddef>
#include <optional>

#include "equipoise/lanes/lane_watch-inl.hpp"
#include "equipoise/model/drive-inl.hpp"
#include "equipoise/model/energy-inl.hpp"
#include "equipoise/model/flow-inl.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/model/unbalance-inl.hpp"
#include "equipoise/transients/gather_transients-inl.hpp"
#include "equipoise/transients/transient_table.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// The rows of the table go on growing from one task to the next. One code for every rotor and any number of balls: it
// runs once a step, where the equations run twelve times.
class WatchTransients final : public LaneWatch {
 public:
  WatchTransients(const LaneTask& task, TransientTable& table)
      : balls_(task.parameters->balls),
        plain_(*task.parameters),
        turning_(*task.parameters),
        motion_(task.segment),
        segment_(task.segment),
        energy_(*task.parameters),
        table_(table),
        limits_(table.settings),
        rotor_(of_rotor(*task.parameters)),
        turns_(model::is_strobed(*task.parameters)),
        held_(task.held),
        size_(task.dimension()),
        psi_place_(task.psi_place()),
        speed_place_(task.speed_place()),
        sag_(model::static_sag(*task.parameters)) {
    for (int i = 0; i < balls_; ++i) mass_[i] = Pack(task.parameters->mass[i]);
    if (table.settings.work == WorkSource::motor)
      motor_.emplace(*task.parameters, task.system->drive(), task.places(), task.segment.begin, 0.0);
  }

  void begin(int slot, std::size_t start, double t, const double* state) override {
    Group& group = groups_[slot / lanes];
    group.load(slot % lanes, table_.rows[start], !held_);
    group.resume(slot % lanes, table_.rows[start], t, corner_sample(t, state));
    corner(slot, t, state);
    group.restart(slot % lanes, t);
  }

  void corner(int slot, double t, const double* state) override {
    Pack z[watched_state];
    spread(state, z);
    groups_[slot / lanes].stand(slot % lanes, corner_sample(t, state), transient::element(unbalance(z), 0));
  }

  unsigned step(const TriedStep& s) override {
    const Pack begin = s.t - s.h;
    transient::Sample<Pack> at[3] = {sample(multiply_add(Pack(transient::node1), s.h, begin), s.first),
                                     sample(multiply_add(Pack(transient::node2), s.h, begin), s.second),
                                     sample(s.t, s.z)};
    at[2].stored = stored(s.t, s.z);
    return groups_[s.group].add(limits_, s.active, s.accepted, begin, s.t, s.h, at, unbalance(s.z));
  }

  void end(int slot, std::size_t start, LaneEnd, double t) override {
    groups_[slot / lanes].store(slot % lanes, t, table_.rows[start], !held_);
  }

  void restart(int slot, double t) override {
    groups_[slot / lanes].restart(slot % lanes, t);
    groups_[slot / lanes].end_work(slot % lanes);
  }

  bool seen_enough(int slot, int attractor) const override {
    const Group& group = groups_[slot / lanes];
    const int lane = slot % lanes;
    return group.seen_enough(lane, table_.settings, table_.end_of(attractor), group.peak(lane));
  }

 private:
  using Group = transient::GatherTransients<Pack>;
  static constexpr int lanes = Group::lanes;

  // With that of the balls' masses where they have the race's centre.
  static Vector2<Pack> of_rotor(const model::Parameters& p) {
    const double balls = p.total_mass();
    return {Pack(p.eccentricity + balls * p.race_offset[0]), Pack(balls * p.race_offset[1])};
  }

  void spread(const double* state, Pack* z) const {
    for (int i = 0; i < size_; ++i) z[i] = Pack(state[i]);
  }

  transient::Sample<double> corner_sample(double t, const double* state) const {
    Pack z[watched_state];
    spread(state, z);
    const transient::Sample<Pack> here = sample(Pack(t), z);
    const auto first = [](const Pack& p) { return transient::element(p, 0); };
    return {first(here.r2),        first(here.slope), first(here.force2),
            first(here.velocity2), first(here.power), first(stored(Pack(t), z))};
  }

  // Speed always; sin and cos of psi where they are asked for: the force of isotropic supports does not ask where the
  // rotor points, and only gravity lets it sag.
  HWY_INLINE RotorMotion<Pack> rotor_at(Pack t, const Pack* z) const {
    RotorMotion<Pack> rotor{};
    if (turns_ && psi_place_ < 0) return motion_.at(t);
    if (turns_) sin_cos(z[psi_place_], rotor.sin_psi, rotor.cos_psi);
    rotor.speed = speed_place_ < 0
                      ? multiply_add(Pack(segment_.acceleration), t - Pack(segment_.begin), Pack(segment_.speed))
                      : z[speed_place_];
    return rotor;
  }

  HWY_INLINE transient::Sample<Pack> sample(Pack t, const Pack* z) const {
    const RotorMotion<Pack> rotor = rotor_at(t, z);
    transient::Sample<Pack> here =
        turns_ ? transient::sample_of({sag_ * rotor.sin_psi, sag_ * rotor.cos_psi}, turning_.bearing_force(rotor, z), z)
               : transient::sample_of({Pack(0.0), Pack(0.0)}, plain_.bearing_force(rotor, z), z);
    if (motor_)
      here.power = motor_->motor(t, rotor, z).torque * rotor.speed;
    else if (limits_.working)
      here.power = energy_.taken_by_supports(rotor, z) + energy_.taken_by_drag(z);
    return here;
  }

  HWY_INLINE Pack stored(Pack t, const Pack* z) const {
    return limits_.working && !motor_ ? energy_.stored(rotor_at(t, z), z) : Pack(0.0);
  }

  HWY_INLINE Pack unbalance(const Pack* z) const {
    Vector2<Pack> all{rotor_.x + z[4], rotor_.y + z[5]};
    if (!held_) all = sum_of_unbalances(rotor_, balls_, mass_, z + 4);
    return square_root(all.x * all.x + all.y * all.y);
  }

  const int balls_;
  // Asked for forces alone, in which balls do not appear.
  const BallBalancer<Pack, 1, paper_terms(false)> plain_;
  const BallBalancer<Pack, 1, Terms{}> turning_;
  const SegmentMotion<Pack, Terms{}> motion_;
  const model::Segment segment_;
  const RotorEnergy<Pack> energy_;
  std::optional<RotorDrive<Pack>> motor_;
  TransientTable& table_;
  const transient::Limits<Pack> limits_;
  const Vector2<Pack> rotor_;
  Pack mass_[model::max_balls];
  const bool turns_, held_;
  const int size_, psi_place_, speed_place_;
  const Pack sag_;
  Group groups_[most_lane_groups];
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif

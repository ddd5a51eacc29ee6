// A watch of lanes that gathers the statistics of transients. Included once per CPU target.
#if defined(EQUIPOISE_TRANSIENTS_WATCH_TRANSIENTS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_TRANSIENTS_WATCH_TRANSIENTS_INL
#undef EQUIPOISE_TRANSIENTS_WATCH_TRANSIENTS_INL
#else
#define EQUIPOISE_TRANSIENTS_WATCH_TRANSIENTS_INL
#endif

#include <cstddef>

#include "equipoise/lanes/lane_watch-inl.hpp"
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
        table_(table),
        limits_(table.settings),
        rotor_(of_rotor(*task.parameters)),
        turns_(model::is_strobed(*task.parameters)),
        held_(task.held),
        size_(task.dimension()),
        psi_place_(task.psi_place()),
        sag_(model::static_sag(*task.parameters)) {
    for (int i = 0; i < balls_; ++i) mass_[i] = Pack(task.parameters->mass[i]);
  }

  void begin(int slot, std::size_t start, double t, const double* state) override {
    Group& group = groups_[slot / lanes];
    group.load(slot % lanes, table_.rows[start], !held_);
    corner(slot, t, state);
    group.restart(slot % lanes, t);
  }

  void corner(int slot, double t, const double* state) override {
    Pack z[model::dimension(model::max_balls) + 3];
    for (int i = 0; i < size_; ++i) z[i] = Pack(state[i]);
    const transient::Sample<Pack> here = sample(Pack(t), z, psi_place_);
    groups_[slot / lanes].stand(slot % lanes,
                                {transient::element(here.r2, 0), transient::element(here.slope, 0),
                                 transient::element(here.force2, 0), transient::element(here.velocity2, 0)},
                                transient::element(unbalance(z), 0));
  }

  unsigned step(const TriedStep& s) override {
    const Pack begin = s.t - s.h;
    const transient::Sample<Pack> at[3] = {sample(multiply_add(Pack(transient::node1), s.h, begin), s.first, 4),
                                           sample(multiply_add(Pack(transient::node2), s.h, begin), s.second, 4),
                                           sample(s.t, s.z, psi_place_)};
    return groups_[s.group].add(limits_, s.active, s.accepted, begin, s.t, s.h, at, unbalance(s.z));
  }

  void end(int slot, std::size_t start, LaneEnd, double t) override {
    groups_[slot / lanes].store(slot % lanes, t, table_.rows[start], !held_);
  }

  void restart(int slot, double t) override { groups_[slot / lanes].restart(slot % lanes, t); }

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

  // The force of isotropic supports does not ask where the rotor points, and only gravity lets it sag. `psi`: the place
  // of the angle, where states have one.
  HWY_INLINE transient::Sample<Pack> sample(Pack t, const Pack* z, int psi) const {
    if (!turns_) {
      const RotorMotion<Pack> unasked{};
      return transient::sample_of({Pack(0.0), Pack(0.0)}, plain_.bearing_force(unasked, z), z);
    }
    RotorMotion<Pack> rotor;
    if (psi_place_ < 0)
      rotor = motion_.at(t);
    else
      sin_cos(z[psi], rotor.sin_psi, rotor.cos_psi);
    return transient::sample_of({sag_ * rotor.sin_psi, sag_ * rotor.cos_psi}, turning_.bearing_force(rotor, z), z);
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
  TransientTable& table_;
  const transient::Limits<Pack> limits_;
  const Vector2<Pack> rotor_;
  Pack mass_[model::max_balls];
  const bool turns_, held_;
  const int size_, psi_place_;
  const Pack sag_;
  Group groups_[most_lane_groups];
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif

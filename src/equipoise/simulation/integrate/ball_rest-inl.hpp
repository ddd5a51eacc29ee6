// Which balls of a touching row at rest dry friction keeps at rest. Included once per CPU target.
#if defined(EQUIPOISE_INTEGRATE_BALL_REST_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_INTEGRATE_BALL_REST_INL
#undef EQUIPOISE_INTEGRATE_BALL_REST_INL
#else
#define EQUIPOISE_INTEGRATE_BALL_REST_INL
#endif

#include "equipoise/core/base/pack-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// A row of touching balls at rest, added from behind. A ball's own friction and its neighbours, which push but cannot
// pull, take up the force on it. The row splits into groups that stay or go as one: a group that would run into the one
// ahead is pooled with it. The accelerations then grow along the row and are the closest to those that force less
// friction would give each ball (docs/explanation/equations.md, "Contact and friction together").
template <int room>
class RestingRow {
 public:
  struct Group {
    int first, last;  // places in the row
    double force, hold, mass;

    // Acceleration: what friction leaves of the force, over the mass.
    double goes() const {
      const double left = force > hold ? force - hold : force < -hold ? force + hold : 0.0;
      return left / mass;
    }
  };

  // Adds the next ball ahead. `force`: on it along the race; `hold`: the most that friction takes up.
  void add(double force, double hold, double mass) {
    groups_[size_++] = {balls_, balls_, force, hold, mass};
    ++balls_;
    while (size_ > 1 && groups_[size_ - 2].goes() > groups_[size_ - 1].goes()) {
      Group& behind = groups_[size_ - 2];
      const Group& ahead = groups_[size_ - 1];
      behind = {behind.first, ahead.last, behind.force + ahead.force, behind.hold + ahead.hold,
                behind.mass + ahead.mass};
      --size_;
    }
  }

  int groups() const { return size_; }
  const Group& group(int g) const { return groups_[g]; }

 private:
  Group groups_[room];
  int size_ = 0, balls_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif

// Which parameters the two keys are, and the subdivision.
#include "equipoise/extras/curves/curve_starts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <vector>

#include "equipoise/extras/proof/balance_boxes.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise {

namespace {

constexpr std::size_t parameters_of_proof = 7;
using ProofParameters = std::array<double, parameters_of_proof>;

ProofParameters parameters_of(const Study& study) {
  const model::Parameters& p = study.parameters;
  return {study.system().speed(), p.damping[0], p.stiffness[0], p.drag[0], p.eccentricity, p.mass[0], p.mass[1]};
}

bool can_be_proved(const Study& study) {
  const model::Parameters& p = study.parameters;
  const model::System system = study.system();
  return system.plain() && system.smooth() && p.isotropic() && p.gravity == 0.0 && p.balls == 2 && !p.rolls &&
         p.drag[0] == p.drag[1];
}

// By which coordinate each parameter varies: 0, 1, or neither.
using Coordinates = std::array<std::optional<int>, parameters_of_proof>;

// A key is a parameter if its value is that parameter's at each of many places, to the bit, and no other parameter's
// changes.
std::optional<Coordinates> coordinates_of(const PlaneStudies& studies, const StabilityPlane& plane) {
  constexpr int looks = 7;
  const auto part = [](const SliceAxis& axis, int k) { return axis.low + (axis.high - axis.low) * (k + 0.5) / looks; };
  const ProofParameters first = parameters_of(studies.at(part(plane.x, 0), part(plane.y, 0)));
  Coordinates result;
  for (int i = 0; i < looks; ++i)
    for (int k = 0; k < looks; ++k) {
      const double x = part(plane.x, i), y = part(plane.y, k);
      const Study study = studies.at(x, y);
      if (!can_be_proved(study)) return std::nullopt;
      const ProofParameters here = parameters_of(study);
      for (std::size_t n = 0; n < here.size(); ++n) {
        if (i == 0 && k == 0) continue;
        if (here[n] != first[n] && !result[n]) result[n] = k == 0 ? 0 : 1;
        if (result[n] ? here[n] != (*result[n] == 0 ? x : y) : here[n] != first[n]) return std::nullopt;
      }
    }
  return result;
}

BoxNumber over(const std::array<double, 2>& range, int coordinate) {
  const Interval interval(range[0], range[1]);
  BoxNumber number(interval.middle());
  number.slope[coordinate] = interval.radius();
  return number;
}

class BoxSearch {
 public:
  BoxSearch(const ProofParameters& fixed, const Coordinates& coordinates, const StabilityPlane& plane)
      : fixed_(fixed), coordinates_(coordinates), plane_(plane) {}

  void run(std::uint64_t most, double undecided, const StopFlag* stop, std::vector<ProofBox>& decided) {
    open_.push({{{plane_.x.low, plane_.x.high}, {plane_.y.low, plane_.y.high}}, 1.0, 0});
    double open_part = 1.0;
    for (std::uint64_t judged = 0; judged < most && open_part > undecided && !open_.empty() && !is_set(stop);
         ++judged) {
      OpenBox box = open_.top();
      open_.pop();
      box.box.kind = judged_kind(box.box);
      if (box.box.kind != BalanceKind::open) {
        decided.push_back(box.box);
        open_part -= box.part;
        continue;
      }
      OpenBox low = box, high = box;
      auto &below = splits_x(box.box) ? low.box.x : low.box.y, &above = splits_x(box.box) ? high.box.x : high.box.y;
      below[1] = above[0] = 0.5 * (below[0] + below[1]);
      low.part = high.part = 0.5 * box.part;
      low.number = ++last_;
      high.number = ++last_;
      open_.push(low);
      open_.push(high);
    }
    for (; !open_.empty(); open_.pop()) decided.push_back(open_.top().box);
  }

 private:
  struct OpenBox {
    ProofBox box;
    double part;           // of the plane
    std::uint64_t number;  // the order of equally large ones does not depend on the queue
    bool operator<(const OpenBox& other) const {
      return part != other.part ? part < other.part : number > other.number;
    }
  };

  BalanceKind judged_kind(const ProofBox& box) const {
    const auto number = [&](std::size_t n) {
      if (!coordinates_[n]) return BoxNumber(fixed_[n]);
      return over(*coordinates_[n] == 0 ? box.x : box.y, *coordinates_[n]);
    };
    BoxRotor rotor{number(0), number(1), number(2), number(3), number(4), {number(5), number(6)}};
    if (rotor.speed.centre < 0.0) rotor.speed = -rotor.speed;  // seen in a mirror
    return judge_box(rotor);
  }

  // The longer side, as a part of the plane's; of a box that holds a standing rotor the speed.
  bool splits_x(const ProofBox& box) const {
    if (coordinates_[0]) {
      const auto& range = *coordinates_[0] == 0 ? box.x : box.y;
      if (range[0] <= 0.0 && range[1] >= 0.0) return *coordinates_[0] == 0;
    }
    return (box.x[1] - box.x[0]) / (plane_.x.high - plane_.x.low) >=
           (box.y[1] - box.y[0]) / (plane_.y.high - plane_.y.low);
  }

  ProofParameters fixed_;
  Coordinates coordinates_;
  const StabilityPlane& plane_;
  std::priority_queue<OpenBox> open_;
  std::uint64_t last_ = 0;
};

}  // namespace

void add_proof_boxes(const PlaneStudies& studies, std::uint64_t most, double undecided, const StopFlag* stop,
                     BifurcationChart& chart) {
  const StabilityPlane& plane = chart.plane;
  const Study study = studies.at(plane.x.centre(0), plane.y.centre(0));
  if (!can_be_proved(study)) {
    chart.not_proved =
        "proofs are of two balls with equal drag that slide freely in a centred race, at a prescribed speed and "
        "without tilt";
    return;
  }
  const auto coordinates = coordinates_of(studies, plane);
  if (!coordinates) {
    chart.not_proved = "a key of the axes is not itself a parameter of the equations";
    return;
  }
  BoxSearch(parameters_of(study), *coordinates, plane).run(most, undecided, stop, chart.boxes);
}

}  // namespace equipoise

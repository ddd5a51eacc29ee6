// Trapping regions around attracting tori: a cloud of states on a torus, and tangent planes there.
#include "equipoise/classification/trapping_regions/window_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "equipoise/attractors/motions/motion_statistics.hpp"
#include "equipoise/attractors/motions/motion_symmetry.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/orders.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"

namespace equipoise {

namespace {

using Eigen::VectorXd;

// States are about 0.05 rad apart in either direction of the torus, whose curvature leaves 1e-3.
constexpr int cloud = 16384, fresh = 512;
constexpr double torus_tolerance = 1e-7;  // the torus attracts, so errors of steps do not add up
// Of a cell's width: states further off a plane lie on another sheet, or the torus bends too much for one plane. V of
// states on V2 at Omega = 2.4 is then at most 6e-5; with a fifth, 2e-4.
constexpr double bent = 0.1;
// Trials begin at a distance of one half at most. A floor above highest_torus_floor leaves no room for a level.
constexpr double highest_torus_level = 0.25, highest_torus_floor = 1e-3;
constexpr double come_close_to_torus = 1e-2;

// Every state is compared with the torus in all of them.
constexpr std::size_t most_torus_places = 720;

double within_a_turn(double angle) { return angle - two_pi * std::floor(angle / two_pi); }

// Difference of two angles within a turn, the shorter way.
double shorter_way(double d) { return d > pi ? d - two_pi : d < -pi ? d + two_pi : d; }

// States along one trajectory that winds densely around a torus, sorted into cells by the angles of the first two balls
// (with one ball: by its angle). One of them stands for each cell, or one for each sheet of the torus above it. V of a
// state is the square of its distance, in System::scale(), from the nearest tangent plane there.
class TorusRegion final : public WindowRegion {
 public:
  // Empty if the trajectory is lost, or a fresh one does not lie on the cloud: it winds around no torus, or the cloud
  // is too thin; or if alike balls have too many places to compare every state with all.
  static std::shared_ptr<TorusRegion> around(const model::System& system, const Motion& motion, int attractor,
                                             const StopFlag* stop) {
    std::shared_ptr<TorusRegion> region(new TorusRegion(system, attractor));
    region->rate_ = motion.exponents[2];
    VectorXd state = motion.state;
    const double spacing = sample_spacing(system, state);
    std::vector<VectorXd> samples;
    if (follow(system, state, spacing * (cloud + fresh), torus_tolerance, nullptr, &samples, stop) !=
            IntegrationStatus::done ||
        samples.size() < static_cast<std::size_t>(cloud + fresh))
      return nullptr;
    region->states_.resize(state.size(), cloud);
    for (int k = 0; k < cloud; ++k) {
      region->hold(samples[k]);
      VectorXd s = samples[k];
      for (int i = 0; i < system.balls(); ++i) s[model::index::phi(i)] = within_a_turn(s[model::index::phi(i)]);
      region->states_.col(k) = s.cwiseProduct(region->inverse_scale_);
    }
    region->sort_into_cells();
    region->find_tangents(system, stop);
    region->make_patches(stop);
    if (is_set(stop) || !region->find_images(system, motion)) return nullptr;
    for (int k = 0; k < fresh; ++k) region->floor_ = std::max(region->floor_, region->value(samples[cloud + k].data()));
    return region->floor_ < highest_torus_floor ? region : nullptr;
  }

  // Next to state `which` of the cloud.
  VectorXd state_on_level(std::size_t which, double level, const VectorXd& direction,
                          const OwnRotor* /*own*/) const override {
    const auto k = static_cast<Eigen::Index>(which) % states_.cols();
    VectorXd d = direction;
    const VectorXd along = tangents_.col(k).head(d.size()), across = tangents_.col(k).tail(d.size());
    d -= along * along.dot(d);
    d -= across * across.dot(d);
    return (states_.col(k) + std::sqrt(level) * d.normalized()).cwiseQuotient(inverse_scale_);
  }

 private:
  TorusRegion(const model::System& system, int attractor) : WindowRegion(system, attractor) {}

  // A row of cells for the first, a cell in it for the second; with one ball there is one row.
  using Angles = std::array<double, 2>;
  Angles angles_of(const double* state) const {
    const double* const phi = state + model::index::phi(0);
    return balls_ > 1 ? Angles{phi[0], phi[1]} : Angles{0.0, phi[0]};
  }

  int cell_of(const Angles& angles) const {
    const auto place = [&](double angle) {
      return std::min(cells_ - 1, static_cast<int>(within_a_turn(angle) / two_pi * cells_));
    };
    return place(angles[0]) * cells_ + place(angles[1]);
  }

  // Calls f(number) for all states of the cells around a pair of angles.
  template <class F>
  void around_angles(const Angles& angles, F&& f) const {
    const int rows = cell_rows_, cell = cell_of(angles), row = cell / cells_, place = cell % cells_;
    const auto all_in = [&](int begin, int end) {
      for (int k = first_in_cell_[begin]; k < first_in_cell_[end]; ++k) f(k);
    };
    for (int a = rows > 1 ? -1 : 0; a <= (rows > 1 ? 1 : 0); ++a) {
      const int r = row + a < 0 ? rows - 1 : row + a == rows ? 0 : row + a, begin = r * cells_;
      // Neighbours within a row lie side by side, except across the full turn.
      all_in(begin + std::max(place - 1, 0), begin + std::min(place + 2, cells_));
      if (place == 0) all_in(begin + cells_ - 1, begin + cells_);
      if (place == cells_ - 1) all_in(begin, begin + 1);
    }
  }

  // Two states a cell.
  void sort_into_cells() {
    const auto count = static_cast<int>(states_.cols());
    cells_ = balls_ > 1 ? static_cast<int>(std::sqrt(0.5 * count)) : count / 2;
    cell_rows_ = balls_ > 1 ? cells_ : 1;
    const int all = cell_rows_ * cells_;
    std::vector<std::pair<int, int>> order;
    for (int k = 0; k < count; ++k) order.emplace_back(cell_of(angles_of(&states_(0, k))), k);
    std::sort(order.begin(), order.end());
    Eigen::MatrixXd sorted(states_.rows(), count);
    first_in_cell_.assign(static_cast<std::size_t>(all) + 1, 0);
    for (int k = 0; k < count; ++k) {
      sorted.col(k) = states_.col(order[k].second);
      ++first_in_cell_[order[k].first + 1];
    }
    for (int c = 0; c < all; ++c) first_in_cell_[c + 1] += first_in_cell_[c];
    states_ = std::move(sorted);
  }

  // One tangent is the flow. The other is the direction to neighbours on other windings, without its part along the
  // flow.
  void find_tangents(const model::System& system, const StopFlag* stop) {
    const auto size = static_cast<int>(states_.rows());
    tangents_ = Eigen::MatrixXd::Zero(2 * size, states_.cols());
    const double near = 4.0 * two_pi / cells_;
    std::vector<double> ways;  // one after the other
    std::array<double, max_dimension> along{}, way{}, sum{};
    for (int k = 0; k < states_.cols() && !is_set(stop); ++k) {
      const VectorXd flow = model::rate(system, states_.col(k).cwiseQuotient(inverse_scale_));
      VectorXd::Map(along.data(), size) = flow.cwiseProduct(inverse_scale_).normalized();
      const double* const here = &states_(0, k);
      ways.clear();
      double longest = 0.0;
      std::size_t farthest = 0;
      around_angles(angles_of(here), [&](int other) {
        const double* const there = &states_(0, other);
        double dot = 0.0, square = 0.0;
        for (int i = 0; i < size; ++i) way[i] = there[i] - here[i];
        for (int i = 0; i < balls_; ++i) way[model::index::phi(i)] = shorter_way(way[model::index::phi(i)]);
        for (int i = 0; i < size; ++i) dot += way[i] * along[i];
        for (int i = 0; i < size; ++i) {
          way[i] -= along[i] * dot;
          square += way[i] * way[i];
        }
        if (!(square < near * near)) return;
        if (square > longest) {
          longest = square;
          farthest = ways.size();
        }
        ways.insert(ways.end(), way.begin(), way.begin() + size);
      });
      sum.fill(0.0);
      for (std::size_t first = 0; first < ways.size(); first += static_cast<std::size_t>(size)) {
        double dot = 0.0;
        for (int i = 0; i < size; ++i) dot += ways[first + i] * ways[farthest + i];
        for (int i = 0; i < size; ++i) sum[i] += dot < 0.0 ? -ways[first + i] : ways[first + i];
      }
      tangents_.col(k).head(size) = VectorXd::Map(along.data(), size);
      const auto across = VectorXd::Map(sum.data(), size);
      if (across.norm() > 0.0) tangents_.col(k).tail(size) = across.normalized();
    }
  }

  // A torus that an exchange of alike balls maps onto itself needs no further place for them. False if there are too
  // many.
  bool find_images(const model::System& system, const Motion& motion) {
    const Eigen::Index size = inverse_scale_.size();
    const auto fits = [&](int i, int k) { return system.alike(i, k); };
    const auto as_one = [&](int i, int k) { return fits(i, k) && motion.cluster[i] == motion.cluster[k]; };
    const bool too_many = any_order(balls_, fits, as_one, [&](const std::vector<int>& balls) {
      BallOrder order{};
      std::copy(balls.begin(), balls.end(), order.begin());
      const Eigen::VectorXi places = exchanged_components(balls_, order, size);
      const VectorXd exchanged = VectorXd(states_.col(0).cwiseQuotient(inverse_scale_))(places);
      if (places_.empty() || !(value(exchanged.data()) < highest_torus_floor)) places_.push_back(places);
      return places_.size() > most_torus_places;
    });
    return !too_many;
  }

  // Whether a state of the cloud lies on the tangent plane at another, up to the bend of one sheet.
  bool lies_on(int patch, int other) const {
    const double bend = bent * two_pi / cells_;
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_dimension, 1> d = states_.col(other) - states_.col(patch);
    for (int i = 0; i < balls_; ++i) d[model::index::phi(i)] = shorter_way(d[model::index::phi(i)]);
    const double along = d.dot(tangents_.col(patch).head(d.size())),
                 across = d.dot(tangents_.col(patch).tail(d.size()));
    return d.squaredNorm() - along * along - across * across < bend * bend;
  }

  void make_patches(const StopFlag* stop) {
    const Eigen::Index size = inverse_scale_.size();
    rows_ = static_cast<int>((size + 3) / 4 * 4);
    const double width = two_pi / cells_;
    first_patch_.assign(1, 0);
    for (int cell = 0; cell < cell_rows_ * cells_ && !is_set(stop); ++cell) {
      const Angles middle{balls_ > 1 ? (cell / cells_ + 0.5) * width : 0.0, (cell % cells_ + 0.5) * width};
      std::vector<std::pair<double, int>> order;
      around_angles(middle, [&](int k) {
        const Angles at = angles_of(&states_(0, k));
        order.emplace_back(
            std::max(std::fabs(shorter_way(at[0] - middle[0])), std::fabs(shorter_way(at[1] - middle[1]))), k);
      });
      std::sort(order.begin(), order.end());
      // States in the cell and half a cell around it must lie on its planes; if there are none, nearby ones.
      const auto near =
          std::partition_point(order.begin(), order.end(), [&](const auto& o) { return o.first < width; });
      if (near != order.begin()) order.erase(near, order.end());
      std::vector<int> chosen;
      for (const auto& [distance, k] : order)
        if (std::none_of(chosen.begin(), chosen.end(), [&, k = k](int patch) { return lies_on(patch, k); }))
          chosen.push_back(k);
      for (const int k : chosen)
        for (const double* from : {&states_(0, k), &tangents_(0, k), &tangents_(size, k)}) {
          for (Eigen::Index i = 0; i < rows_; ++i) patches_.push_back(i < size ? static_cast<float>(from[i]) : 0.0f);
        }
      first_patch_.push_back(static_cast<int>(patches_.size()) / (3 * rows_));
    }
  }

  double value_in_place(const double* state, const OwnRotor* /*own*/) const override {
    const Eigen::Index size = inverse_scale_.size();
    std::array<float, max_dimension + 3> here{}, d{};
    for (Eigen::Index i = 0; i < size; ++i) here[i] = static_cast<float>(state[i] * inverse_scale_[i]);
    const int cell = cell_of(angles_of(state));
    // As for the states of the cloud.
    for (int i = 4; i < 4 + balls_; ++i) here[i] = static_cast<float>(within_a_turn(state[i] * inverse_scale_[i]));
    using Four = Eigen::Map<const Eigen::Array4f>;
    float least = std::numeric_limits<float>::infinity();
    for (int k = first_patch_[cell]; k < first_patch_[cell + 1]; ++k) {
      const float* const patch = &patches_[static_cast<std::size_t>(k) * 3 * rows_];
      for (int i = 0; i < rows_; ++i) d[i] = here[i] - patch[i];
      constexpr auto half = static_cast<float>(pi), turn = static_cast<float>(two_pi);
      for (int i = 4; i < 4 + balls_; ++i) d[i] += d[i] > half ? -turn : d[i] < -half ? turn : 0.0f;
      Eigen::Array4f squares = Eigen::Array4f::Zero(), along = squares, across = squares;
      for (int i = 0; i < rows_; i += 4) {
        const Four part(&d[i]);
        squares += part.square();
        along += part * Four(patch + rows_ + i);
        across += part * Four(patch + 2 * rows_ + i);
      }
      // Tangents are orthonormal. A part along the torus, up to its next state, adds no distance.
      const float a = along.sum(), b = across.sum();
      least = std::min(least, std::max(0.0f, squares.sum() - a * a - b * b));
    }
    return least;
  }

  int cells_ = 1, cell_rows_ = 1;   // in a row, and how many rows
  Eigen::MatrixXd states_;          // columns, in units of the scale, angles within a turn
  Eigen::MatrixXd tangents_;        // at each: along the flow, then across it; orthonormal, in the same units
  std::vector<int> first_in_cell_;  // and one more than there are cells
  // What stands for the cells, one after the other: a state and its two tangents, each padded to rows_ numbers. Kept
  // small, as lanes read it all over the torus.
  std::vector<float> patches_;
  std::vector<int> first_patch_;  // of each cell, and one more than there are cells
  int rows_ = 0;
};

}  // namespace

std::shared_ptr<const WindowRegion> torus_region(const model::System& system, const Motion& motion, int attractor,
                                                 const TrialSettings& settings, double near) {
  // A torus has two exponents of 0.
  const bool known = motion.kind == MotionKind::quasi_periodic && motion.stable && motion.exponents.size() > 2;
  if (!known || !system.autonomous() || !(motion.exponents[2] < -slowest_worth_it)) return nullptr;
  const auto region = TorusRegion::around(system, motion, attractor, settings.stop);
  if (!region) return nullptr;
  return validate(region, {highest_torus_level, 12}, come_close_to_torus, settings, near) ? region : nullptr;
}

}  // namespace equipoise

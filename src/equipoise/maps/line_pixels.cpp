// Pieces of lines side by side, pixels within a piece one after another.
#include "equipoise/maps/line_pixels.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "equipoise/base/parallel.hpp"
#include "equipoise/branches/parameter_line.hpp"
#include "equipoise/fates/followed_start.hpp"
#include "equipoise/math/dense.hpp"
#include "equipoise/model/balanced_state.hpp"
#include "equipoise/model/linearisation.hpp"
#include "equipoise/orbits/return_map.hpp"
#include "equipoise/spin_up/initial_state.hpp"
#include "equipoise/spin_up/spin_up.hpp"
#include "equipoise/store/basin_file.hpp"
#include "equipoise/store/start_columns.hpp"

namespace equipoise {

namespace {

// Orbits that a piece of one system keeps, the latest first.
constexpr std::size_t most_known = 12;
// Pixels of a piece: enough to gain by what they share, few enough that little is lost if the run is stopped. Pieces
// lie at fixed places, whatever is known of a line already.
constexpr std::uint32_t piece_length = 16;
// Pixels that share nothing are handed on at least so often.
constexpr std::chrono::milliseconds hand_on_every{500};

bool is_start_key(const std::string& key) { return key.starts_with("initial."); }

void remember(const model::System& system, const Settling& settling, std::vector<KnownOrbit>& known) {
  if (!settling.motion || settling.motion->kind != MotionKind::periodic || settling.known) return;
  known.insert(known.begin(), known_orbit(system, *settling.motion));
  if (known.size() > most_known) known.pop_back();
}

}  // namespace

double balance_margin(const model::Parameters& p) {
  const double largest = std::max(p.eccentricity, *std::max_element(p.mass.begin(), p.mass.begin() + p.balls));
  return p.eccentricity + p.total_mass() - 2.0 * largest;
}

double balance_growth(const model::System& system) {
  const model::Parameters& p = system.parameters();
  double least = std::numeric_limits<double>::quiet_NaN();
  if (!system.plain() || !system.autonomous()) return least;
  for (const auto& phi : model::balanced_states(p).angles) {
    const Eigen::VectorXd centre = model::centred_state(p, phi.data());
    least = std::fmin(least, dense::largest_real_part(model::jacobian(p, system.speed(), centre.data())));
  }
  return least;
}

Study study_at(const PlaneMap& map, int column, int row) {
  Study study = study_with(map.study, map.x.key, map.x.centre(column));
  study = study_with(study, map.y.key, map.y.centre(row));
  if (draws_starts(map)) {
    const auto pixel = static_cast<std::uint64_t>(row) * static_cast<std::uint64_t>(map.x.pixels);
    const Sampler sampler(SamplingMethod::random, study.parameters.balls, 0, false);
    study.initial = start_of(study, sampler, study.sampling.seed, pixel + static_cast<std::uint64_t>(column));
  }
  tie(study.initial, map.links);
  return study;
}

struct LinePixels::Followed {
  MapPixel pixel;
  std::optional<MotionName> motion;
};

LinePixels::LinePixels(const PlaneMap& map, const RunOptions& options)
    : map_(map),
      options_(options),
      one_system_(is_start_key(map.x.key) || is_start_key(map.y.key)),
      along_y_(one_system_ && !is_start_key(map.x.key)) {}

// Line, and piece within it.
std::pair<std::uint32_t, std::uint32_t> LinePixels::piece_of(std::uint32_t position) const {
  const std::uint32_t columns = static_cast<std::uint32_t>(map_.x.pixels);
  const std::uint32_t column = position % columns, row = position / columns;
  return along_y_ ? std::pair{column, row / piece_length} : std::pair{row, column / piece_length};
}

std::vector<std::uint32_t> LinePixels::along_lines(std::vector<std::uint32_t> positions) const {
  std::sort(positions.begin(), positions.end(),
            [&](std::uint32_t a, std::uint32_t b) { return std::pair(piece_of(a), a) < std::pair(piece_of(b), b); });
  return positions;
}

bool LinePixels::compute(const std::vector<std::uint32_t>& asked, const TakePixels& take) {
  const std::vector<std::uint32_t> positions = along_lines(asked);
  std::vector<std::size_t> ends{0};
  for (std::size_t k = 1; k <= positions.size(); ++k)
    if (k == positions.size() || piece_of(positions[k]) != piece_of(positions[k - 1])) ends.push_back(k);
  in_parallel(map_.threads, ends.size() - 1,
              [&](std::size_t k) { compute_piece(positions, ends[k], ends[k + 1], take); });
  return !is_set(options_.stop);
}

// What pixels of one system tell one another must not depend on where a run was stopped: their piece counts whole or
// not at all.
void LinePixels::compute_piece(const std::vector<std::uint32_t>& positions, std::size_t begin, std::size_t end,
                               const TakePixels& take) {
  using Clock = std::chrono::steady_clock;
  std::vector<KnownOrbit> known;
  std::vector<Followed> followed;
  float growth = 0.0f;
  Clock::time_point handed_on = Clock::now();
  const auto hand_on = [&](std::size_t next) {
    DonePixels done;
    for (std::size_t k = 0; k < followed.size(); ++k) {
      done.positions.push_back(positions[next - followed.size() + k]);
      done.pixels.push_back(followed[k].pixel);
      done.motions.push_back(followed[k].motion ? &*followed[k].motion : nullptr);
    }
    const std::lock_guard lock(taking_);
    take(done);
    followed.clear();
    handed_on = Clock::now();
  };
  for (std::size_t k = begin; k < end; ++k) {
    const std::uint32_t columns = static_cast<std::uint32_t>(map_.x.pixels);
    const Study study =
        study_at(map_, static_cast<int>(positions[k] % columns), static_cast<int>(positions[k] / columns));
    const model::System system = study.system();
    Followed here;
    if (!is_set(options_.stop)) here = follow(study, system, known);
    if (here.pixel.code == not_computed_code && !here.motion) {  // stopped
      if (!one_system_ && !followed.empty()) hand_on(k);
      return;
    }
    if (k == begin || !one_system_) growth = static_cast<float>(balance_growth(system));
    here.pixel.computed = true;
    here.pixel.balance_growth = growth;
    here.pixel.balance_margin = static_cast<float>(balance_margin(study.parameters));
    followed.push_back(std::move(here));
    if (!one_system_ && Clock::now() - handed_on > hand_on_every) hand_on(k + 1);
  }
  if (!followed.empty()) hand_on(end);
}

LinePixels::Followed LinePixels::follow(const Study& study, const model::System& system,
                                        std::vector<KnownOrbit>& known) const {
  const model::Parameters& p = study.parameters;
  const std::unique_ptr<SpinUp> source = make_spin_up(study, options_.stop);
  SpunUp start;
  Followed result;
  MapPixel& pixel = result.pixel;
  if (overlap(p, study.initial.phi.data())) {  // no such start
    pixel.code = failed_code;
    return result;
  }
  if (!source->follow(parted(p, {&study.initial, 1}), start)) return result;
  const auto [fate, settling] = follow_start(study, system, *source, start, known, options_.stop);
  if (is_set(options_.stop)) return result;
  if (one_system_ && system.smooth()) remember(system, settling, known);
  pixel.time = static_cast<float>(fate.time);
  pixel.code = code_of(fate);
  if (!settling.motion || !settling.motion->stable) return result;
  result.motion = motion_name(p, *settling.motion);
  pixel.r_max = static_cast<float>(settling.motion->r_max);
  return result;
}

}  // namespace equipoise

// Decides pixels as chunks of starts.
#include "equipoise/analyses/basin_slices/start_pixels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "equipoise/analyses/basin_slices/slice_axis.hpp"
#include "equipoise/analyses/continuation/parameter_line.hpp"
#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/balance/room_in_race.hpp"
#include "equipoise/machine/balance/tilt_balance.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/results/result_files/basin_file.hpp"
#include "equipoise/results/result_files/start_columns.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"

namespace equipoise {

namespace {

// Whether the key's values are starts of one rotor, which lanes take in any order.
bool is_start(const Study& study, const std::string& key) {
  InitialState any;
  if (!initial_value(any, study.parameters.balls, key)) return false;
  // While the balls are held, starts can differ only in their angles.
  return SliceAxis{key}.angle() || (key != "initial.psi" && study.release_time() == 0.0);
}

}  // namespace

bool maps_starts(const BasinSlice& map) { return is_start(map.study, map.x.key) && is_start(map.study, map.y.key); }

double balance_margin(const model::Parameters& p) {
  if (p.tilts()) return model::tilt_balance_margin(p);
  const double largest = std::max(p.eccentricity, *std::max_element(p.mass.begin(), p.mass.begin() + p.balls));
  return p.eccentricity + p.total_mass() - 2.0 * largest;
}

double balance_growth(const model::System& system) {
  const model::Parameters& p = system.parameters();
  double least = std::numeric_limits<double>::quiet_NaN();
  if (!system.prescribed() || !p.race_is_centred() || !system.autonomous()) return least;
  for (const auto& phi : model::balanced_states(p).angles) {
    const Eigen::VectorXd centre = model::balanced_state(system, system.speed(), phi.data());
    least = std::fmin(least, dense::largest_real_part(model::jacobian(system, centre)));
  }
  return least;
}

namespace {

// Places linked balls, link by link.
void tie(InitialState& start, const std::vector<AngleLink>& links) {
  for (const AngleLink& link : links)
    start.phi[static_cast<std::size_t>(link.ball - 1)] = start.phi[static_cast<std::size_t>(link.of - 1)] + link.offset;
}

// The start of [initial], with drawn ball angles if the slice draws them.
void place_start(const BasinSlice& map, int column, int row, Study& study) {
  if (draws_starts(map)) {
    const auto pixel = static_cast<std::uint64_t>(row) * static_cast<std::uint64_t>(map.x.pixels);
    const Sampler sampler(SamplingMethod::random, study.parameters.balls, 0, false);
    study.initial = start_of(study, sampler, study.sampling.seed, pixel + static_cast<std::uint64_t>(column));
  }
  tie(study.initial, map.links);
}

// The family of the studies of a slice's pixels, over the axes that are not initial values.
StudyFamily family_of(const BasinSlice& map) {
  std::vector<StudyFamily::Quantile> values;
  std::vector<std::string> keys;
  for (const SliceAxis* axis : {&map.x, &map.y}) {
    if (is_start(map.study, axis->key)) continue;
    keys.push_back(axis->key);
    values.push_back({[low = axis->low, high = axis->high](double f) { return (1.0 - f) * low + f * high; }});
  }
  return {std::move(values), [study = map.study, keys](std::span<const double> at) {
            Study result = study;
            for (std::size_t k = 0; k < keys.size(); ++k) result = study_with(result, keys[k], at[k]);
            return result;
          }};
}

// For a slice whose lines have one rotor each and are long enough to probe: whether the lines are columns.
std::optional<bool> lines_are_columns(const BasinSlice& map) {
  const bool start_along_x = is_start(map.study, map.x.key);
  if (start_along_x == is_start(map.study, map.y.key)) return std::nullopt;
  if (!LineMotions::pays(start_along_x ? map.x.pixels : map.y.pixels)) return std::nullopt;
  return !start_along_x;
}

Session session_of(const BasinSlice& map, const RunOptions& options, SearchLog* notes) {
  const AttractorSearchSettings settings{
      .threads = map.threads, .stop = options.stop, .progress = options.progress, .notes = notes};
  if (maps_starts(map)) return {map.study, settings};
  FamilyStarts starts{static_cast<double>(map.x.pixels) * map.y.pixels};
  if (const auto columns = lines_are_columns(map)) starts.rotors = *columns ? map.x.pixels : map.y.pixels;
  return {map.study, family_of(map), starts, settings};
}

}  // namespace

InitialState start_at(const BasinSlice& map, int column, int row) {
  InitialState s = map.study.initial;
  for (const auto& [axis, pixel] : {std::pair{&map.x, column}, std::pair{&map.y, row}})
    if (double* value = initial_value(s, map.study.parameters.balls, axis->key)) *value = axis->centre(pixel);
  tie(s, map.links);
  return s;
}

Study study_at(const BasinSlice& map, int column, int row) {
  Study study = study_with(map.study, map.x.key, map.x.centre(column));
  study = study_with(study, map.y.key, map.y.centre(row));
  place_start(map, column, row, study);
  return study;
}

InvariantPixels::InvariantPixels(const BasinSlice& plane) {
  if (draws_starts(plane)) return;
  const model::Parameters p = study_at(plane, 0, 0).parameters;
  const auto start = [&](int column, int row) { return start_at(plane, column, row); };
  const InitialState corner = start(0, 0);
  for (int i = 0; i < p.balls; ++i)
    for (int k = 0; k < i; ++k) {
      if (!p.balls_collide() && !p.alike(i, k)) continue;
      const auto angle = [&](const InitialState& s) { return s.phi[i] - s.phi[k]; };
      const auto rate = [&](const InitialState& s) { return s.phi_dot[i] - s.phi_dot[k]; };
      Pair pair;
      if (p.balls_collide()) pair.meet = {p.contact_angle, std::numeric_limits<double>::infinity()};
      for (int column = 0; column < plane.x.pixels; ++column) {
        pair.angle_of_column.push_back(angle(start(column, 0)));
        pair.rate_of_column.push_back(rate(start(column, 0)));
      }
      for (int row = 0; row < plane.y.pixels; ++row) {
        pair.angle_of_row.push_back(angle(start(0, row)) - angle(corner));
        pair.rate_of_row.push_back(rate(start(0, row)) - rate(corner));
      }
      const auto varies = [](const std::vector<double>& values) {
        return std::any_of(values.begin(), values.end(), [&](double v) { return v != values.front(); });
      };
      if (varies(pair.angle_of_column) || varies(pair.angle_of_row) || varies(pair.rate_of_column) ||
          varies(pair.rate_of_row))
        pairs_.push_back(std::move(pair));
      else
        everywhere_ = everywhere_ || model::coincide(p, i, k, corner.phi.data(), corner.phi_dot.data());
    }
  if (pairs_.empty()) return;
  for (int row = 0; row < plane.y.pixels; ++row)
    for (int column = 0; column < plane.x.pixels; ++column) count_ += holds(column, row);
  if (count_ < pixels_of(plane.x, plane.y)) return;
  pairs_.clear();
  count_ = 0;
  everywhere_ = true;
}

bool InvariantPixels::holds(int column, int row) const {
  const auto x = static_cast<std::size_t>(column), y = static_cast<std::size_t>(row);
  return std::any_of(pairs_.begin(), pairs_.end(), [&](const Pair& pair) {
    return std::fabs(pair.rate_of_column[x] + pair.rate_of_row[y]) < pair.meet.rate &&
           std::fabs(wrapped(pair.angle_of_column[x] + pair.angle_of_row[y])) < pair.meet.angle;
  });
}

StartPixels::StartPixels(const BasinSlice& map, const RunOptions& options, SliceNames& names, SliceStore* file,
                         Take take)
    : map_(map),
      options_(options),
      names_(names),
      file_(file),
      take_(std::move(take)),
      session_(session_of(map, options, file ? &file->notes() : nullptr)),
      catalogue_(session_) {
  if (session_.stopped()) return;
  if (const auto columns = lines_are_columns(map))
    lines_.emplace(map, *columns, session_, file_ ? &file_->notes() : nullptr);
  for (const Attractor& a : catalogue_.attractors()) listed_.insert(a.id);
  if (!file_ || of_family()) return;
  for (const std::vector<double>& state : file_->discoveries()) {
    const std::optional<UnlistedStart> start = session_.follow(state);
    unread_ = !start;
    if (unread_) return;
    listed_.insert(catalogue_.list(*start));
  }
}

bool StartPixels::compute(const std::vector<std::uint32_t>& positions) {
  if (unread_ || session_.stopped()) return false;
  const auto start_at = [&](std::uint32_t position) { return family_start(position); };
  if (lines_ && !lines_->look_along(positions, start_at, options_)) return false;
  return take_all(session_, lines_ ? &*lines_ : nullptr, positions, [&](Chunk& chunk) {
    hand_on(positions, chunk);
    return true;
  });
}

InitialState StartPixels::start(std::uint32_t position) const {
  const std::uint32_t columns = static_cast<std::uint32_t>(map_.x.pixels);
  return start_at(map_, static_cast<int>(position % columns), static_cast<int>(position / columns));
}

FamilyStart StartPixels::family_start(std::uint32_t position) const {
  const std::uint32_t columns = static_cast<std::uint32_t>(map_.x.pixels);
  const int column = static_cast<int>(position % columns), row = static_cast<int>(position / columns);
  FamilyStart result;
  std::vector<double> values;
  const std::array<std::pair<const SliceAxis*, double>, 2> axes{std::pair{&map_.x, map_.x.centre(column)},
                                                                std::pair{&map_.y, map_.y.centre(row)}};
  for (const auto& [axis, value] : axes) {
    if (is_start(map_.study, axis->key)) continue;
    values.push_back(value);
    result.fractions.push_back((value - axis->low) / (axis->high - axis->low));
  }
  Study& study = result.own.study = session_.family()->at(values);
  for (const auto& [axis, value] : axes)
    if (is_start(map_.study, axis->key)) *initial_value(study.initial, study.parameters.balls, axis->key) = value;
  place_start(map_, column, row, study);
  result.own.start = parted(study.parameters, study.initial);
  return result;
}

std::optional<Share> StartPixels::flipped(const std::vector<std::uint32_t>& positions, double tolerance) const {
  if (unread_ || session_.stopped()) return std::nullopt;
  RunCatalogue catalogue = catalogue_;
  const auto ends_of = [&](const Session& session) {  // names of motions; empty without one
    std::vector<std::string> ends;
    take_all(session, nullptr, positions, [&](Chunk& chunk) {
      catalogue.settle(chunk);
      for (const Outcome& outcome : chunk.outcomes) {
        const Attractor* a = outcome.kind == OutcomeKind::attracted ? catalogue.find(outcome.attractor) : nullptr;
        ends.push_back(a ? a->name : "");
      }
      return true;
    });
    return ends;
  };
  const auto given = ends_of(session_), finer = ends_of(Session(session_, tolerance));
  if (std::min(given.size(), finer.size()) < positions.size()) return std::nullopt;
  std::uint64_t tried = 0, flipped = 0;
  for (std::size_t k = 0; k < given.size(); ++k) {
    if (given[k].empty() || finer[k].empty()) continue;
    ++tried;
    flipped += given[k] != finer[k];
  }
  return wilson_share(flipped, tried);
}

bool StartPixels::take_all(const Session& session, const LineMotions* lines,
                           const std::vector<std::uint32_t>& positions, const TakeChunk& take) const {
  const ChunkWork work{.decide = [&](Chunk& chunk) { return decide(session, lines, positions, chunk); },
                       .threads = map_.threads,
                       .stop = options_.stop};
  return take_chunks(work, 0, positions.size(), take);
}

bool StartPixels::decide(const Session& session, const LineMotions* lines, const std::vector<std::uint32_t>& positions,
                         Chunk& chunk) const {
  if (of_family()) {
    std::vector<FamilyStart> starts;
    for (std::size_t i = 0; i < chunk.count; ++i) {
      const std::uint32_t position = positions[chunk.first + i];
      starts.push_back(family_start(position));
      starts.back().own.study.numerics.tolerance = session.study().numerics.tolerance;
      if (lines) starts.back().met = &lines->at(position);
    }
    return session.decide(std::move(starts), chunk);
  }
  std::vector<InitialState> starts;
  for (std::size_t i = 0; i < chunk.count; ++i) starts.push_back(start(positions[chunk.first + i]));
  return session.decide(starts, chunk);
}

// Passes pixels on in order.
void StartPixels::hand_on(const std::vector<std::uint32_t>& positions, Chunk& chunk) {
  std::map<std::size_t, double> followed;  // largest r of what starts were followed to
  for (const UnlistedStart& u : chunk.unlisted) {
    const int id = catalogue_.settle(u, chunk.outcomes[u.place]);
    if (id > 0 && listed_.insert(id).second && !of_family() && file_) file_->append_attractor_search(u.state);
    if (u.motion) followed[u.place] = u.motion->r_max;
  }
  const auto first = positions.begin() + static_cast<std::ptrdiff_t>(chunk.first);
  const std::vector<std::uint32_t> places(first, first + static_cast<std::ptrdiff_t>(chunk.count));
  std::vector<SlicePixel> pixels;
  for (std::size_t i = 0; i < chunk.count; ++i) {
    const auto own = of_family() ? std::optional<FamilyStart>(family_start(places[i])) : std::nullopt;
    const InitialState begin = own ? own->own.start : start(places[i]);
    const auto at = followed.find(i);
    SlicePixel& pixel = pixels.emplace_back();
    if (model::overlap(map_.study.parameters, begin.phi.data()))  // no such start
      pixel.code = failed_code;
    else
      pixel = pixel_of(own, chunk.outcomes[i], at == followed.end() ? nullptr : &at->second);
    if (!own) continue;
    pixel.balance_growth = static_cast<float>(balance_growth(own->own.study.system()));
    pixel.balance_margin = static_cast<float>(balance_margin(own->own.study.parameters));
  }
  take_(places, pixels);
}

// A name is in the file before its first pixel.
short StartPixels::code_of_motion(const MotionName& motion) {
  const std::size_t before = names_.codes().size();
  const short code = names_.code(motion);
  if (file_ && names_.codes().size() > before) file_->append_code(names_.codes().back());
  return code;
}

SlicePixel StartPixels::pixel_of(const std::optional<FamilyStart>& own, const Outcome& outcome,
                                 const double* followed) {
  SlicePixel pixel;
  pixel.time = static_cast<float>(outcome.time);
  pixel.code = code_of(outcome);
  const Attractor* a = outcome.kind == OutcomeKind::attracted ? catalogue_.find(outcome.attractor) : nullptr;
  if (!a) return pixel;
  const auto [code, fresh] = codes_.try_emplace(a->id);
  if (fresh) code->second = code_of_motion({a->name, a->alias, a->id < first_free_id ? a->id : 0});
  pixel.code = code->second;
  pixel.r_max = followed ? static_cast<float>(*followed) : own ? outcome.radius : static_cast<float>(a->motion.r_max);
  return pixel;
}

}  // namespace equipoise

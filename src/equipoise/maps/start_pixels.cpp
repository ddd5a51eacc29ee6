// Pixels as chunks of starts.
#include "equipoise/maps/start_pixels.hpp"

#include <atomic>
#include <string>

#include "equipoise/branches/parameter_line.hpp"
#include "equipoise/motions/catalogue.hpp"
#include "equipoise/orbits/return_map.hpp"
#include "equipoise/store/basin_file.hpp"
#include "equipoise/store/start_columns.hpp"

namespace equipoise {

namespace {

// Whether a key's values are starts of one rotor, which lanes take as they come.
bool is_start(const Study& study, const std::string& key) {
  InitialState any;
  if (!initial_value(any, study.parameters.balls, key)) return false;
  // Where the balls are held at first they start alike but for their angles.
  return MapAxis{key}.angle() || (key != "initial.psi" && study.release_time() == 0.0);
}

}  // namespace

bool maps_starts(const PlaneMap& map) { return is_start(map.study, map.x.key) && is_start(map.study, map.y.key); }

StartPixels::StartPixels(const PlaneMap& map, const RunOptions& options, const std::vector<std::vector<double>>& met,
                         const Discovered& discovered)
    : map_(map),
      options_(options),
      discovered_(discovered),
      runner_(map.study, {map.threads, options.stop, {}, nullptr, options.progress}) {
  if (runner_.stopped()) return;
  for (const Attractor& a : runner_.catalogue().attractors()) listed_.insert(a.id);
  for (const std::vector<double>& state : met) {
    const std::optional<UnlistedStart> start = runner_.follow(state);
    unread_ = !start;
    if (unread_) return;
    listed_.insert(runner_.list(*start));
  }
}

bool StartPixels::compute(const std::vector<std::uint32_t>& positions, const TakePixels& take) {
  if (unread_ || runner_.stopped()) return false;
  const ChunkWork work{.decide = [&](Chunk& chunk) { return decide(positions, chunk); },
                       .threads = map_.threads,
                       .stop = options_.stop};
  const std::atomic<bool> finished{false};
  std::atomic<bool> lost{false};
  bool whole = true;  // all chunks so far
  compute_chunks(work, 0, positions.size(), finished, lost, [&](const std::shared_ptr<Chunk>& chunk) {
    whole = whole && chunk->complete;
    if (whole) hand_on(positions, *chunk, take);
  });
  return whole && !lost;
}

InitialState StartPixels::start(std::uint32_t position) const {
  const std::uint32_t columns = static_cast<std::uint32_t>(map_.x.pixels);
  InitialState s = map_.study.initial;
  *initial_value(s, map_.study.parameters.balls, map_.x.key) = map_.x.centre(static_cast<int>(position % columns));
  *initial_value(s, map_.study.parameters.balls, map_.y.key) = map_.y.centre(static_cast<int>(position / columns));
  tie(s, map_.links);
  return s;
}

bool StartPixels::decide(const std::vector<std::uint32_t>& positions, Chunk& chunk) const {
  std::vector<InitialState> starts;
  for (std::size_t i = 0; i < chunk.count; ++i) starts.push_back(start(positions[chunk.first + i]));
  return runner_.run_from(starts, chunk.fates, chunk.unlisted);
}

// In order.
void StartPixels::hand_on(const std::vector<std::uint32_t>& positions, Chunk& chunk, const TakePixels& take) {
  for (const UnlistedStart& u : chunk.unlisted) {
    const int id = settle(runner_, u, chunk.fates[u.place]);
    if (id > 0 && listed_.insert(id).second) discovered_(u.state);
  }
  DonePixels done;
  for (std::size_t i = 0; i < chunk.count; ++i) {
    const std::uint32_t position = positions[chunk.first + i];
    const MotionName* motion = nullptr;
    MapPixel pixel;
    if (overlap(map_.study.parameters, start(position).phi.data()))
      pixel.code = failed_code;  // no such start
    else
      pixel = pixel_of(chunk.fates[i], motion);
    pixel.computed = true;
    done.positions.push_back(position);
    done.pixels.push_back(pixel);
    done.motions.push_back(motion);
  }
  take(done);
}

MapPixel StartPixels::pixel_of(const Fate& fate, const MotionName*& motion) {
  MapPixel pixel;
  pixel.time = static_cast<float>(fate.time);
  pixel.code = code_of(fate);
  const Attractor* a = fate.outcome == Outcome::attracted ? runner_.catalogue().find(fate.attractor) : nullptr;
  if (!a) return pixel;
  auto& name = names_[a->id];
  if (!name) name = std::make_unique<MotionName>(MotionName{a->name, a->alias, a->id < first_free_id ? a->id : 0});
  motion = name.get();
  pixel.r_max = static_cast<float>(a->motion.r_max);
  return pixel;
}

}  // namespace equipoise

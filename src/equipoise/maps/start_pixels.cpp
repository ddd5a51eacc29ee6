// Pixels as chunks of starts.
#include "equipoise/maps/start_pixels.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "equipoise/basins/chunks.hpp"
#include "equipoise/branches/parameter_line.hpp"
#include "equipoise/fates/start_runner.hpp"
#include "equipoise/model/system.hpp"
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

class StartMapper {
 public:
  StartMapper(const PlaneMap& map, const RunOptions& options)
      : map_(map),
        columns_(static_cast<std::size_t>(map.x.pixels)),
        options_(options),
        runner_(map.study, {map.threads, options.stop, {}, nullptr, options.progress}) {}

  std::vector<MapPixel> run() {
    const std::uint64_t size = columns_ * static_cast<std::uint64_t>(map_.y.pixels);
    pixels_.resize(size);
    if (runner_.stopped()) return std::move(pixels_);
    const ChunkWork work{[&](Chunk& chunk) { return decide(chunk); }, map_.threads, false, options_.stop};
    const std::atomic<bool> finished{false};
    std::atomic<bool> lost{false};
    compute_chunks(work, 0, size, finished, lost, [&](const std::shared_ptr<Chunk>& chunk) { take(*chunk, size); });
    return std::move(pixels_);
  }

 private:
  InitialState start(std::uint64_t pixel) const {
    InitialState s = map_.study.initial;
    *initial_value(s, map_.study.parameters.balls, map_.x.key) = map_.x.centre(static_cast<int>(pixel % columns_));
    *initial_value(s, map_.study.parameters.balls, map_.y.key) = map_.y.centre(static_cast<int>(pixel / columns_));
    tie(s, map_.links);
    return s;
  }

  bool decide(Chunk& chunk) const {
    std::vector<InitialState> starts;
    for (std::size_t i = 0; i < chunk.count; ++i) starts.push_back(start(chunk.first + i));
    return runner_.run_from(starts, chunk.fates, chunk.unlisted);
  }

  // In order.
  void take(Chunk& chunk, std::uint64_t size) {
    if (!chunk.complete || !whole_) {
      whole_ = false;
      return;
    }
    for (const UnlistedStart& u : chunk.unlisted) settle(runner_, u, chunk.fates[u.place]);
    for (std::size_t i = 0; i < chunk.count; ++i)
      pixels_[chunk.first + i] = overlap(map_.study.parameters, start(chunk.first + i).phi.data())
                                     ? MapPixel{failed_code}
                                     : pixel_of(chunk.fates[i]);
    if (options_.progress) options_.progress({chunk.first + chunk.count, size, "pixels", {}});
  }

  MapPixel pixel_of(const Fate& fate) {
    MapPixel pixel;
    pixel.time = fate.time;
    pixel.code = store::code_of(fate);
    const Attractor* a = fate.outcome == Outcome::attracted ? runner_.catalogue().find(fate.attractor) : nullptr;
    if (!a) return pixel;
    auto& name = names_[a->id];
    if (!name) name = std::make_shared<MotionName>(MotionName{a->name, a->alias, a->id < first_free_id ? a->id : 0});
    pixel.motion = name;
    pixel.r_max = a->motion.r_max;
    return pixel;
  }

  const PlaneMap& map_;
  std::size_t columns_;
  const RunOptions& options_;
  StartRunner runner_;
  std::vector<MapPixel> pixels_;
  std::map<int, std::shared_ptr<const MotionName>> names_;  // of attractors
  bool whole_ = true;                                       // all chunks so far
};

}  // namespace

bool maps_starts(const PlaneMap& map) { return is_start(map.study, map.x.key) && is_start(map.study, map.y.key); }

std::vector<MapPixel> start_pixels(const PlaneMap& map, const RunOptions& options) {
  return StartMapper(map, options).run();
}

}  // namespace equipoise

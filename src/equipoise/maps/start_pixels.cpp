// Pixels as chunks of starts.
#include "equipoise/maps/start_pixels.hpp"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string_view>

#include "equipoise/basins/chunks.hpp"
#include "equipoise/fates/start_runner.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/motions/catalogue.hpp"
#include "equipoise/orbits/return_map.hpp"
#include "equipoise/store/basin_file.hpp"
#include "equipoise/store/start_columns.hpp"

namespace equipoise {

namespace {

// The ball that "initial.phi_2" names, from 0.
std::optional<std::size_t> ball_of(std::string_view key) {
  constexpr std::string_view angle = "initial.phi_";
  if (!key.starts_with(angle)) return std::nullopt;
  std::size_t ball = 0;
  const char* end = key.data() + key.size();
  const auto read = std::from_chars(key.data() + angle.size(), end, ball);
  return read.ec == std::errc() && read.ptr == end && ball > 0 ? std::optional(ball - 1) : std::nullopt;
}

class StartMapper {
 public:
  StartMapper(const PlaneMap& map, const RunOptions& options)
      : map_(map),
        balls_(static_cast<std::size_t>(map.study.parameters.balls)),
        columns_(static_cast<std::size_t>(map.x.pixels)),
        x_ball_(*ball_of(map.x.key)),
        y_ball_(*ball_of(map.y.key)),
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
  void angles(std::uint64_t pixel, std::vector<double>& phi) const {
    const std::size_t at = phi.size();
    phi.insert(phi.end(), map_.study.initial.phi.begin(), map_.study.initial.phi.begin() + balls_);
    phi[at + x_ball_] = map_.x.centre(static_cast<int>(pixel % columns_));
    phi[at + y_ball_] = map_.y.centre(static_cast<int>(pixel / columns_));
    for (const AngleLink& link : map_.links)
      phi[at + static_cast<std::size_t>(link.ball - 1)] = phi[at + static_cast<std::size_t>(link.of - 1)] + link.offset;
  }

  bool decide(Chunk& chunk) const {
    for (std::size_t i = 0; i < chunk.count; ++i) angles(chunk.first + i, chunk.phi);
    return runner_.run_from(chunk.phi, chunk.fates, chunk.unlisted);
  }

  // In order.
  void take(Chunk& chunk, std::uint64_t size) {
    if (!chunk.complete || !whole_) {
      whole_ = false;
      return;
    }
    for (const UnlistedStart& u : chunk.unlisted) settle(runner_, u, chunk.fates[u.place]);
    for (std::size_t i = 0; i < chunk.count; ++i)
      pixels_[chunk.first + i] = overlap(map_.study.parameters, &chunk.phi[i * balls_]) ? MapPixel{failed_code} : pixel_of(chunk.fates[i]);
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
  std::size_t balls_, columns_, x_ball_, y_ball_;
  const RunOptions& options_;
  StartRunner runner_;
  std::vector<MapPixel> pixels_;
  std::map<int, std::shared_ptr<const MotionName>> names_;  // of attractors
  bool whole_ = true;                                       // all chunks so far
};

}  // namespace

bool maps_starts(const PlaneMap& map) { return ball_of(map.x.key) && ball_of(map.y.key); }

std::vector<MapPixel> start_pixels(const PlaneMap& map, const RunOptions& options) {
  return StartMapper(map, options).run();
}

}  // namespace equipoise

// One trajectory a pixel, but where pixels are starts of one system (start_pixels.hpp). Where one axis is of initial
// values, lines run along it and pixels in a line, which share one system, are done one after another: so each orbit is
// refined once a line. (Moving orbits from one system to the next costs more than finding them anew.)
#include "equipoise/maps/plane_map.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "equipoise/base/error.hpp"
#include "equipoise/base/reporting.hpp"
#include "equipoise/basins/basin.hpp"
#include "equipoise/branches/parameter_line.hpp"
#include "equipoise/discovery/horizon.hpp"
#include "equipoise/fates/followed_start.hpp"
#include "equipoise/fates/start_runner.hpp"
#include "equipoise/kernels/cpu_target.hpp"
#include "equipoise/maps/start_pixels.hpp"
#include "equipoise/math/dense.hpp"
#include "equipoise/model/balanced_state.hpp"
#include "equipoise/model/linearisation.hpp"
#include "equipoise/motions/catalogue.hpp"
#include "equipoise/motions/settling.hpp"
#include "equipoise/orbits/return_map.hpp"
#include "equipoise/orbits/stroboscopic.hpp"
#include "equipoise/spin_up/spin_up.hpp"
#include "equipoise/store/start_columns.hpp"

namespace equipoise {

namespace {

constexpr int most_pixels = 50'000'000;  // in all: 4 GB
// Unless the study says. Pixels are followed one by one, and what is chaotic is only known at the end.
constexpr double default_horizon = 3000.0;
// Orbits that a line of one system keeps, the latest first.
constexpr std::size_t most_known = 12;

// Motions of two balls without an identifier of their own that maps are known to show: they have the same code, and
// with it the same colour, in every map. Others come after them.
constexpr std::array usual_names{
    "both captured",       "both captured, chaotic", "both captured, quasi-periodic", "one captured, quasi-periodic",
    "pair drift, chaotic", "one captured, period 2"};

bool is_start_key(const std::string& key) { return key.starts_with("initial."); }

double balance_margin(const model::Parameters& p) {
  const double largest = std::max(p.eccentricity, *std::max_element(p.mass.begin(), p.mass.begin() + p.balls));
  return p.eccentricity + p.total_mass() - 2.0 * largest;
}

// Of isolated balanced states where nothing depends on the rotor's angle and the race is centred.
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

class Mapper {
 public:
  Mapper(const Study& study, const PlaneMapSettings& settings)
      : settings_(settings),
        one_system_(is_start_key(settings.x.key) || is_start_key(settings.y.key)),
        lines_along_y_(one_system_ && !is_start_key(settings.x.key)) {
    map_.study = with_medians(study);
    map_.x = settings.x;
    map_.y = settings.y;
    map_.links = settings.links;
  }

  PlaneMap run() {
    const auto begin = std::chrono::steady_clock::now();
    const std::clock_t cpu_begin = std::clock();
    check();
    prepare();
    if (maps_starts(map_))
      compute_starts();
    else
      compute_lines();
    give_codes();
    map_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    map_.cpu_seconds = static_cast<double>(std::clock() - cpu_begin) / CLOCKS_PER_SEC;
    return std::move(map_);
  }

 private:
  void check() const {
    for (const MapAxis* axis : {&map_.x, &map_.y}) {
      const auto reject = [&](const std::string& value, const std::string& problem) {
        throw InputError("map", axis->key, value, problem);
      };
      if (axis->pixels < 1 || axis->pixels > most_map_pixels)
        reject(fmt::format("{}", axis->pixels),
               fmt::format("pixels; must be a whole number from 1 to {}", most_map_pixels));
      if (!std::isfinite(axis->low) || !std::isfinite(axis->high) || !(axis->low < axis->high))
        reject(fmt::format("{} to {}", axis->low, axis->high),
               "must be two finite numbers, the first below the second");
    }
    if (map_.x.pixels > most_pixels / map_.y.pixels)
      throw InputError("map", "size", fmt::format("{}x{}", map_.x.pixels, map_.y.pixels),
                       fmt::format("pixels in all; must be at most {:.0f} million", 1e-6 * most_pixels));
    if (map_.x.key == map_.y.key) throw InputError("map", map_.x.key, "", "both axes vary the same key; must be two");
    for (const AngleLink& link : map_.links)
      if (std::min(link.ball, link.of) < 1 || std::max(link.ball, link.of) > map_.study.parameters.balls ||
          link.ball == link.of)
        throw InputError("map", "links", fmt::format("phi_{} = phi_{} + {}", link.ball, link.of, link.offset),
                         fmt::format("must name two different balls from 1 to {}", map_.study.parameters.balls));
    for (const int column : {0, map_.x.pixels - 1})
      for (const int row : {0, map_.y.pixels - 1}) check_offers(study_at(column, row), model::Answer::maps);
  }

  void prepare() {
    const std::size_t size = static_cast<std::size_t>(map_.x.pixels) * static_cast<std::size_t>(map_.y.pixels);
    map_.threads = thread_count(settings_.threads);
    map_.cpu_target = cpu_target();
    pixels_.resize(size);
    map_.balance_margin.assign(size, std::numeric_limits<double>::quiet_NaN());
    map_.balance_growth = map_.balance_margin;
  }

  Study study_at(int column, int row) const {
    Study study = study_with(map_.study, map_.x.key, map_.x.centre(column));
    study = study_with(study, map_.y.key, map_.y.centre(row));
    tie(study.initial, map_.links);
    return study;
  }

  void compute_starts() {
    map_.study = with_horizon(map_.study);
    std::fill(map_.balance_margin.begin(), map_.balance_margin.end(), balance_margin(map_.study.parameters));
    std::fill(map_.balance_growth.begin(), map_.balance_growth.end(), balance_growth(map_.study.system()));
    pixels_ = start_pixels(map_, settings_);
  }

  void compute_lines() {
    if (!map_.study.numerics.horizon) map_.study.numerics.horizon = default_horizon;
    tbb::task_arena arena(map_.threads);
    arena.execute([&] {
      tbb::parallel_for(
          0, lines_along_y_ ? map_.x.pixels : map_.y.pixels, [&](int line) { compute_line(line); },
          tbb::simple_partitioner());
    });
  }

  bool stopped() const { return is_set(settings_.stop); }

  void compute_line(int line) {
    const int length = lines_along_y_ ? map_.y.pixels : map_.x.pixels;
    std::vector<KnownOrbit> known;
    double growth = 0.0;
    for (int k = 0; k < length; ++k) {
      if (stopped()) return;
      const int column = lines_along_y_ ? line : k, row = lines_along_y_ ? k : line;
      const Study study = study_at(column, row);
      const std::size_t at = map_.at(column, row);
      const model::System system = study.system();
      if (k == 0 || !one_system_) growth = balance_growth(system);
      map_.balance_growth[at] = growth;
      map_.balance_margin[at] = balance_margin(study.parameters);
      pixels_[at] = outcome_of(study, system, known);
      report();
    }
  }

  MapPixel outcome_of(const Study& study, const model::System& system, std::vector<KnownOrbit>& known) const {
    const model::Parameters& p = study.parameters;
    const std::unique_ptr<SpinUp> source = make_spin_up(study, settings_.stop);
    SpunUp start;
    MapPixel pixel;
    if (overlap(p, study.initial.phi.data())) {  // no such start
      pixel.code = failed_code;
      return pixel;
    }
    if (!source->follow({study.initial}, start)) return pixel;
    const auto [fate, settling] = follow_start(study, system, *source, start, known, nullptr);
    if (one_system_ && system.smooth()) remember(system, settling, known);
    pixel.time = fate.time;
    pixel.code = store::code_of(fate);
    if (!settling.motion || !settling.motion->stable) return pixel;
    pixel.motion = std::make_shared<MotionName>(motion_name(p, *settling.motion));
    pixel.r_max = settling.motion->r_max;
    return pixel;
  }

  static void remember(const model::System& system, const Settling& settling, std::vector<KnownOrbit>& known) {
    if (!settling.motion || settling.motion->kind != MotionKind::periodic || settling.known) return;
    known.insert(known.begin(), known_orbit(system, *settling.motion));
    if (known.size() > most_known) known.pop_back();
  }

  void report() {
    if (!settings_.progress) return;
    const std::lock_guard lock(reporting_);
    settings_.progress({++done_, pixels_.size(), "pixels", {}});
  }

  // Counts codes; gives free ones to names without: the usual ones first, then in the order of pixels.
  void give_codes() {
    std::map<std::string, short> free_codes;
    for (const char* name : usual_names) free_codes.emplace(name, first_free_id + free_codes.size());
    std::map<short, MapCode> attractors;
    std::map<short, std::size_t> counts;
    std::size_t total = 0;
    for (MapPixel& pixel : pixels_) {
      if (const MotionName* m = pixel.motion.get()) {
        pixel.code = static_cast<short>(m->id);
        if (m->id == 0)
          pixel.code = free_codes.emplace(m->name, static_cast<short>(first_free_id + free_codes.size())).first->second;
        attractors.emplace(pixel.code, MapCode{pixel.code, m->name, m->alias, {}});
      }
      ++counts[pixel.code];
      if (pixel.code == not_computed_code)
        map_.complete = false;
      else
        ++total;
      map_.code.push_back(pixel.code);
      map_.time.push_back(pixel.time);
      map_.r_max.push_back(pixel.r_max);
    }
    for (const auto& [code, entry] : attractors) map_.codes.push_back(entry);
    map_.codes.push_back({undecided_code, name_of(Outcome::undecided), "", {}});
    map_.codes.push_back({diverged_code, name_of(Outcome::diverged), "", {}});
    map_.codes.push_back({failed_code, name_of(Outcome::failed), "", {}});
    if (map_.study.speed.driven()) map_.codes.push_back({stalled_code, name_of(Outcome::stalled), "", {}});
    for (MapCode& entry : map_.codes) entry.share = wilson_share(counts[entry.code], total);
  }

  const PlaneMapSettings& settings_;
  bool one_system_;  // all pixels of a line have the same parameters
  bool lines_along_y_;
  PlaneMap map_;
  std::vector<MapPixel> pixels_;
  std::mutex reporting_;
  std::size_t done_ = 0;
};

}  // namespace

PlaneMap plane_map(const Study& study, const PlaneMapSettings& settings) {
  const ChosenCpuTarget chosen(settings.cpu_target);
  return reported(settings, [&](const PlaneMapSettings& s) { return Mapper(study, s).run(); });
}

}  // namespace equipoise

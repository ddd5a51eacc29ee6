// Stated choices for three open questions, and answers by basin slices and ensembles.
#include "equipoise/extras/reproduction/reproduction.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "equipoise/analyses/basin_slices/basin_slice.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/extras/literature/published_tables.hpp"

namespace equipoise {

namespace {

constexpr std::array speeds{2.0, 2.2, 2.4, 3.0, 4.0, 5.0};

Study rotor_at(double speed) {
  Study study = paper_rotor();
  study.name = fmt::format("future work at speed {}", speed);
  study.speed.speed = speed;
  return study;
}

SamplingBox stated_box() {
  SamplingBox box;
  box.x = box.y = {-0.2, 0.2};
  box.x_dot = box.y_dot = {-0.5, 0.5};
  box.phi_dot = {-2.4, 2.4};
  return box;
}

// Per sample; two samples per speed.
constexpr std::uint64_t most_starts = 20000;

// A part's progress is reported under its name.
void use(const ReproduceOptions& settings, const std::string& part, RunOptions& options) {
  options.threads = settings.threads;
  options.stop = settings.stop;
  if (!settings.progress) return;
  options.progress = [&settings, part](Progress p) {
    p.what = p.preparing ? part + ", " + p.what : part;
    settings.progress(p);
  };
}

BasinSlice mapped(const Study& study, const ReproduceOptions& settings, const std::string& part, const SliceAxis& x,
                  const SliceAxis& y, const std::vector<AngleLink>& links) {
  BasinSliceSettings map;
  map.x = x;
  map.y = y;
  map.links = links;
  use(settings, part, map);
  return basin_slice(study, map);
}

BasinResult sampled(Study study, const SamplingBox& box, const ReproduceOptions& settings,
                    AttractorSearchCache& searches, const std::string& file, const std::string& part) {
  study.sampling.starts = settings.starts > 0 ? std::min(settings.starts, most_starts) : most_starts;
  study.sampling.box = box;
  BasinOptions options;
  use(settings, part, options);
  options.searches = &searches;
  if (!settings.folder.empty())
    options.output = fmt::format("{}/{}-speed-{}.nc", settings.folder, file, study.speed.speed);
  return basin(study, options);
}

}  // namespace

OpenQuestions open_questions(const ReproduceOptions& settings) {
  const int pixels = settings.slice_pixels;
  const SliceAxis angle{"initial.phi_1", 0.0, two_pi, pixels};
  OpenQuestions result;
  result.eccentricity_and_angle = mapped(rotor_at(2.4), settings, "map of eccentricity and angle",
                                         {"rotor.eccentricity", 0.0, 0.12, pixels}, angle, {{2, 1, pi}});
  Study opposite = rotor_at(2.4);
  opposite.initial.phi[0] = -0.5 * pi;
  opposite.initial.phi[1] = 0.5 * pi;
  result.eccentricity_and_mass =
      mapped(opposite, settings, "map of eccentricity and mass", {"rotor.eccentricity", 0.0, 0.1, pixels},
             {"balancer.mass", 0.0, 0.1, pixels}, {});
  result.complete = result.eccentricity_and_angle.complete && result.eccentricity_and_mass.complete;
  for (const double speed : speeds) {
    if (is_set(settings.stop)) break;
    BoxShares shares{speed, {}, {}};
    AttractorSearchCache searches;  // both samples end at one speed
    shares.box =
        sampled(rotor_at(speed), stated_box(), settings, searches, "box", fmt::format("box at speed {}", speed));
    shares.rest =
        sampled(rotor_at(speed), {}, settings, searches, "rest", fmt::format("starts at rest at speed {}", speed));
    result.complete = result.complete && !shares.box.partial && !shares.rest.partial;
    result.boxes.push_back(std::move(shares));
  }
  result.complete = result.complete && result.boxes.size() == speeds.size();
  return result;
}

}  // namespace equipoise

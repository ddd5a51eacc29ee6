// The settings in the paper's captions, and the resulting curves.
#include "equipoise/extras/reproduction/reproduction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include <fmt/format.h>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/extras/literature/published_tables.hpp"
#include "equipoise/machine/mechanics/frames.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "equipoise/study/sampling/starts.hpp"

namespace equipoise {

namespace {

using model::SpeedLaw;
constexpr double quarter = 0.5 * pi;
constexpr std::array both_laws{SpeedLaw::published, SpeedLaw::kinematic};
constexpr double sampling = 0.1;             // at least fifteen samples in the fastest oscillation of r
constexpr std::size_t longest_curve = 1800;  // points per curve in a picture
constexpr double omitted_duration = 500.0;   // T0 where a caption omits it

// Keeps the smallest and largest value of every bucket, in their order: the envelope survives at any width.
void thin(std::vector<double>& t, std::vector<double>& r) {
  if (t.size() <= longest_curve) return;
  const std::size_t buckets = longest_curve / 2;
  std::vector<double> t_thin, r_thin;
  for (std::size_t b = 0; b < buckets; ++b) {
    const std::size_t first = b * t.size() / buckets, last = (b + 1) * t.size() / buckets;
    const auto [low, high] = std::minmax_element(r.begin() + static_cast<std::ptrdiff_t>(first),
                                                 r.begin() + static_cast<std::ptrdiff_t>(last));
    for (const auto at : {std::min(low, high), std::max(low, high)}) {
      t_thin.push_back(t[static_cast<std::size_t>(at - r.begin())]);
      r_thin.push_back(*at);
    }
  }
  t = std::move(t_thin);
  r = std::move(r_thin);
}

FigureSeries curve(const Study& study, const std::string& label, double until, const StopFlag* stop) {
  const double spacing = std::min(sampling, until / 400.0);
  std::vector<double> times;
  for (std::size_t i = 0; spacing * static_cast<double>(i) <= until; ++i)
    times.push_back(spacing * static_cast<double>(i));
  RunOptions options;
  options.stop = stop;
  const Trajectory trajectory = simulate(study, times, options);
  FigureSeries series{label, study.speed.law, trajectory.t, trajectory.radial, to_toml(study)};
  thin(series.t, series.r);
  return series;
}

Study ramp_study(double zeta, double beta, double final, double duration, double release, SpeedLaw law) {
  Study study = paper_rotor(zeta, beta);
  study.speed.profile = Profile::ramp;
  study.speed.final = final;
  study.speed.duration = duration;
  study.speed.law = law;
  study.release.speed = release;
  study.initial.phi[0] = -quarter;
  study.initial.phi[1] = quarter;
  study.name = "figure";
  return study;
}

// A state on the motion that the paper calls `alias`: the first random start that ends in it. V1 exists where the balls
// coincide. Only one start in thirty thousand ends in V4, so a known state is used.
std::optional<Eigen::VectorXd> state_on(const std::string& alias, const model::Parameters& p, double speed,
                                        const StopFlag* stop) {
  constexpr std::uint64_t tries = 400;
  for (std::uint64_t index = 0; index < tries && !is_set(stop); ++index) {
    Eigen::VectorXd state = Eigen::VectorXd::Zero(model::dimension(p.balls));
    double phi[2];
    start_angles(1, index, 2, phi);
    if (alias == "V1") phi[1] = phi[0];
    if (alias == "V4" && index == 0) phi[0] = 5.54933, phi[1] = 5.46019;
    for (int i = 0; i < 2; ++i) state[model::index::phi(i)] = phi[i];
    const auto motion = motion_from({p, speed}, state);
    if (motion && motion->stable && motion_name(p, *motion).alias == alias) return motion->state;
  }
  return {};
}

FigurePanel attractor_panel(const std::string& alias, double speed, double until, const StopFlag* stop) {
  Study study = paper_rotor();
  study.name = "figure";
  study.speed.speed = speed;
  FigurePanel panel{fmt::format("{}, Ω = {}", alias, speed), {}};
  const auto z = state_on(alias, study.parameters, speed, stop);
  if (!z) return panel;
  using namespace model::index;
  const auto velocity = model::rotating_velocity(speed, z->data());
  InitialState& s = study.initial;
  std::tie(s.x, s.y, s.x_dot, s.y_dot) = std::tuple((*z)[x], (*z)[y], velocity[0], velocity[1]);
  for (int i = 0; i < 2; ++i) std::tie(s.phi[i], s.phi_dot[i]) = std::tuple((*z)[phi(i)], (*z)[q(i, 2)]);
  panel.series.push_back(curve(study, alias, until, stop));
  return panel;
}

using Panels = std::vector<FigurePanel>;

Panels attractors(const StopFlag* stop) {
  Panels panels;
  for (const auto& [alias, speed] : {std::pair{"V1", 2.2}, {"V2", 2.2}, {"V3", 4.4}, {"V4", 4.4}})
    panels.push_back(attractor_panel(alias, speed, 50.0, stop));
  return panels;
}

Panels transients(const StopFlag* stop) {
  Panels panels;
  for (const double duration : {1e-4, 0.1, 5.0, 50.0, 100.0, 300.0}) {
    FigurePanel& panel = panels.emplace_back(FigurePanel{fmt::format("T0 = {}", duration), {}});
    for (const SpeedLaw law : both_laws)
      panel.series.push_back(curve(ramp_study(0.5, 0.05, 2.4, duration, 2.4, law), fmt::format("{} law", name_of(law)),
                                   duration + 200.0, stop));
  }
  return panels;
}

// Balls released at the end of the ramp and at `early`: one panel per law, one curve per release speed.
void add_releases(Panels& panels, const std::string& title, double zeta, double beta, double final, double early,
                  double until, const StopFlag* stop) {
  for (const SpeedLaw law : both_laws) {
    FigurePanel& panel = panels.emplace_back(FigurePanel{fmt::format("{}{} law", title, name_of(law)), {}});
    for (const double release : {final, early})
      panel.series.push_back(curve(ramp_study(zeta, beta, final, omitted_duration, release, law),
                                   fmt::format("({}) released at {}", release == final ? "i" : "ii", release), until,
                                   stop));
  }
}

Panels ball_lag(const StopFlag* stop) {
  Panels panels;
  add_releases(panels, "", 0.02, 0.01, 5.0, 2.0, 1500.0, stop);
  return panels;
}

Panels releases(const StopFlag* stop) {
  Panels panels;
  for (const auto& [zeta, beta] : {std::pair{0.02, 0.01}, {0.02, 0.25}, {0.5, 0.05}, {0.5, 0.25}})
    add_releases(panels, fmt::format("ζ = {}, β = {}: ", zeta, beta), zeta, beta, 2.4, 2.2, 900.0, stop);
  return panels;
}

constexpr char no_duration_in_caption[] =
    "The caption gives no T0. Chosen: T0 = 500, the duration that the paper fixes for its table 4 and that its tables "
    "5 and 6 share.";

struct FigureRecipe {
  const char *id, *title, *caption, *choice;
  Panels (*panels)(const StopFlag* stop);
};
constexpr std::array<FigureRecipe, 4> recipes{{
    {"figure-attractors", "The vibrating attractors V1 to V4",
     "Radial displacement r against time on the motions other than balance, at constant speed; β = 0.05, ζ = 0.5. V1: "
     "balls coincident; V2: a torus, never quite repeating; V3: one ball captured; V4: the same with four times the "
     "period.",
     "", attractors},
    {"figure-transients", "Transients after ramps of six durations",
     "r against time: ramp 0 to 2.4 in T0, balls clamped at φ = −π/2, π/2 and released at 2.4; β = 0.05, ζ = 0.5.",
     "The caption starts both balls at −π and π, which is one point; −π/2 and π/2, as in the later figures, makes "
     "them opposite, as the text says.",
     transients},
    {"figure-ball-lag", "Ball lag: released at the end of the ramp or on the way",
     "r against time: ramp 0 to 5, balls at φ = −π/2, π/2 released at 5 (i) and at 2 (ii); β = 0.01, ζ = 0.02. Balls "
     "released early lag behind the rotor while it speeds up.",
     no_duration_in_caption, ball_lag},
    {"figure-release", "Release at 2.4 against 2.2",
     "r against time: ramp 0 to 2.4, balls at φ = −π/2, π/2 released at 2.4 (i) and at 2.2 (ii), for four pairs of "
     "external and internal damping.",
     no_duration_in_caption, releases},
}};

}  // namespace

std::vector<std::string> paper_figure_ids() {
  std::vector<std::string> ids;
  for (const FigureRecipe& recipe : recipes) ids.emplace_back(recipe.id);
  return ids;
}

PaperFigure paper_figure(const std::string& id, const StopFlag* stop) {
  for (const FigureRecipe& r : recipes)
    if (r.id == id) return {r.id, r.title, r.caption, r.choice, r.panels(stop)};
  throw InputError("figure", "", id, "must be one of paper_figure_ids()");
}

std::string figure_csv(const PaperFigure& figure) {
  std::string text = fmt::format("# {}. {}\n", figure.title, figure.caption);
  if (!figure.choice.empty()) text += fmt::format("# {}\n", figure.choice);
  text +=
      "# r: distance of the rotor's centre from the axis, in race radii; t in 1/omega_c. Long curves are thinned to "
      "their envelope.\n";
  for (const FigurePanel& panel : figure.panels)
    for (const FigureSeries& s : panel.series) {
      text += fmt::format("# study of {}, {}:\n#   ", panel.title, s.label);
      for (const char c : s.study) text += c == '\n' ? std::string("\n#   ") : std::string(1, c);
      text += "\n";
    }
  text += "panel,series,law,t,r\n";
  for (const FigurePanel& panel : figure.panels)
    for (const FigureSeries& s : panel.series)
      for (std::size_t i = 0; i < s.t.size(); ++i)
        text += fmt::format("\"{}\",\"{}\",{},{},{}\n", panel.title, s.label, name_of(s.law), s.t[i], s.r[i]);
  return text;
}

}  // namespace equipoise

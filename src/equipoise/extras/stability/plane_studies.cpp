// Checks the axes and makes the studies, one at a time.
#include "equipoise/extras/stability/plane_studies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "equipoise/analyses/basin_slices/slice_axis.hpp"
#include "equipoise/analyses/continuation/parameter_line.hpp"
#include "equipoise/analyses/one_study/balanced_rates.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/study/contents/keys.hpp"
#include "equipoise/study/reading/rules.hpp"

namespace equipoise {

namespace {

void check_size(const SliceAxis& x, const SliceAxis& y) {
  const std::uint64_t points = static_cast<std::uint64_t>(x.pixels) * static_cast<std::uint64_t>(y.pixels);
  if (points > most_stability_points)
    throw InputError("stability", "size", fmt::format("{}x{}", x.pixels, y.pixels),
                     fmt::format("points; must be at most {:.1f} million in all (4096x4096)",
                                 1e-6 * static_cast<double>(most_stability_points)));
}

void check_key(const std::string& key) {
  const std::string table = key.substr(0, key.find('.'));
  if ((table != "rotor" && table != "balancer" && table != "speed") || table == key || key == "balancer.balls")
    throw InputError("stability", key, "",
                     "must be a key of rotor, balancer or speed that takes a number, or speed.final; balance does not "
                     "depend on starts");
}

// The errors of reading such a study, with the value that is to blame.
Study checked_with(const Study& study, const std::string& key, double value) {
  try {
    return study_with(study, key, value);
  } catch (const InputError& e) {
    throw InputError("stability", key, fmt::format("{:.6g}", value), e.problem());
  }
}

}  // namespace

PlaneStudies::PlaneStudies(const Study& study, const SliceAxis& x, const SliceAxis& y,
                           const std::function<void(const Study&)>& check)
    : study_(study), x_(x), y_(y) {
  check_axes(x, y, "stability", "points");
  check_size(x, y);
  check_key(x.key);
  check_key(y.key);
  std::vector<std::string> corners;
  for (const double at_y : {y.centre(0), y.centre(y.pixels - 1)})
    for (const double at_x : {x.centre(0), x.centre(x.pixels - 1)}) {
      const Study there = checked_with(checked_with(study_, x.key, at_x), y.key, at_y);
      if (check) check(there);
      corners.push_back(to_toml(there));
    }
  if (x.pixels > 1 && corners[0] == corners[1])
    throw InputError("stability", x.key, "", fmt::format(set_by_other_axis, y.key));
}

Study PlaneStudies::read(double x, double y) const { return study_with(study_with(study_, x_.key, x), y_.key, y); }

Study PlaneStudies::at(double x, double y) const {
  const std::array<study::NumberAt, 2> numbers{{{x_.key, x}, {y_.key, y}}};
  Study study = study_;
  if (study::put_numbers(study, numbers)) return study;
  return read(x, y);
}

bool PlaneStudies::valid(double x, double y) const {
  try {
    read(x, y);
  } catch (const InputError&) {
    return false;
  }
  return true;
}

std::optional<double> PlaneStudies::own(const std::string& key) const {
  Study study = study_;
  const std::vector<double*> places = study::numbers_of(study, key).places;
  const auto differs = [&](const double* place) { return *place != *places.front(); };
  if (places.empty() || std::any_of(places.begin(), places.end(), differs)) return std::nullopt;
  return *places.front();
}

std::optional<Study> PlaneStudies::study_at(const Eigen::VectorXd& at) const {
  try {
    return this->at(x(at), y(at));
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::optional<model::System> PlaneStudies::system(const Eigen::VectorXd& at) const {
  const auto study = study_at(at);
  std::optional<model::System> found;
  if (study) found.emplace(study->system());
  if (found && found->prescribed() && found->speed() == 0.0) return std::nullopt;
  return found;
}

std::optional<BalanceSpectrum> PlaneStudies::spectrum(const Eigen::VectorXd& at) const {
  const auto study = study_at(at);
  return study ? balance_spectrum(*study) : std::nullopt;
}

std::optional<double> PlaneStudies::margin(const Eigen::VectorXd& at) const {
  const auto study = study_at(at);
  return study ? std::optional(balance_margin(study->parameters)) : std::nullopt;
}

std::optional<BalanceSpectrum> PlaneStudies::in_line(const Eigen::VectorXd& at) const {
  const auto study = study_at(at);
  if (!study || !study->system().prescribed() || study->parameters.tilts()) return std::nullopt;
  const model::System system(study->parameters, study->system().speed());
  const model::Parameters& p = study->parameters;
  double phi[model::max_balls];
  int heaviest = 0;
  for (int i = 0; i < p.balls; ++i) {
    if (p.mass[static_cast<std::size_t>(i)] > p.mass[static_cast<std::size_t>(heaviest)]) heaviest = i;
    phi[i] = pi;
  }
  const bool ball_outweighs = p.mass[static_cast<std::size_t>(heaviest)] > p.eccentricity;
  for (int i = 0; i < p.balls; ++i)
    if (ball_outweighs && i != heaviest) phi[i] = 0.0;
  BalanceSpectrum found{system, model::centred_state(p, phi), {}, {}, false};
  found.jacobian = model::jacobian(p, system.speed(), found.state.data());
  found.rates = without_continuum(dense::eigenvalues(found.jacobian), 0, 0.0);
  return found;
}

}  // namespace equipoise

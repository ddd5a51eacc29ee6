// Puts values into the members of the table of keys, where that gives the same studies as reading them.
#include "equipoise/extras/stability/plane_studies.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "equipoise/analyses/continuation/parameter_line.hpp"
#include "equipoise/analyses/words/sweeps.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/extras/words/stability.hpp"
#include "equipoise/study/contents/keys.hpp"

namespace equipoise {

namespace {

// The numbers of a study that a dimensionless key sets, all to one value. Empty for other keys.
std::vector<double*> places_of(Study& study, const std::string& key) {
  if (key == "speed.final") {
    if (study.speed.profile == Profile::constant) return {&study.speed.speed};
    if (study.speed.profile == Profile::points) return {&study.speed.speeds.back()};
    return {&study.speed.final};
  }
  const std::size_t dot = std::min(key.rfind('.'), key.size());
  const study::KeyTable* table = study::find_keys(key.substr(0, dot));
  const study::Key* found = table && dot < key.size() ? table->find(key.substr(dot + 1), false) : nullptr;
  if (!found) return {};
  const auto count = static_cast<std::size_t>(study.parameters.balls);
  return std::visit(
      [&](auto member) -> std::vector<double*> {
        using M = decltype(member);
        std::vector<double*> places;
        if constexpr (std::is_same_v<M, double*>)
          places = {member};
        else if constexpr (std::is_same_v<M, std::optional<double>*>)
          places = *member ? std::vector<double*>{&**member} : std::vector<double*>{};
        else if constexpr (std::is_same_v<M, std::array<double, 2>*>)
          places = {&(*member)[0], &(*member)[1]};
        else if constexpr (std::is_same_v<M, std::array<double, model::max_balls>*>)
          for (std::size_t i = 0; i < count; ++i) places.push_back(&(*member)[i]);
        return places;
      },
      found->member(study));
}

void put_value(Study& study, const std::string& key, double value) {
  for (double* place : places_of(study, key)) *place = value;
}

void check_axis(const SliceAxis& axis) {
  const auto reject = [&](const std::string& value, const std::string& problem) {
    throw InputError("stability", axis.key, value, problem);
  };
  if (axis.pixels < 1 || axis.pixels > most_slice_pixels)
    reject(fmt::format("{}", axis.pixels), fmt::format(words::stability::points_range, most_slice_pixels));
  if (!std::isfinite(axis.low) || !std::isfinite(axis.high) || !(axis.low < axis.high))
    reject(fmt::format("{} to {}", axis.low, axis.high), words::stability::rising_range);
}

void check_size(const SliceAxis& x, const SliceAxis& y) {
  const std::uint64_t points = static_cast<std::uint64_t>(x.pixels) * static_cast<std::uint64_t>(y.pixels);
  if (points > most_stability_points)
    throw InputError("stability", "size", fmt::format("{}x{}", x.pixels, y.pixels),
                     fmt::format(words::stability::too_many_points, 1e-6 * static_cast<double>(most_stability_points)));
}

void check_key(const std::string& key) {
  const std::string table = key.substr(0, key.find('.'));
  if ((table != "rotor" && table != "balancer" && table != "speed") || table == key || key == "balancer.balls")
    throw InputError("stability", key, "", words::stability::key_of_axis);
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
  check_axis(x);
  check_axis(y);
  check_size(x, y);
  check_key(x.key);
  check_key(y.key);
  if (x.key == y.key) throw InputError("stability", x.key, "", words::sweeps::same_key_twice);
  direct_ = !places_of(study_, x.key).empty() && !places_of(study_, y.key).empty();
  std::vector<std::string> corners;
  for (const double at_y : {y.centre(0), y.centre(y.pixels - 1)})
    for (const double at_x : {x.centre(0), x.centre(x.pixels - 1)}) {
      const Study there = checked_with(checked_with(study_, x.key, at_x), y.key, at_y);
      if (check) check(there);
      corners.push_back(to_toml(there));
      if (!direct_) continue;
      Study put_there = study_;
      put_value(put_there, x.key, at_x);
      put_value(put_there, y.key, at_y);
      direct_ = to_toml(put_there) == corners.back();
    }
  if (x.pixels > 1 && corners[0] == corners[1])
    throw InputError("stability", x.key, "", fmt::format(words::sweeps::set_by_other_axis, y.key));
}

Study PlaneStudies::read(double x, double y) const { return study_with(study_with(study_, x_.key, x), y_.key, y); }

void PlaneStudies::put(double x, double y, Study& study) const {
  if (direct_) {
    put_value(study, x_.key, x);
    put_value(study, y_.key, y);
  } else {
    study = read(x, y);
  }
}

bool PlaneStudies::valid(double x, double y) const {
  try {
    read(x, y);
  } catch (const InputError&) {
    return false;
  }
  return true;
}

Study PlaneStudies::at(double x, double y) const {
  Study study = study_;
  put(x, y, study);
  return study;
}

std::optional<double> PlaneStudies::own(const std::string& key) const {
  Study study = study_;
  const std::vector<double*> places = places_of(study, key);
  const auto differs = [&](const double* place) { return *place != *places.front(); };
  if (places.empty() || std::any_of(places.begin(), places.end(), differs)) return std::nullopt;
  return *places.front();
}

}  // namespace equipoise

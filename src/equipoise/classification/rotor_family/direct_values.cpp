// A study's parameters as a list of numbers, and the places that values take in it.
#include "equipoise/classification/rotor_family/direct_values.hpp"

#include <array>

namespace equipoise {

namespace {

std::vector<double*> numbers_of(model::Parameters& p) {
  std::vector<double*> all{&p.eccentricity, &p.gravity, &p.inertia, &p.contact_angle, &p.restitution};
  for (auto* pair : {&p.damping, &p.stiffness, &p.race_offset})
    for (double& v : *pair) all.push_back(&v);
  model::Tilt& t = p.tilt;
  all.insert(all.end(), {&p.eccentricity_angle, &t.transverse_inertia, &t.polar_inertia, &t.misalignment});
  for (auto* supports : {&t.damping, &t.stiffness})
    for (auto& pair : *supports)
      for (double& v : pair) all.push_back(&v);
  for (auto* balls : {&p.mass, &p.drag, &p.rolling, &p.stiction, &p.ball_radius, &t.plane})
    for (int i = 0; i < p.balls; ++i) all.push_back(&(*balls)[static_cast<std::size_t>(i)]);
  return all;
}

}  // namespace

std::optional<DirectValues> DirectValues::of(const std::function<Study(std::span<const double>)>& make,
                                             const std::vector<std::vector<double>>& some) {
  DirectValues result;
  std::vector<Study> made;
  for (const std::vector<double>& values : some) made.push_back(make(values));
  result.base_ = made.front();
  result.places_.resize(some.front().size());
  const std::size_t count = numbers_of(result.base_.parameters).size();
  for (std::size_t n = 0; n < count; ++n)
    for (std::size_t k = 0; k < result.places_.size(); ++k) {
      bool is_value = true, differs = false;
      for (std::size_t i = 0; i < made.size(); ++i) {
        const double number = *numbers_of(made[i].parameters)[n];
        is_value = is_value && number == some[i][k];
        differs = differs || number != *numbers_of(made.front().parameters)[n];
      }
      if (is_value && differs) result.places_[k].push_back(n);
    }
  for (std::size_t i = 0; i < made.size(); ++i)
    if (to_toml(result.at(some[i])) != to_toml(made[i])) return std::nullopt;
  return result;
}

Study DirectValues::at(std::span<const double> values) const {
  Study study = base_;
  const std::vector<double*> numbers = numbers_of(study.parameters);
  for (std::size_t k = 0; k < places_.size(); ++k)
    for (const std::size_t n : places_[k]) *numbers[n] = values[k];
  return study;
}

}  // namespace equipoise

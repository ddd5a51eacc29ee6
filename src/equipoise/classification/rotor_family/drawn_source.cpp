// Draws rotors by index.
#include "equipoise/classification/rotor_family/drawn_source.hpp"

#include <utility>
#include <vector>

#include "equipoise/core/base/error.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"

namespace equipoise {

DrawnSource::DrawnSource(const StudyFamily& family, const FamilyBox& box, const StopFlag* stop)
    : SpinUp(at_final_speed(family.at(family.values_at(box.centre()))), stop),
      family_(family),
      box_(box),
      middle_(make_spin_up(study_, stop)) {}

// Draw `index`, or the middle if the draw is not a valid study or cannot share lanes with it.
StudyFamily::Placed DrawnSource::drawn(std::uint64_t index) const {
  try {
    Study study = at_final_speed(family_.draw(box_, index));
    if (ride_together(study.system(), study_.system()))
      return {family_.coordinates(box_, box_.at(family_.place(index))), std::move(study)};
  } catch (const InputError&) {
  }
  return {family_.coordinates(box_, box_.centre()), study_};
}

OwnRotor DrawnSource::rotor(std::uint64_t index) const {
  const auto [coordinates, study] = drawn(index);
  OwnRotor rotor = own_rotor(study.system());
  rotor.coordinates = coordinates;
  return rotor;
}

std::vector<OwnRotor> DrawnSource::ends() const {
  std::vector<OwnRotor> rotors;
  for (const auto& [coordinates, study] : family_.ends(box_)) {
    const model::System system = at_final_speed(study).system();
    if (!ride_together(system, study_.system())) continue;
    rotors.push_back(own_rotor(system));
    rotors.back().coordinates = coordinates;
  }
  return rotors;
}

template <class StartOf>
bool DrawnSource::set_off(std::size_t first, std::size_t count, const StartOf& start_at, SpunUp& starts,
                          TransientTable* transients) const {
  std::vector<std::vector<double>> places;
  std::vector<OwnRotorStart> own;
  for (std::size_t k = 0; k < count; ++k) {
    auto [coordinates, study] = drawn(first + k);
    const InitialState start = start_at(study, k);
    own.push_back({std::move(study), start});
    places.push_back(std::move(coordinates));
  }
  if (!spin_up_own_rotors(own, stop_, starts, transients)) return false;
  for (std::size_t k = 0; k < count; ++k) starts.rotors[k].coordinates = std::move(places[k]);
  return true;
}

bool DrawnSource::make(std::uint64_t seed, std::uint64_t first, std::size_t count, SpunUp& starts,
                       TransientTable* transients) const {
  const auto start = [&](const Study& study, std::size_t k) {
    return parted(study.parameters, start_of(study, seed, first + k));
  };
  return set_off(first, count, start, starts, transients);
}

bool DrawnSource::follow(std::span<const InitialState> given, SpunUp& starts, TransientTable* transients) const {
  return set_off(
      0, given.size(), [&](const Study&, std::size_t k) { return given[k]; }, starts, transients);
}

}  // namespace equipoise

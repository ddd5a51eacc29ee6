// Draws by number.
#include "equipoise/discovery/drawn_source.hpp"

#include <vector>

#include "equipoise/base/error.hpp"
#include "equipoise/spin_up/initial_state.hpp"

namespace equipoise {

DrawnSource::DrawnSource(const StudyFamily& family, const FamilyBox& box, const StopFlag* stop)
    : family_(family),
      box_(box),
      stop_(stop),
      study_(at_final_speed(family.at(family.values_at(box.centre())))),
      middle_(make_spin_up(study_, stop)) {}

// Empty where draw `index` makes no study that rides with the middle.
std::optional<Study> DrawnSource::drawn(std::uint64_t index) const {
  try {
    Study study = at_final_speed(family_.draw(box_, index));
    if (ride_together(study.system(), study_.system())) return study;
  } catch (const InputError&) {
  }
  return std::nullopt;
}

// Of a draw, or of the middle in its stead.
std::vector<double> DrawnSource::coordinates(bool is_drawn, std::uint64_t index) const {
  return family_.coordinates(box_, is_drawn ? box_.at(family_.place(index)) : box_.centre());
}

OwnRotor DrawnSource::rotor(std::uint64_t index) const {
  const std::optional<Study> study = drawn(index);
  OwnRotor rotor = own_rotor((study ? *study : study_).system());
  rotor.coordinates = coordinates(study.has_value(), index);
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

bool DrawnSource::make(std::uint64_t seed, std::uint64_t first, std::size_t count, SpunUp& starts,
                       TransientTable* transients) const {
  std::vector<OwnStart> own;
  for (std::size_t i = 0; i < count; ++i) {
    Study study = drawn(first + i).value_or(study_);
    const InitialState start = parted(study.parameters, start_of(study, seed, first + i));
    own.push_back({std::move(study), start});
  }
  return set_off(own, first, starts, transients);
}

bool DrawnSource::follow(std::span<const InitialState> given, SpunUp& starts, TransientTable* transients) const {
  std::vector<OwnStart> own;
  for (std::size_t i = 0; i < given.size(); ++i) own.push_back({drawn(i).value_or(study_), given[i]});
  return set_off(own, 0, starts, transients);
}

bool DrawnSource::set_off(const std::vector<OwnStart>& own, std::uint64_t first, SpunUp& starts,
                          TransientTable* transients) const {
  if (!spin_up_own(own, stop_, starts, transients)) return false;
  for (std::size_t i = 0; i < own.size(); ++i)
    starts.rotors[i].coordinates = coordinates(drawn(first + i).has_value(), first + i);
  return true;
}

}  // namespace equipoise

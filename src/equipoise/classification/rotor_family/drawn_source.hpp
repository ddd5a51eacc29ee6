// Starts with rotors drawn from a part of a family: the spin-up for a search over that part.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "equipoise/classification/rotor_family/study_family.hpp"
#include "equipoise/simulation/spin_up/spin_up.hpp"

namespace equipoise {

class DrawnSource final : public SpinUp {
 public:
  /// `family` and `box` must outlive this. Studies are taken at_final_speed().
  DrawnSource(const StudyFamily& family, const FamilyBox& box, const StopFlag* stop);

  bool make(std::uint64_t seed, std::uint64_t first, std::size_t count, SpunUp& starts,
            TransientTable* transients = nullptr) const override;
  /// Given start k has the rotor of draw k.
  bool follow(std::span<const InitialState> given, SpunUp& starts, TransientTable* transients = nullptr) const override;
  BatchTask last_task() const override { return middle_->last_task(); }

  std::vector<double> place(std::uint64_t index) const { return family_.place(index); }
  const Study& middle() const { return study_; }
  OwnRotor rotor(std::uint64_t index) const;
  /// The rotor at the box's centre, then those at its corners (StudyFamily::ends()).
  std::vector<OwnRotor> ends() const;

 private:
  StudyFamily::Placed drawn(std::uint64_t index) const;
  // With the rotors of draws `first` on; start_at(study, k) is start k.
  template <class StartOf>
  bool set_off(std::size_t first, std::size_t count, const StartOf& start_at, SpunUp& starts,
               TransientTable* transients) const;

  const StudyFamily& family_;
  const FamilyBox& box_;
  std::unique_ptr<SpinUp> middle_;
};

}  // namespace equipoise

// Spin-up of starts whose rotors differ.
#pragma once

#include <span>

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/simulation/spin_up/spin_up.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// A start and its study, without uncertain values and with its horizon.
struct OwnRotorStart {
  Study study;
  InitialState start;
};

/// As SpinUp::follow(), each start in the units of its own study; fills SpunUp::rotors. The last systems must fit
/// together (simulation/batch/own_rotor.hpp). `transients`, if given, holds the settings of each (TransientTable::own).
bool spin_up_own_rotors(std::span<const OwnRotorStart> starts, const StopFlag* stop, SpunUp& spun,
                        TransientTable* transients = nullptr);

}  // namespace equipoise

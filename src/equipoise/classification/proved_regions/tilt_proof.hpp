// Proofs about balance of a tilting rotor: two balls in each of two planes (docs/explanation/proof.md).
#pragma once

#include <string>

#include "equipoise/classification/proved_regions/certificate.hpp"

namespace equipoise {

inline constexpr char two_planes_of_two[] = "for tilting rotors, only two balls in each of two planes can be proved";
inline constexpr char plane_with_nothing_to_cancel[] =
    "a plane whose balls have nothing to cancel has a continuum of balanced states; proofs are for isolated ones";

/// Why no proof is tried of this tilting rotor; empty if one is.
std::string tilt_refusal(const model::System& system);

/// Verifies a certificate of a tilting rotor, which has no boxes: one bound on the equations' slope over the box
/// around V <= level proves that V decreases. `spare`: as spare_in_search.
CertificateResult check_tilt(const Certificate& certificate, double spare);

}  // namespace equipoise

// Proofs about a study's balanced states.
// This room: proofs about one study, and stability proved over boxes of parameters.
#pragma once

#include "equipoise/core/running/run_options.hpp"
#include "equipoise/extras/proof/certify_result.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Proves as large a level set as it can for each stable balanced state at the final speed, and checks the finished
/// certificate. A failed proof is no error: the result says why. Progress counts balanced states. After a stop the
/// result is partial: states not reached are not proved, and say so. Uses one thread. Throws InputError for anisotropic
/// supports, gravity, and balls that collide or stick.
CertifyResult certify(const Study& study, const RunOptions& options = {});

}  // namespace equipoise

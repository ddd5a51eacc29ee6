// From a study to proofs about its balanced states.
#pragma once

#include "equipoise/results/certify_result.hpp"
#include "equipoise/running/run_options.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// Proves, for each stable balanced state at the study's final speed, as large a level set as it can, and checks the
/// finished certificate. What cannot be proved is no error: the result says why.
/// Progress is in balanced states. After a stop the result is partial: states not done by then are not proved, and say
/// so. One thread does all. Throws InputError for anisotropic supports and gravity, and for balls that collide or
/// stick.
CertifyResult certify(const Study& study, const RunOptions& options = {});

}  // namespace equipoise

// From a study to proofs about its balanced states.
#pragma once

#include "equipoise/results/certify_result.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// Proves, for each stable balanced state at the study's final speed, as large a level set as it can, and checks the
/// finished certificate. What cannot be proved is no error: the result says why.
/// Throws InputError for anisotropic supports and gravity, as basin() does.
CertifyResult certify(const Study& study);

}  // namespace equipoise

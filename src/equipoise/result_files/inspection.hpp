// A look at any file that this program leaves.
#pragma once

#include <string>

#include "equipoise/results/inspection.hpp"

namespace equipoise {

/// Damage is told, not thrown: what is sound of an unfinished file is counted. Changes nothing. Throws InputError for
/// what cannot be read, is in use, or is no file of results.
Inspection inspect_file(const std::string& path);

}  // namespace equipoise

// Inspects any file that this program writes.
#pragma once

#include <string>

#include "equipoise/results/commands/inspection.hpp"

namespace equipoise {

/// Damage is reported, not thrown: the sound part of an unfinished file is counted. Changes nothing. Throws InputError
/// for files that cannot be read, are in use, or hold no results.
Inspection inspect_file(const std::string& path);

}  // namespace equipoise

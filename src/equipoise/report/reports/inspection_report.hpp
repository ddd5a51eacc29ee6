// The content of a file as text and as JSON.
#pragma once

#include <string>

#include "equipoise/results/commands/inspection.hpp"

namespace equipoise {

std::string inspection_text(const Inspection& inspection);
/// One JSON object. docs/reference/commands/inspect.md lists the keys.
std::string inspection_json(const Inspection& inspection);

}  // namespace equipoise

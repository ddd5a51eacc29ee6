// Studies to begin with, commented, for kinds of machine.
#pragma once

#include <string>
#include <vector>

namespace equipoise {

/// The machines that have a study: "washing-machine", ..., "blank".
std::vector<std::string> new_machines();

/// The text of such a study. Throws InputError, naming `argument`, for another machine.
std::string new_study(const std::string& machine, const std::string& argument);

}  // namespace equipoise

// States to start from, as arrays.
#pragma once

#include <string>
#include <vector>

#include "convert.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise::python {

/// Rows of ball angles (n, balls), the rest as the study's [initial] says, or of whole states (n, 4 + 2 balls): x, y,
/// x_dot, y_dot, ball angles, ball rates in the rotating frame; one number more is the rotor's angle. Throws
/// InputError, naming `argument`, for other shapes.
std::vector<InitialState> starts_from(const Study& study, const py::array& array, const std::string& argument);

}  // namespace equipoise::python

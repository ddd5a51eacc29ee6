// States to start from, as arrays.
#include "starts.hpp"

#include "equipoise/core/base/error.hpp"

namespace equipoise::python {

std::vector<InitialState> starts_from(const Study& study, const py::array& array, const std::string& argument) {
  const auto balls = static_cast<std::size_t>(study.parameters.balls);
  const std::string widths = std::to_string(balls) + " (ball angles) or " + std::to_string(4 + 2 * balls) +
                             " (x, y, x_dot, y_dot, ball angles, ball rates)";
  const std::size_t width = array.ndim() == 2 ? static_cast<std::size_t>(array.shape(1)) : 0;
  const bool turned = width == 5 + 2 * balls, whole = turned || width == 4 + 2 * balls;
  if (array.ndim() == 2 && width != balls && !whole)
    throw InputError(argument, "", std::to_string(width) + " numbers a row", "must be rows of " + widths);
  const auto rows = rows_from(array, whole ? width : balls, argument, widths);
  std::vector<InitialState> starts(rows.size(), study.initial);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    InitialState& start = starts[i];
    const double* row = rows[i].data();
    if (whole) {
      start.x = row[0];
      start.y = row[1];
      start.x_dot = row[2];
      start.y_dot = row[3];
      row += 4;
    }
    for (std::size_t k = 0; k < balls; ++k) {
      start.phi[k] = row[k];
      if (whole) start.phi_dot[k] = row[balls + k];
    }
    if (turned) start.psi = row[2 * balls];
  }
  return starts;
}

}  // namespace equipoise::python

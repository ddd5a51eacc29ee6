// Trajectories as CSV and NetCDF.
#include "equipoise/result_files/trajectory_file.hpp"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <ostream>
#include <utility>

#include <fmt/format.h>
#include <netcdf.h>

#include "equipoise/base/error.hpp"
#include "equipoise/base/version.hpp"
#include "equipoise/io/netcdf.hpp"
#include "equipoise/io/replacement.hpp"

namespace equipoise {

void write_csv(std::ostream& out, const Trajectory& r) {
  const std::size_t balls = r.phi.size();
  fmt::memory_buffer line;
  const auto append = [&line]<class... Parts>(fmt::format_string<Parts...> format, Parts&&... parts) {
    fmt::format_to(std::back_inserter(line), format, std::forward<Parts>(parts)...);
  };
  append("t,psi,psi_dot,x,y,x_dot,y_dot");
  for (std::size_t i = 1; i <= balls; ++i) append(",phi_{}", i);
  for (std::size_t i = 1; i <= balls; ++i) append(",phi_dot_{}", i);
  append(",radial,bearing_x,bearing_y\n");
  for (std::size_t k = 0; k < r.t.size(); ++k) {
    append("{},{},{},{},{},{},{}", r.t[k], r.psi[k], r.psi_dot[k], r.x[k], r.y[k], r.x_dot[k], r.y_dot[k]);
    for (std::size_t i = 0; i < balls; ++i) append(",{}", r.phi[i][k]);
    for (std::size_t i = 0; i < balls; ++i) append(",{}", r.phi_dot[i][k]);
    append(",{},{},{}\n", r.radial[k], r.bearing_x[k], r.bearing_y[k]);
    out.write(line.data(), static_cast<std::streamsize>(line.size()));
    line.clear();
  }
  out.write(line.data(), static_cast<std::streamsize>(line.size()));  // only the header, if there were no rows
}

void write_csv_file(const std::string& path, const Trajectory& trajectory) {
  io::Replacement place(path);
  errno = 0;
  std::ofstream file(place.file(), std::ios::binary);
  write_csv(file, trajectory);
  file.close();
  if (!file) throw RunError(path + ": cannot be written: " + io::error_text(errno));
  place.commit();
}

namespace {

void fill_file(io::NetcdfFile& file, const Trajectory& r, const std::string& study) {
  const std::size_t rows = r.t.size(), balls = r.phi.size();
  const int time = file.dimension("t", rows);
  const int ball = file.dimension("ball", balls);
  struct Column {
    const char *name, *units, *long_name;
    const std::vector<double>* values;
  };
  const Column columns[] = {
      {"t", "1", "time in 1/omega_c", &r.t},
      {"psi", "radian", "rotor angle", &r.psi},
      {"psi_dot", "1", "rotor speed in omega_c", &r.psi_dot},
      {"x", "1", "centre of the race along the rotating x axis, in race radii", &r.x},
      {"y", "1", "centre of the race along the rotating y axis, in race radii", &r.y},
      {"x_dot", "1", "rotating-frame derivative of x, in race radii times omega_c", &r.x_dot},
      {"y_dot", "1", "rotating-frame derivative of y, in race radii times omega_c", &r.y_dot},
      {"radial", "1", "displacement from the place of rest under gravity, in race radii", &r.radial},
      {"bearing_x", "1", "force on the supports along the fixed X axis, in M R omega_c^2", &r.bearing_x},
      {"bearing_y", "1", "force on the supports along the fixed Y axis, the weight included, in M R omega_c^2",
       &r.bearing_y},
  };
  std::vector<int> ids;
  for (const Column& c : columns) ids.push_back(file.variable(c.name, NC_DOUBLE, {time}, c.units, c.long_name));
  const int phi =
      file.variable("phi", NC_DOUBLE, {time, ball}, "radian", "ball angle in the rotating frame, not wrapped");
  const int phi_dot = file.variable("phi_dot", NC_DOUBLE, {time, ball}, "1", "rate of the ball angle in omega_c");
  file.attribute(NC_GLOBAL, "Conventions", "CF-1.8");
  file.attribute(NC_GLOBAL, "title", "Trajectory of a rotor with an automatic ball balancer");
  file.attribute(NC_GLOBAL, "source", fmt::format("equipoise {}", version_string));
  file.attribute(NC_GLOBAL, "study", study);
  file.end_definitions();
  if (rows == 0) return;
  for (std::size_t c = 0; c < ids.size(); ++c) file.write(ids[c], {0}, {rows}, columns[c].values->data());
  std::vector<double> by_ball(rows * balls), rate_by_ball(rows * balls);
  for (std::size_t k = 0; k < rows; ++k)
    for (std::size_t i = 0; i < balls; ++i) {
      by_ball[k * balls + i] = r.phi[i][k];
      rate_by_ball[k * balls + i] = r.phi_dot[i][k];
    }
  file.write(phi, {0, 0}, {rows, balls}, by_ball.data());
  file.write(phi_dot, {0, 0}, {rows, balls}, rate_by_ball.data());
}

}  // namespace

void write_netcdf(const std::string& path, const Trajectory& r, const std::string& study) {
  using Mode = io::NetcdfFile::Mode;
  const bool large = r.t.size() * std::max<std::size_t>(r.phi.size(), 1) * sizeof(double) >= std::size_t{1} << 31;
  io::write_netcdf_file(
      path, [&](io::NetcdfFile& file) { fill_file(file, r, study); }, large ? Mode::create_large : Mode::create);
}

}  // namespace equipoise

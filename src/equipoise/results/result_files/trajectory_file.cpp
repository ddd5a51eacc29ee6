// Trajectories as CSV and NetCDF.
#include "equipoise/results/result_files/trajectory_file.hpp"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <ostream>
#include <utility>

#include <fmt/format.h>
#include <netcdf.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/results/io/netcdf.hpp"
#include "equipoise/results/io/replacement.hpp"
#include "equipoise/results/words/files.hpp"

namespace equipoise {

void write_csv(std::ostream& out, const Trajectory& r) {
  fmt::memory_buffer line;
  const auto append = [&line]<class... Parts>(fmt::format_string<Parts...> format, Parts&&... parts) {
    fmt::format_to(std::back_inserter(line), format, std::forward<Parts>(parts)...);
  };
  const auto cells = [&](const auto& one, const auto& of_each) {
    for (const TrajectoryColumn& c : trajectory_columns) {
      if (c.values && c.is_in(r)) one(c);
      for (std::size_t i = 0; c.each && i < (r.*c.each).size(); ++i) of_each(c, i);
    }
    line.resize(line.size() - 1);  // the last comma
    append("\n");
  };
  cells([&](const auto& c) { append("{},", c.name); },
        [&](const auto& c, std::size_t i) { append("{}_{},", c.name, i + 1); });
  for (std::size_t k = 0; k < r.t.size(); ++k) {
    cells([&](const auto& c) { append("{},", (r.*c.values)[k]); },
          [&](const auto& c, std::size_t i) { append("{},", (r.*c.each)[i][k]); });
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
  const int bearing = r.bearing_radial.empty() ? -1 : file.dimension("bearing", r.bearing_radial.size());
  std::vector<int> ids;
  for (const TrajectoryColumn& c : trajectory_columns) {
    const int one = c.of == TrajectoryColumn::Of::bearing ? bearing : ball;
    ids.push_back(!c.is_in(r) ? -1
                              : file.variable(c.name, NC_DOUBLE, c.each ? std::vector{time, one} : std::vector{time},
                                              c.cf_units(), c.long_name()));
  }
  file.attribute(NC_GLOBAL, "Conventions", "CF-1.8");
  file.attribute(NC_GLOBAL, "title", words::files::trajectory);
  file.attribute(NC_GLOBAL, "source", fmt::format("equipoise {}", version_string));
  file.attribute(NC_GLOBAL, "study", study);
  file.end_definitions();
  if (rows == 0) return;
  for (std::size_t c = 0; c < ids.size(); ++c) {
    const TrajectoryColumn& column = trajectory_columns[c];
    if (!column.is_in(r)) continue;
    if (column.values) {
      file.write(ids[c], {0}, {rows}, (r.*column.values).data());
      continue;
    }
    std::vector<double> by_time;
    for (std::size_t k = 0; k < rows; ++k)
      for (const std::vector<double>& of_one : r.*column.each) by_time.push_back(of_one[k]);
    file.write(ids[c], {0, 0}, {rows, (r.*column.each).size()}, by_time.data());
  }
}

}  // namespace

void write_netcdf(const std::string& path, const Trajectory& r, const std::string& study) {
  using Mode = io::NetcdfFile::Mode;
  const bool large = r.t.size() * std::max<std::size_t>(r.phi.size(), 1) * sizeof(double) >= std::size_t{1} << 31;
  io::write_netcdf_file(
      path, [&](io::NetcdfFile& file) { fill_file(file, r, study); }, large ? Mode::create_large : Mode::create);
}

}  // namespace equipoise

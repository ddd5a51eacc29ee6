// Trajectories as CSV and NetCDF.
#include "equipoise/results/result_files/trajectory_file.hpp"

#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "equipoise/results/io/dataset_file.hpp"

namespace equipoise {

std::string trajectory_csv(const Trajectory& r, const Study& study) {
  std::string text;
  const auto append = [&text]<class... Parts>(fmt::format_string<Parts...> format, Parts&&... parts) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Parts>(parts)...);
  };
  const auto cells = [&](const auto& one, const auto& of_each) {
    for (const TrajectoryColumn& c : trajectory_columns) {
      if (c.values && c.is_in(r)) one(c);
      for (std::size_t i = 0; c.each && i < (r.*c.each).size(); ++i) of_each(c, i);
    }
    text.back() = '\n';  // instead of the last comma
  };
  cells([&](const auto& c) { append("{},", csv_title(c, study.scales)); },
        [&](TrajectoryColumn c, std::size_t i) {
          const std::string name = fmt::format("{}_{}", c.name, i + 1);
          c.name = name.c_str();
          append("{},", csv_title(c, study.scales));
        });
  for (std::size_t k = 0; k < r.t.size(); ++k)
    cells([&](const auto& c) { append("{},", (r.*c.values)[k]); },
          [&](const auto& c, std::size_t i) { append("{},", (r.*c.each)[i][k]); });
  return text;
}

void write_netcdf(const std::string& path, const Trajectory& r, const std::string& study) {
  Dataset data("Trajectory of a rotor with an automatic ball balancer");
  const std::size_t time = data.dimension("t", r.t.size()), ball = data.dimension("ball", r.phi.size());
  const std::size_t bearing = r.bearing_radial.empty() ? ball : data.dimension("bearing", r.bearing_radial.size());
  for (const TrajectoryColumn& c : trajectory_columns) {
    if (!c.is_in(r)) continue;
    if (c.values)
      data.add(c, {time}, [&values = r.*c.values](std::size_t k) { return values[k]; });
    else
      data.add(c, {time, c.of == TrajectoryColumn::Of::bearing ? bearing : ball},
               [&each = r.*c.each](std::size_t k) { return each[k % each.size()][k / each.size()]; });
  }
  data.say("study", study);
  io::write_netcdf_file(path, data);
}

}  // namespace equipoise

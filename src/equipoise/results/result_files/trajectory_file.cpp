// Trajectories as CSV and NetCDF: one, or many along a dimension of starts.
#include "equipoise/results/result_files/trajectory_file.hpp"

#include <iterator>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "equipoise/results/io/dataset_file.hpp"

namespace equipoise {

namespace {

// Visits the columns of a run: those of one number, then the number of each ball or bearing.
template <class One, class Each>
void visit_columns(const Trajectory& run, const One& one, const Each& of_each) {
  for (const TrajectoryColumn& c : trajectory_columns) {
    if (c.values && c.is_in(run)) one(c);
    for (std::size_t i = 0; c.each && i < (run.*c.each).size(); ++i) of_each(c, i);
  }
}

std::string titles(const Trajectory& run, const Study& study) {
  std::string text;
  visit_columns(
      run, [&](const auto& c) { text += csv_title(c, study.scales) + ","; },
      [&](TrajectoryColumn c, std::size_t i) {
        const std::string name = fmt::format("{}_{}", c.name, i + 1);
        c.name = name.c_str();
        text += csv_title(c, study.scales) + ",";
      });
  text.back() = '\n';  // instead of the last comma
  return text;
}

// `before`: begins every row.
void append_rows(std::string& text, const Trajectory& run, const std::string& before) {
  const auto append = [&text](double value) { fmt::format_to(std::back_inserter(text), "{},", value); };
  for (std::size_t k = 0; k < run.t.size(); ++k) {
    text += before;
    visit_columns(
        run, [&](const auto& c) { append((run.*c.values)[k]); },
        [&](const auto& c, std::size_t i) { append((run.*c.each)[i][k]); });
    text.back() = '\n';
  }
}

// `many`: along a dimension of starts.
void write(const std::string& path, std::span<const Trajectory> runs, const std::vector<double>& times, bool many,
           const std::string& study) {
  Dataset data(many ? "Trajectories of a rotor with an automatic ball balancer"
                    : "Trajectory of a rotor with an automatic ball balancer");
  const Trajectory none;
  const Trajectory& first = runs.empty() ? none : runs.front();
  std::vector<std::size_t> along;
  if (many) along.push_back(data.dimension("start", runs.size()));
  const std::size_t time = data.dimension("t", times.size());
  const auto dimension = [&](const char* name, std::size_t length) {
    return length > 0 ? data.dimension(name, length) : time;  // without balls there are no such columns
  };
  const std::size_t ball = dimension("ball", first.phi.size());
  const std::size_t bearing = dimension("bearing", first.bearing_radial.size());
  along.push_back(time);
  const std::size_t rows = times.size();
  for (const TrajectoryColumn& c : trajectory_columns) {
    if (!c.is_in(first) || (c.each && (first.*c.each).empty())) continue;
    if (c.values == &Trajectory::t) {
      data.add(c, {time}, [&times](std::size_t k) { return times[k]; });
    } else if (c.values) {
      data.add(c, along, [runs, rows, values = c.values](std::size_t k) {
        const std::vector<double>& of_run = runs[k / rows].*values;
        return k % rows < of_run.size() ? of_run[k % rows] : no_number;
      });
    } else {
      std::vector<std::size_t> of_each = along;
      of_each.push_back(c.of == TrajectoryColumn::Of::bearing ? bearing : ball);
      data.add(c, of_each, [runs, rows, each = c.each, count = (first.*c.each).size()](std::size_t k) {
        const std::vector<double>& one = (runs[k / count / rows].*each)[k % count];
        return k / count % rows < one.size() ? one[k / count % rows] : no_number;
      });
    }
  }
  data.say("study", study);
  io::write_netcdf_file(path, data);
}

}  // namespace

std::string trajectory_csv(const Trajectory& r, const Study& study) {
  std::string text = titles(r, study);
  append_rows(text, r, "");
  return text;
}

std::string trajectory_csv(const Trajectories& r, const Study& study) {
  std::string text = r.runs.empty() ? "" : "start," + titles(r.runs.front(), study);
  for (std::size_t i = 0; i < r.runs.size(); ++i) append_rows(text, r.runs[i], fmt::format("{},", i));
  return text;
}

void write_netcdf(const std::string& path, const Trajectory& r, const std::string& study) {
  write(path, {&r, 1}, r.t, false, study);
}

void write_netcdf(const std::string& path, const Trajectories& r, const std::string& study) {
  write(path, r.runs, r.times, true, study);
}

}  // namespace equipoise

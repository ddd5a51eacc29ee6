// Files of a reproduction: pictures, data, report.
#include "reproduce_files.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "equipoise/base/error.hpp"
#include "equipoise/plots/map_plot.hpp"
#include "equipoise/io/replacement.hpp"
#include "equipoise/reproduction/reproduction_charts.hpp"
#include "equipoise/reproduction/reproduction_document.hpp"
#include "equipoise/result_files/slice_file.hpp"
#include "gnuplot.hpp"
#include "options.hpp"
#include "words.hpp"

namespace equipoise::app {

namespace fs = std::filesystem;

namespace {

void copy_whole(const fs::path& from, const fs::path& to, std::error_code& error) {
  io::Replacement place(to.string());
  fs::copy_file(from, place.file(), fs::copy_options::overwrite_existing, error);
  if (!error) place.commit();
}

// The folder for pictures of a Markdown report.
std::string pictures_beside(const std::string& report) { return report.substr(0, report.size() - 3) + "-pictures"; }

}  // namespace

std::string picture_folder(const std::string& output, const std::string& report) {
  std::string folder;
  if (!output.empty())
    folder = output + "/pictures";
  else if (report.ends_with(".md"))
    folder = pictures_beside(report);
  if (folder.empty()) return folder;
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError("--output", "", folder, words::not_a_folder);
  return folder;
}

namespace {

// A picture as PNG and as SVG. `script` makes the script that draws into a path.
template <class Script>
void picture(Reproduction& r, const std::string& folder, const std::string& id, const std::string& title,
             const Script& script) {
  const std::string stem = folder + "/" + id;
  draw(stem + ".png", script);
  draw(stem + ".svg", script);
  r.pictures.push_back({id, title, stem + ".png"});
}

void map_picture(Reproduction& r, const std::string& folder, const std::string& id, const std::string& title,
                 const BasinSlice& map) {
  picture(r, folder, id, title, [&](const std::string& path) { return map_plot_script(map, title, path); });
  write_map_file(folder + "/" + id + ".nc", map);
}

}  // namespace

void draw_pictures(Reproduction& r, const std::string& folder) {
  const auto charts = [&](const std::string& id, const std::string& title, const std::vector<Chart>& list) {
    picture(r, folder, id, title, [&](const std::string& path) { return chart_plot_script(title, list, path); });
  };
  for (const ReproducedTable& t : r.tables)
    if (const auto chart = table_chart(t))
      charts(fmt::format("table-{}", t.published->number),
             fmt::format("Table {}: {}", t.published->number, t.published->title), {*chart});
  for (const PaperFigure& f : r.figures) {
    charts(f.id, f.title, figure_charts(f));
    write_file(folder + "/" + f.id + ".csv", figure_csv(f));
  }
  if (!r.open) return;
  map_picture(r, folder, "future-eccentricity-angle", words::eccentricity_and_angle, r.open->eccentricity_and_angle);
  map_picture(r, folder, "future-eccentricity-mass", words::eccentricity_and_mass, r.open->eccentricity_and_mass);
  charts("future-box", words::box_and_rest, {box_chart(*r.open)});
}

void write_report(const Reproduction& r, const std::string& path, const std::string& explorer,
                  const std::string& folder) {
  const Document document = reproduction_document(r, explorer);
  if (path.ends_with(".html")) return write_file(path, document_html(document));
  const fs::path beside = pictures_beside(path);
  std::error_code error;
  fs::create_directories(beside, error);
  if (folder != beside.string())
    for (const Picture& p : r.pictures)
      if (!error) copy_whole(p.path, beside / fs::path(p.path).filename(), error);
  if (error) throw RunError(fmt::format("{}: {}", beside.string(), error.message()));
  write_file(path, document_markdown(document, beside.filename().string()));
}

}  // namespace equipoise::app

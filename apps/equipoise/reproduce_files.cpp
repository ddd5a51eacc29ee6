// Files of a reproduction: pictures, data, report.
#include "reproduce_files.hpp"

#include <cstdlib>
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

PictureFolder::PictureFolder(const std::string& output, const std::string& report) {
  if (!output.empty())
    path_ = output + "/pictures";
  else if (report.ends_with(".md"))
    path_ = pictures_beside(report);
  else if (!report.empty()) {
    path_ = (fs::temp_directory_path() / "equipoise-XXXXXX").string();
    if (!mkdtemp(path_.data())) throw RunError(fmt::format(words::no_temporary_folder, path_));
    temporary_ = true;
  }
  if (path_.empty()) return;
  std::error_code error;
  fs::create_directories(path_, error);
  if (error) throw InputError("--output", "", path_, words::not_a_folder);
}

PictureFolder::~PictureFolder() {
  std::error_code ignored;
  if (temporary_) fs::remove_all(path_, ignored);
}

namespace {

// A picture as PNG, and also as SVG if it is kept. `script` makes the script that draws into a path.
template <class Script>
void picture(Reproduction& r, const PictureFolder& folder, const std::string& id, const std::string& title,
             const Script& script) {
  const std::string stem = folder.path() + "/" + id;
  draw(stem + ".png", script);
  if (!folder.temporary()) draw(stem + ".svg", script);
  r.pictures.push_back({id, title, stem + ".png"});
}

void map_picture(Reproduction& r, const PictureFolder& folder, const std::string& id, const std::string& title,
                 const BasinSlice& map) {
  picture(r, folder, id, title, [&](const std::string& path) { return map_plot_script(map, title, path); });
  if (!folder.temporary()) write_map_file(folder.path() + "/" + id + ".nc", map);
}

}  // namespace

void draw_pictures(Reproduction& r, const PictureFolder& folder) {
  const auto charts = [&](const std::string& id, const std::string& title, const std::vector<Chart>& list) {
    picture(r, folder, id, title, [&](const std::string& path) { return chart_plot_script(title, list, path); });
  };
  for (const ReproducedTable& t : r.tables)
    if (const auto chart = table_chart(t))
      charts(fmt::format("table-{}", t.published->number),
             fmt::format("Table {}: {}", t.published->number, t.published->title), {*chart});
  for (const PaperFigure& f : r.figures) {
    charts(f.id, f.title, figure_charts(f));
    if (!folder.temporary()) write_file(folder.path() + "/" + f.id + ".csv", figure_csv(f));
  }
  if (!r.open) return;
  map_picture(r, folder, "future-eccentricity-angle", words::eccentricity_and_angle, r.open->eccentricity_and_angle);
  map_picture(r, folder, "future-eccentricity-mass", words::eccentricity_and_mass, r.open->eccentricity_and_mass);
  charts("future-box", words::box_and_rest, {box_chart(*r.open)});
}

void write_report(const Reproduction& r, const std::string& path, const std::string& explorer,
                  const PictureFolder& folder) {
  const Document document = reproduction_document(r, explorer);
  if (path.ends_with(".html")) return write_file(path, document_html(document));
  const fs::path beside = pictures_beside(path);
  std::error_code error;
  fs::create_directories(beside, error);
  if (folder.path() != beside.string())
    for (const Picture& p : r.pictures)
      if (!error) copy_whole(p.path, beside / fs::path(p.path).filename(), error);
  if (error) throw RunError(fmt::format("{}: {}", beside.string(), error.message()));
  write_file(path, document_markdown(document, beside.filename().string()));
}

}  // namespace equipoise::app

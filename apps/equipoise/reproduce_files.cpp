// Files of a reproduction: pictures, data, report.
#include "reproduce_files.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/extras/reproduction/reproduction_document.hpp"
#include "equipoise/extras/reproduction/reproduction_plots.hpp"
#include "equipoise/report/drawing/plot_file.hpp"
#include "equipoise/results/result_files/slice_file.hpp"
#include "options.hpp"
#include "words.hpp"

namespace equipoise::app {

namespace fs = std::filesystem;

namespace {

// The folder for pictures of a Markdown report.
std::string pictures_beside(const std::string& report) { return report.substr(0, report.size() - 3) + "-pictures"; }

void make_folder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError("--output", "", folder, words::not_a_folder);
}

// Every drawing of the document that has a name, below the heading that it stands under.
std::vector<Picture> draw_pictures(const Document& document, const std::string& folder) {
  make_folder(folder);
  std::vector<Picture> pictures;
  std::string title;
  for (const Block& block : document.blocks) {
    if (const auto* heading = std::get_if<Heading>(&block)) title = heading->text;
    const auto* row = std::get_if<DrawingRow>(&block);
    if (!row || row->picture.empty()) continue;
    pictures.push_back({row->picture, title, fmt::format("{}/{}.svg", folder, row->picture)});
    write_file(pictures.back().path, plot_file(title, {}, *row));
  }
  return pictures;
}

void write_data(const Reproduction& r, const std::string& folder) {
  for (const PaperFigure& f : r.figures) write_file(folder + "/" + f.id + ".csv", figure_csv(f));
  if (!r.open) return;
  write_map_file(folder + "/future-eccentricity-angle.nc", r.open->eccentricity_and_angle);
  write_map_file(folder + "/future-eccentricity-mass.nc", r.open->eccentricity_and_mass);
}

}  // namespace

std::string picture_folder(const std::string& output, const std::string& report) {
  std::string folder = !output.empty()           ? output + "/pictures"
                       : report.ends_with(".md") ? pictures_beside(report)
                                                 : "";
  if (!folder.empty()) make_folder(folder);
  return folder;
}

void write_reproduction(Reproduction& r, const std::string& report, const std::string& explorer,
                        const std::string& folder) {
  const Document document = reproduction_document(r, explorer);
  if (!folder.empty()) {
    r.pictures = draw_pictures(document, folder);
    write_data(r, folder);
  }
  if (report.ends_with(".html")) write_file(report, document_html(document));
  if (!report.ends_with(".md")) return;
  const std::string beside = pictures_beside(report);
  if (beside != folder) draw_pictures(document, beside);
  write_file(report, document_markdown(document, fs::path(beside).filename().string()));
}

}  // namespace equipoise::app

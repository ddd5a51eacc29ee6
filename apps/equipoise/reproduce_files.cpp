// Files of a reproduction: pictures, data, report.
#include "reproduce_files.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/extras/reproduction/reproduction_document.hpp"
#include "equipoise/report/drawing/plot_file.hpp"
#include "equipoise/results/result_files/slice_file.hpp"
#include "options.hpp"
#include "words.hpp"

namespace equipoise::app {

namespace fs = std::filesystem;

namespace {

void make_folder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError("--output", "", folder, words::not_a_folder);
}

// Every drawing of the document, named and titled by the heading that it stands under.
std::vector<Picture> draw_pictures(const Document& document, const std::string& folder) {
  std::vector<Picture> pictures;
  Heading heading;
  for (const Block& block : document.blocks) {
    if (const auto* next = std::get_if<Heading>(&block)) heading = *next;
    const auto* row = std::get_if<DrawingRow>(&block);
    if (!row) continue;
    pictures.push_back({heading.anchor, heading.text, fmt::format("{}/{}.svg", folder, heading.anchor)});
    write_file(pictures.back().path, plot_file(heading.text, {}, *row));
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

std::string picture_folder(const std::string& output) {
  if (output.empty()) return "";
  make_folder(output + "/pictures");
  return output + "/pictures";
}

void write_reproduction(Reproduction& r, const std::string& report, const std::string& explorer,
                        const std::string& folder) {
  const Document document = reproduction_document(r, explorer);
  if (!folder.empty()) {
    r.pictures = draw_pictures(document, folder);
    write_data(r, folder);
  }
  if (!report.empty()) write_file(report, document_html(document));
}

}  // namespace equipoise::app

// Drawings of a page as a picture file.
#pragma once

#include <string>
#include <vector>

#include "equipoise/report/drawing/document.hpp"
#include "equipoise/report/drawing/plot.hpp"

namespace equipoise {

/// One SVG that needs nothing else, for browsers, word processors and printers: title, lines of details, drawings two
/// to a row with their titles and words, caption.
std::string plot_file(const std::string& title, const std::vector<std::string>& details, const DrawingRow& row);
std::string plot_file(const std::string& title, const std::vector<Plot>& plots);

}  // namespace equipoise

// A table of a document for the terminal, and what its cells say of shares.
#pragma once

#include <string>

#include "equipoise/drawing/document.hpp"
#include "equipoise/statistics/share.hpp"

namespace equipoise {

/// "60.40 %", without digits that its interval does not support.
DocumentCell share_cell(const Share& share);

/// Columns as wide as their widest entry, two spaces apart, those with numbers to the right; the caption below. If some
/// row begins with a good cell, such rows begin with a star.
std::string table_text(const DocumentTable& table);

}  // namespace equipoise

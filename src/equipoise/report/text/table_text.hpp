// Tables and sentences for the terminal, and what cells say of shares.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "equipoise/core/statistics/share.hpp"
#include "equipoise/report/drawing/document.hpp"

namespace equipoise {

/// How text for the terminal is laid out.
struct TextStyle {
  std::size_t width = 80;  ///< of lines, where words allow; 0: tables with all of their columns, lines as they come
  bool details = false;    ///< grounds of decisions, and every figure of every outcome with its interval
  bool colour = false;     ///< with ANSI escapes
};
inline constexpr TextStyle wide_style{0, true, false};

/// "60.40 %", without digits that its interval does not support.
DocumentCell share_cell(const Share& share);
/// "60.40 ± 0.18 %" where the interval is even to a unit of its last digit, else "0.80 % (0.49 to 1.30)"; "below 0.19
/// %" of none.
std::string share_with_interval(const Share& share);

/// Columns as wide as their widest entry, two spaces apart, those with numbers to the right; the caption below. If some
/// row begins with a good cell, such rows begin with a star. Too wide for the style, it loses its spare columns, the
/// last one listed first.
std::string table_text(const DocumentTable& table, const TextStyle& style = wide_style);

/// `text` in lines of the style's width, broken at spaces; the first begins with `label`, the others with as many
/// spaces. A longer word has a line of its own. Ends with a new line.
std::string filled(std::string_view label, std::string_view text, const TextStyle& style = wide_style);

/// A result for the terminal: its verdict, answer, tables and sentences, without drawings, and without headings if it
/// is a sheet. Sentences that follow one another form one group; an empty line separates it from other blocks. A table
/// that is too wide becomes a list, and a folded one is left out unless the style has details.
std::string document_text(const Document& document, const TextStyle& style = wide_style);
template <class Result>
std::string result_text(const Result& result, const TextStyle& style = wide_style) {
  return document_text(document_of(result), style);
}

/// Lines, each filled; what a line goes on with stands below its first character that is no space, or from column
/// `hang` on where that column ends a label.
std::string lines_filled(std::string_view lines, const TextStyle& style, std::size_t hang = 0);

/// The text in a tone's colour, if the style has colours.
std::string in_tone(const std::string& text, Tone tone, const TextStyle& style);

}  // namespace equipoise

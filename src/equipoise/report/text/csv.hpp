// Pieces that all CSV tables share.
#pragma once

#include <string>

#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// The shortest text that reads back to the same number; empty if it is not finite.
std::string csv_number(double value);
/// Quoted if necessary, with inner quotes doubled (RFC 4180); behind an apostrophe if a spreadsheet would take it for a
/// formula.
std::string csv_text(const std::string& given);
/// The study as comments, line by line.
std::string csv_study(const Study& study);

}  // namespace equipoise

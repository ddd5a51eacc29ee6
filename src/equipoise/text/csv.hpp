// What tables as CSV share.
#pragma once

#include <string>

#include "equipoise/study/study.hpp"

namespace equipoise {

/// Shortest text that reads back to the same number; nothing for what is not finite.
std::string csv_number(double value);
/// In quotes where it needs them, its own quotes doubled (RFC 4180).
std::string csv_text(const std::string& text);
/// The study as comments, a line each.
std::string csv_study(const Study& study);

}  // namespace equipoise

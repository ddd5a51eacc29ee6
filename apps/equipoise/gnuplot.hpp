// Drawing by the program gnuplot.
#pragma once

#include <functional>
#include <string>

namespace equipoise::app {

/// Throws InputError, naming the option, unless gnuplot is on the PATH.
void require_gnuplot(const char* option, const std::string& value);

/// Draws a picture (.png or .svg) with gnuplot; it replaces `path` once it is whole. `script_for` makes the script that
/// draws into the given file. Throws RunError on failure.
void draw(const std::string& path, const std::function<std::string(const std::string&)>& script_for);

}  // namespace equipoise::app

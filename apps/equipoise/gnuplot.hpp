// Drawing with the program gnuplot.
#pragma once

#include <functional>
#include <string>

namespace equipoise::app {

/// Throws InputError, naming the option, unless gnuplot is on the PATH.
void require_gnuplot(const char* option, const std::string& value);

/// Lets gnuplot draw a picture (.png or .svg) that takes the place of `path` once it is whole. `script_for`: makes the
/// script that draws into the file named. Throws RunError if it could not.
void draw(const std::string& path, const std::function<std::string(const std::string&)>& script_for);

}  // namespace equipoise::app

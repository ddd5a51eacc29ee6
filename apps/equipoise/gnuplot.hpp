// Drawing with the program gnuplot.
#pragma once

#include <string>

namespace equipoise::app {

/// Throws InputError, naming the option, unless gnuplot is on the PATH.
void require_gnuplot(const char* option, const std::string& value);

/// Lets gnuplot run a script that draws into `path`. Throws RunError if it could not.
void draw(const std::string& path, const std::string& script);

}  // namespace equipoise::app

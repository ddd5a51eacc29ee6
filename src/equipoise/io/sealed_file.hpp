// A file that ends with its own checksum, so that damage is found before its content is used.
#pragma once

#include <string>

namespace equipoise::io {

/// Appends the seal. Throws RunError, naming `name`, if the file cannot take it.
void seal(const std::string& path, const std::string& name);

/// What is wrong with a sealed file, in words that follow its name; empty if nothing.
std::string why_not_whole(const std::string& path);

}  // namespace equipoise::io

// Files that end with their own checksum, so that damage is found before the content is used.
#pragma once

#include <string>

namespace equipoise::io {

/// Appends the seal. Throws RunError, naming `name`, if the file cannot take it.
void seal(const std::string& path, const std::string& name);

/// What is wrong with a sealed file, in words that follow its name; empty if nothing is.
std::string why_not_whole(const std::string& path);

}  // namespace equipoise::io

// A file that ends with a checksum of itself, so that damage is known before anything is made of its content.
#pragma once

#include <string>

namespace equipoise::store {

/// Appends the seal. Throws RunError, naming `name`, if the file cannot take it.
void seal(const std::string& path, const std::string& name);

/// What is wrong with a file that should be sealed, in words that follow its name; empty if nothing is.
std::string why_not_whole(const std::string& path);

}  // namespace equipoise::store

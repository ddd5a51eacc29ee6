// Files that a library carries inside itself.
#pragma once

#include <cstddef>
#include <string_view>

namespace equipoise::embedded {

struct File {
  std::string_view name;
  std::string_view text;
};

/// Files put into a library where it is built (cmake/embed.cmake).
struct Archive {
  const File* files = nullptr;
  std::size_t count = 0;

  /// The text of a file by its name; empty if the library was built without it.
  std::string_view find(std::string_view name) const {
    for (std::size_t i = 0; i < count; ++i)
      if (files[i].name == name) return files[i].text;
    return {};
  }
};

}  // namespace equipoise::embedded

// Files embedded in a library.
#pragma once

#include <cstddef>
#include <string_view>

namespace equipoise::embedded {

struct File {
  std::string_view name;
  std::string_view text;
};

/// Files embedded in a library when it is built (cmake/embed.cmake).
struct Archive {
  const File* files = nullptr;
  std::size_t count = 0;

  /// The text of the file with this name; empty if the library was built without it.
  std::string_view find(std::string_view name) const {
    for (std::size_t i = 0; i < count; ++i)
      if (files[i].name == name) return files[i].text;
    return {};
  }
};

}  // namespace equipoise::embedded

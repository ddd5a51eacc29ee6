// Files that the library carries inside itself: published tables, the studies of their rows, the chart library.
#pragma once

#include <string_view>

namespace equipoise::embedded {

struct File {
  std::string_view name;
  std::string_view text;
};

/// Written by cmake/embed.cmake.
extern const File files[];
extern const unsigned count;

/// The text of a file by its name ("published/table-1.csv", "studies/table-2-omega-2.4.toml", "plotly.js"); empty if
/// the library was built without it.
inline std::string_view find(std::string_view name) {
  for (unsigned i = 0; i < count; ++i)
    if (files[i].name == name) return files[i].text;
  return {};
}

}  // namespace equipoise::embedded

// Files that pages need: "document.css", "document.js", and "plotly.js" if the library was built with it.
#pragma once

#include "equipoise/base/embedded.hpp"

namespace equipoise::embedded {

extern const Archive page_files;

}  // namespace equipoise::embedded

// Files that pages need: "document.css" and "sheet.css".
#pragma once

#include "equipoise/core/base/embedded.hpp"

namespace equipoise::embedded {

extern const Archive page_files;

}  // namespace equipoise::embedded

// Embedded files: the published tables ("published/table-1.csv"), the studies of their rows
// ("studies/table-2-omega-2.4.toml"), the conclusions, the evidence on table 7.
#pragma once

#include "equipoise/core/base/embedded.hpp"

namespace equipoise::embedded {

extern const Archive paper_files;

}  // namespace equipoise::embedded

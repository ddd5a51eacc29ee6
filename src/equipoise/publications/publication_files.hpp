// Embedded files: the studies of publications ("mirkov-2026.toml").
#pragma once

#include "equipoise/base/embedded.hpp"

namespace equipoise::embedded {

extern const Archive publication_files;

}  // namespace equipoise::embedded

// The paper's front door (CMake target equipoise::paper): Wright and Peng (2019), what they printed, and all of it
// computed again.
#pragma once

#include "equipoise/equipoise.hpp"
#include "equipoise/extras/literature/published_tables.hpp"
#include "equipoise/extras/reproduction/reproduction.hpp"

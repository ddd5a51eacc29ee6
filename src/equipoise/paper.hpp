// The paper's front door (CMake target equipoise::paper): Wright and Peng (2019), what they printed, and all of it
// computed again; and numbers of other publications.
#pragma once

#include "equipoise/equipoise.hpp"
#include "equipoise/literature/conclusions.hpp"
#include "equipoise/literature/published_tables.hpp"
#include "equipoise/literature/reproduction.hpp"
#include "equipoise/publications/measures.hpp"
#include "equipoise/publications/publication.hpp"
#include "equipoise/publications/publication_verdicts.hpp"
#include "equipoise/reproduction/open_questions.hpp"
#include "equipoise/reproduction/paper_figures.hpp"
#include "equipoise/reproduction/reproduce.hpp"

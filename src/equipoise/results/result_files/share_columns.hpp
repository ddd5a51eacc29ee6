// The numbers of a share in files: one line each, for ensembles and for cells of sweeps.
#pragma once

#include <array>

#include "equipoise/core/statistics/share.hpp"

namespace equipoise::io {

struct ShareColumn {
  const char* name;  ///< a sweep's variable; an ensemble's has "kind_" before it
  double Share::*value;
  const char* of_ensemble;  ///< long_name
  const char* of_cell;
};
inline constexpr std::array<ShareColumn, 5> share_columns{{
    {"share", &Share::share, "share of the starts with the outcome", "share of the starts"},
    {"share_low", &Share::low, "lower end of the 95 % interval of the share", "lower end of its 95 % interval"},
    {"share_high", &Share::high, "upper end of the 95 % interval of the share", "upper end of its 95 % interval"},
    {"share_least", &Share::least, "lower bound of the share whatever undecided starts would come to",
     "lower bound whatever undecided starts come to"},
    {"share_most", &Share::most, "upper bound of the share whatever undecided starts would come to",
     "upper bound whatever undecided starts come to"},
}};

}  // namespace equipoise::io

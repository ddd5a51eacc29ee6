// Where along its shaft a tilting rotor is watched, and of which supports its forces are told.
#pragma once

#include "equipoise/results/types/transient_table.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Forces are told of each bearing if each is known and there are no other supports (Study::each_bearing()). They are
/// those of all supports together if a machine stands on feet, which slide by that sum, and if starts draw what could
/// make the supports others than these bearings.
WatchedShaft watched_shaft(const Study& study);

}  // namespace equipoise

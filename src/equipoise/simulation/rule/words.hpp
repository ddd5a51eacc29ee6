// Sentences and words that more than one file of this chapter, or of those below it, prints.
#pragma once

namespace equipoise::words::runs {

inline constexpr char unit_of_time[] = "unit of time", second[] = "second";

}  // namespace equipoise::words::runs

// Sentences and words that more than one file of this chapter, or of those below it, prints.
#pragma once

namespace equipoise::words::files {

// Why a record is none, behind its place.
inline constexpr char outcome_without_name[] = "is damaged: start {} has outcome {}, which the file does not name";

// Outcomes, and their shares.
inline constexpr char name_by_wright_and_peng[] = "name that Wright and Peng (2019) give it";
inline constexpr char lower_end[] = "lower end of its 95 % interval";
inline constexpr char upper_end[] = "upper end of its 95 % interval";

}  // namespace equipoise::words::files

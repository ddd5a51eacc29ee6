// Sentences and words that more than one file of this chapter, or of those below it, prints.
#pragma once

namespace equipoise::words::machine {

// Rotor. What it must be, of keys of which one is needed.
inline constexpr char ratio_is_percentage[] = "must be at most 1, or a percentage; did you mean \"{:.6g} %\"?";

// Rotor: what is wrong.
inline constexpr char bearings_state_it[] = "follows from rotor.tilt.bearings; give either these or that";

}  // namespace equipoise::words::machine

namespace equipoise::words::study {

// Number of entries, form: "[low, high]".
inline constexpr char only_of_tilt[] = "has a meaning only with rotor.tilt";

// Distributions. The first {} of an entry is the name of the distribution.
inline constexpr char distribution_forms[] =
    "{ uniform = [low, high] }, { normal = [mean, standard deviation] }, { loguniform = [low, high] } or { values = "
    "[..] }, each entry equally likely";

}  // namespace equipoise::words::study

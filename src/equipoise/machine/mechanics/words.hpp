// Sentences and words that more than one file of this chapter, or of those below it, prints.
#pragma once

namespace equipoise::words::mechanics {

// Why there is no balanced state.
inline constexpr char lone_ball[] = "one ball alone cancels its own unbalance, neither more nor less";

}  // namespace equipoise::words::mechanics

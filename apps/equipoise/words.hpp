// What the program says besides results: errors about options, files and processes; notes; progress.
#pragma once

namespace equipoise::app::words {

// One of the ranges below.
inline constexpr char half_width_range[] = "a fraction of one from 1e-6 to 0.5";

// Shard, cells, blocks, "s" or nothing, cells of a block at most, one of the next two.
inline constexpr char first_shard_has[] = "shard 1 has", first_shards_have[] = "the first {} shards have";

}  // namespace equipoise::app::words

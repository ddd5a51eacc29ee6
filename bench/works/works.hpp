// The works of the benchmark: each measures one thing, prints its table and returns all of it as JSON.
#pragma once

#include <string>

#include "../machine.hpp"
#include "../bench_options.hpp"
#include "../timing.hpp"

namespace equipoise::bench {

/// Full length at constant speed: this engine and its rivals.
Json full(const Options& options);
/// Balls released in mid-ramp, to the end of the ramp: this engine and its rivals.
Json ramped(const Options& options);
/// Ensembles as a user has them decided. `full`: what that work returned, or null.
Json decided(const Options& options, const Json& full);
/// What the kernels reach of what the machine can.
Json kernel(const Options& options);
/// Instruction sets.
Json targets(const Options& options);
/// Numbers of threads.
Json threads(const Options& options);
/// Numbers of balls.
Json balls(const Options& options);
/// Sizes of an ensemble: time and memory.
Json starts(const Options& options);
/// Rotors with motors, gravity, contact, stiction; next to an older program.
Json machines(const Options& options);
/// Studies with uncertain values next to the same with known ones.
Json uncertain(const Options& options);
/// What starts() runs in a process of its own; its result goes to standard output.
int decide_as_child(std::uint64_t count, int threads, const std::string& output);

/// {"median": , "least": , "most": }
Json to_json(const Spread& spread);
Json to_json(const Cost& cost, std::size_t starts);

}  // namespace equipoise::bench

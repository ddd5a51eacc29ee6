// Where, with what and when a benchmark ran.
#pragma once

#include <nlohmann/json.hpp>

#include "bench_options.hpp"

namespace equipoise::bench {

using Json = nlohmann::ordered_json;

/// Processor, cores, instruction sets, compiler, flags, versions, date.
Json describe_machine();
/// The same for the terminal, with the run's settings.
void print_machine(const Json& machine, const Options& options);

}  // namespace equipoise::bench

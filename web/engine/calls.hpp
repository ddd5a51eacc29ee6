// The calls of web/src/engine/protocol.ts. Each takes the list of its arguments and answers its result.
#pragma once

#include <string>
#include <vector>

#include "bulk.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/running/run_options.hpp"
#include "equipoise/results/columns/transient_figures.hpp"
#include "equipoise/results/types/outcome.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise::web {

/// What studies that come from the page are called in messages.
inline constexpr const char* study_name = "study";

Study study_of(const Json& toml);

/// What is wrong with an input, as Problem of protocol.ts.
Json problem_json(const InputError& e);

/// Tells the worker.
void tell(const Progress& progress);

Json check_study(const Json& args);
Json presets(const Json& args);

Json search_attractors(const Json& args, Bulk& bulk);
Json ensemble(const Json& args, Bulk& bulk);
Json states(const Json& args, Bulk& bulk);
Json shares(const Json& args);
Json compare_shares(const Json& args);

/// What each start came to, for judge(): codes, speeds in the end and figures (transient_figures, one start after
/// another; none if they were not gathered).
Json told_rows(const std::vector<Outcome>& outcomes, const std::vector<TransientRow>& rows, Bulk& bulk);
Json one_body(const Json& args, Bulk& bulk);
Json try_change(const Json& args, Bulk& bulk);
Json judge(const Json& args);

Json play_open(const Json& args, Bulk& bulk);
Json play_advance(const Json& args, Bulk& bulk);
Json play_rows(const Json& args, Bulk& bulk);
Json play_close(const Json& args);

}  // namespace equipoise::web

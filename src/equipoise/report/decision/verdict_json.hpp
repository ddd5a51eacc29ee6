// A verdict as JSON. Not in verdict.hpp: installed headers need no JSON library.
#pragma once

#include <span>

#include "equipoise/report/decision/verdict.hpp"
#include "equipoise/report/text/json.hpp"

namespace equipoise {

/// The verdict's lines, and every change that was tried, in the study's shown units.
Json verdict_json(const BalancerVerdict& verdict, std::span<const TriedChange> tried = {});

}  // namespace equipoise

// Computes everything that the page for one machine shows.
// This room: what the page for one machine shows, computed.
#pragma once

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/results/commands/machine_page.hpp"

namespace equipoise {

/// Runs the ensemble and follows what is to be shown of it. Throws as basin() does. If stopped, the page holds what was
/// done. `options`: as of basin(), except that transients are always gathered and starts always kept (the first
/// million; on a grid all). `given`: what the study states (given_machine(), report/html/page_parts.hpp).
MachinePage machine_page(const Study& study, GivenMachine given, const BasinOptions& options = {});

}  // namespace equipoise

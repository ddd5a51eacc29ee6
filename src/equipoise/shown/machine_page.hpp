// Everything that the page for one machine shows, computed.
#pragma once

#include "equipoise/ensembles/basin.hpp"
#include "equipoise/results/machine_page.hpp"

namespace equipoise {

/// Runs the ensemble and follows what is to be shown of it. Throws as basin() does. Stopped, it holds what was done.
/// `options` are those of basin(), but that transients are gathered, and starts kept (the first million: of all of a
/// grid), whatever is said of them. `given`: of the study (html/given_machine.hpp).
MachinePage machine_page(const Study& study, GivenMachine given, const BasinOptions& options = {});

}  // namespace equipoise

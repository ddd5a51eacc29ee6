// Writes the page for one machine, for any command.
#pragma once

#include <string>
#include <vector>

#include "equipoise/analyses/sweeps/sweep_plan.hpp"
#include "equipoise/report/decision/verdict.hpp"
#include "equipoise/report/shown/machine_page.hpp"

namespace equipoise::app {

/// Says before anything is computed that no balancer can help, if so.
void say_to_leave_out(const Study& study, bool quiet);

/// What a page shows.
struct WrittenPage {
  MachinePage content;
  std::vector<TriedChange> tried;
};

/// Runs the ensemble, tries changes if `changes` and its verdict asks for them, and writes the page (.html). `study`
/// must result from `source`.
WrittenPage write_machine_page(const StudySource& source, const Study& study, const BasinOptions& options, bool changes,
                               const std::string& path);

}  // namespace equipoise::app

// equipoise inspect: what a file of results holds.
#include <memory>
#include <string>

#include "commands.hpp"
#include "equipoise/report/reports/inspection_report.hpp"
#include "equipoise/results/result_files/inspection.hpp"
#include "streams.hpp"
#include "help.hpp"

namespace equipoise::app {

Command add_inspect(CLI::App& app) {
  struct Arguments {
    std::string file;
    bool json = false;
  };
  const auto a = std::make_shared<Arguments>();
  app.add_option("file", a->file, help::inspect::file)->required()->type_name("FILE");
  app.add_flag("--json", a->json, help::json);
  return [a]() -> int {
    const Inspection inspection = inspect_file(a->file);
    put(a->json ? inspection_json(inspection) : inspection_text(inspection));
    return inspection.damage.empty() ? done : check_failed;
  };
}

}  // namespace equipoise::app

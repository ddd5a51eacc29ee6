// The audit: draws studies over all legal settings, computes each result, follows its starts further, and transforms
// the study in every way that must not change the result.
//
//     equipoise_audit [--studies N] [--seed S] [--only K] [--starts N] [--seconds T] [--threads T] [--folder DIR]
//                     [--json FILE]
//     equipoise_audit --machines STARTS [--only K] [--threads T]
//     equipoise_audit --families STARTS [--only K] [--threads T]
//
// The second form decides STARTS starts of each machine in a list and follows every one further. The third decides
// starts that draw their rotors, and decides each again with its rotor known exactly.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>

#include "checks.hpp"
#include "families.hpp"
#include "machines.hpp"
#include "table.hpp"

namespace {

using namespace equipoise::audit;

struct Arguments {
  Settings settings;
  int studies = 40, only = -1;
  std::uint64_t seed = 1, machine_starts = 0, family_starts = 0;
  std::string json;
};

int usage() {
  fmt::print(stderr,
             "usage: equipoise_audit [--studies N (40)] [--seed S (1)] [--only NUMBER] [--starts N (300)]\n"
             "                       [--seconds CPU_A_STUDY (40)] [--threads T] [--folder DIR] [--json FILE]\n"
             "       equipoise_audit --machines STARTS [--only NUMBER] [--threads T]\n"
             "       equipoise_audit --families STARTS [--only NUMBER] [--threads T]\n");
  return 2;
}

bool read(int argc, char** argv, Arguments& a) {
  a.settings.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string option = argv[i], value = argv[i + 1];
    char* end = nullptr;
    const double number = std::strtod(value.c_str(), &end);
    const bool whole = end && *end == '\0' && !value.empty() && number >= 0.0 && number <= 1e9;
    if (option == "--folder")
      a.settings.folder = value;
    else if (option == "--json")
      a.json = value;
    else if (!whole)
      return false;
    else if (option == "--studies")
      a.studies = static_cast<int>(number);
    else if (option == "--machines" && number >= 1.0)
      a.machine_starts = static_cast<std::uint64_t>(number);
    else if (option == "--families" && number >= 1.0)
      a.family_starts = static_cast<std::uint64_t>(number);
    else if (option == "--only")
      a.only = static_cast<int>(number);
    else if (option == "--seed")
      a.seed = static_cast<std::uint64_t>(number);
    else if (option == "--starts" && number >= 1.0)
      a.settings.starts = static_cast<std::uint64_t>(number);
    else if (option == "--seconds")
      a.settings.seconds = number;
    else if (option == "--threads" && number >= 1.0)
      a.settings.threads = static_cast<int>(number);
    else
      return false;
  }
  a.settings.machine_starts = std::max<std::uint64_t>(1, a.settings.starts / 3);
  return argc % 2 == 1;
}

int run_machines(const Arguments& a) {
  std::uint64_t decided = 0, wrong = 0;
  fmt::print("{}", machine_head());
  for (std::size_t k = 0; k < machine_count(); ++k) {
    if (a.only >= 0 && static_cast<std::size_t>(a.only) != k) continue;
    const MachineAudit audit = audit_machine(k, a.machine_starts, a.settings);
    decided += audit.decided;
    wrong += audit.wrong;
    fmt::print("{}", machine_line(audit));
    std::fflush(stdout);
  }
  fmt::print("\n{} of {} decided starts are something else later\n", wrong, decided);
  return wrong > 0 ? 3 : 0;
}

int run_families(const Arguments& a) {
  std::uint64_t different = 0, apart = 0;
  fmt::print("{}", family_head());
  for (std::size_t k = 0; k < machine_count(); ++k) {
    if (a.only >= 0 && static_cast<std::size_t>(a.only) != k) continue;
    if (machine_study(k).uncertain.empty()) continue;
    const FamilyAudit audit = audit_family(k, a.family_starts, a.settings);
    different += audit.different;
    apart += std::fabs(audit.deviation) > largest_deviation;
    fmt::print("{}", family_line(audit));
    std::fflush(stdout);
  }
  fmt::print("\n{} starts are otherwise where their rotor is known exactly; shares of {} machines are\n", different,
             apart);
  return different + apart > 0 ? 3 : 0;
}

int run(const Arguments& a) {
  // Threads beyond the machine's cores are made too: three are needed to test independence of their number.
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism,
                                    std::max<std::size_t>(3, static_cast<std::size_t>(a.settings.threads)));
  std::vector<StudyAudit> audits;
  std::string faults;
  int failed = 0;
  double seconds = 0.0;
  fmt::print("{}", table_head());
  for (int k = 0; k < a.studies; ++k) {
    if (a.only >= 0 && k > 0) break;
    audits.push_back(audit_study(draw_study(a.seed, a.only >= 0 ? a.only : k), a.settings));
    failed += audits.back().failed();
    seconds += audits.back().seconds;
    fmt::print("{}", table_line(audits.back()));
    std::fflush(stdout);
    faults += faults_text(audits.back());
  }
  fmt::print("\n{}{} of {} studies failed a check; seed {}; {:.0f} s CPU\n", faults.empty() ? "" : faults + "\n",
             failed, audits.size(), a.seed, seconds);
  if (!a.json.empty()) {
    std::ofstream file(a.json);
    if (!(file << audits_json(audits, a.seed)).flush()) throw std::runtime_error(a.json + ": cannot be written");
  }
  if (std::fflush(stdout) != 0) throw std::runtime_error("standard output cannot be written");
  return failed > 0 ? 3 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  if (!read(argc, argv, a)) return usage();
  try {
    if (a.family_starts > 0) return run_families(a);
    return a.machine_starts > 0 ? run_machines(a) : run(a);
  } catch (const std::exception& e) {
    fmt::print(stderr, "equipoise_audit: {}\n", e.what());
    return 1;
  }
}

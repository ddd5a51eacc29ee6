// Fuzz target of the readers of files: results, unfinished parts, certificates, notes, each changed and sealed again.
//
// A checksum does not prove where a file comes from. So what is changed here is what lies behind the checksums: records
// and their members, dimensions, attributes. Every such file is read, or refused by InputError or RunError in one line
// without control characters. Input i depends on the seed and i alone.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include <unistd.h>

#include "equipoise/attractors/motions/motion_bytes.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/analyses/basin_slices/slice_store.hpp"
#include "equipoise/extras/proof/certify.hpp"
#include "equipoise/results/cell_files/sweep_cells.hpp"
#include "equipoise/simulation/rule/pilot.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/results/io/journal.hpp"
#include "equipoise/results/result_files/basin_file.hpp"
#include "equipoise/results/result_files/basin_outcomes.hpp"
#include "equipoise/results/result_files/inspection.hpp"
#include "equipoise/analyses/sweeps/sweep.hpp"
#include "equipoise/analyses/sweeps/sweep_axis.hpp"
#include "equipoise/analyses/sweeps/sweep_plan.hpp"
#include "file_changes.hpp"

namespace equipoise {
namespace {

namespace fs = std::filesystem;

constexpr char toml[] = R"([rotor]
eccentricity = 0.01
damping = 0.5
[balancer]
balls = 2
mass = 0.05
drag = 0.25
[speed]
profile = "constant"
speed = 2.4
[sampling]
starts = 12
)";

constexpr double longest = 2.0;  // CPU seconds, under a sanitizer; most inputs take a thousandth of that

std::uint64_t current_seed = 1, current_index = 0;

std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}
void write(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

template <class T>
std::function<void(const std::string&)> note_reader() {
  return [](const std::string& bytes) {
    T value{};
    const std::vector<char> note(bytes.begin(), bytes.end());
    BytesIn in(note);
    in(value);
    if (in.whole() && bytes_of(value).size() > note.size()) std::abort();
  };
}

// What there is to read: a sound example, how it is changed, and all that reads it.
struct Kind {
  std::string name, seed;
  std::string (*change)(const std::string&);
  std::function<void(const std::string&)> read;
};

class Kinds {
 public:
  explicit Kinds(const std::string& folder) : folder_(folder) {
    add_results();
    add_journals();
    const std::string certificates = certificates_json(certify(parse_study(toml, "study")));
    kinds.push_back({"certificate", certificates, fuzz::changed_text,
                     [](const std::string& text) { (void)checked_certificates(text, "certificate"); }});
    PilotRecord record;
    record.features[0] = 1.5;
    Motion motion;
    motion.state = Eigen::VectorXd::Ones(8);
    motion.exponents = {-1.0, -2.0};
    motion.orbit.nodes = {motion.state, motion.state};
    const auto text = [](const std::vector<char>& bytes) { return std::string(bytes.begin(), bytes.end()); };
    kinds.push_back({"note of a motion", text(bytes_of(std::optional(motion))), fuzz::changed_raw,
                     note_reader<std::optional<Motion>>()});
    kinds.push_back({"note of records", text(bytes_of(std::vector{record, record})), fuzz::changed_raw,
                     note_reader<std::vector<PilotRecord>>()});
  }

  std::vector<Kind> kinds;

 private:
  std::string path(const std::string& name) const { return folder_ + "/" + name; }

  static io::SliceFileHeader map_header() {
    io::SliceFileHeader header;
    header.study = toml;
    header.x = {"initial.phi_1", 0.0, 6.0, 4};
    header.y = {"initial.phi_2", 0.0, 6.0, 4};
    header.components = 8;
    header.flipped = wilson_share(1, 16);
    return header;
  }
  static void read_map(const std::string& file, const io::SliceFileHeader& header) {
    const SliceStore store(file, header);
    store.for_each_known([](std::uint32_t, short) {});
    std::vector<SlicePixel> rows(16);
    store.read_rows(0, 4, rows.data());
  }

  void add_results() {
    const Study study = parse_study(toml, "study");
    BasinOptions options;
    options.output = path("basin.nc");
    (void)basin(study, options);
    SweepOptions of_sweep;
    of_sweep.output = path("sweep.nc");
    const SweepPlan plan({toml, "study", {}}, sweep_axes({"speed.final=2.4,2.5"}, false, "over"), {}, "over");
    (void)sweep(plan, of_sweep);
    const auto reader = [this](const std::string& name, const std::function<void(const std::string&)>& read) {
      return [this, name, read](const std::string& bytes) {
        const std::string file = path(name);
        write(file, bytes);
        const Inspection seen = inspect_file(file);
        if (seen.damage.find('\n') != std::string::npos) std::abort();
        read(file);
      };
    };
    kinds.push_back({"ensemble", content(path("basin.nc")), fuzz::changed_results,
                     reader("a.nc", [](const std::string& file) { (void)read_basin_outcomes(file); })});
    kinds.push_back({"sweep", content(path("sweep.nc")), fuzz::changed_results,
                     reader("b.nc", [](const std::string& file) { (void)stored_sweep(file); })});
    const io::SliceFileHeader header = map_header();
    {
      SliceStore store(path("map.nc"), header);
      store.append_attractor_search(std::vector<double>(8, 2.0));
      store.append({0, 1, 2, 3, 9}, std::vector<SlicePixel>(5, {1, 2.0, 0.5}));
      const std::vector<OutcomeShare> codes{{1, "balanced", "V1", {}}};
      store.finish(codes, {{short{1}, codes.front()}}, true, header.flipped);
    }
    kinds.push_back({"map", content(path("map.nc")), fuzz::changed_results,
                     reader("c.nc", [header](const std::string& file) { read_map(file, header); })});
    const SweepResult known = stored_sweep(path("sweep.nc"));
    const auto cell = io::bytes_of(*known.cells.front());
    const std::string part = path("b.nc.part");
    {
      io::Journal journal(part, "b.nc", known.identity);
      for (std::uint64_t k = 0; k < 2; ++k)
        journal.append({.kind = io::Journal::Kind::cell, .first = k, .count = 1}, cell.data(), cell.size());
    }
    kinds.push_back({"part of a sweep", content(part), fuzz::changed_journal,
                     reader("b.nc.part", [](const std::string& file) { (void)stored_sweep(file); })});
    fs::remove(part);
    const std::string record(cell.begin(), cell.end());
    kinds.push_back({"record of a cell", record, fuzz::changed_cbor, [](const std::string& bytes) {
                       (void)io::cell_from({bytes.begin(), bytes.end()});
                     }});
    CapacityTrial trial;
    trial.states = {{1.0, 2.0}};
    const auto trials = io::bytes_of(std::vector{trial, trial});
    kinds.push_back({"record of trials", std::string(trials.begin(), trials.end()), fuzz::changed_cbor,
                     [](const std::string& bytes) {
                       (void)io::trials_from({bytes.begin(), bytes.end()});
                     }});
    KeptSample sample;
    sample.sample.figures = {{1.0, 0.5, 2.0}};
    const auto kept = io::bytes_of(sample);
    kinds.push_back(
        {"record of a sample", std::string(kept.begin(), kept.end()), fuzz::changed_cbor, [](const std::string& bytes) {
           (void)io::sample_from({bytes.begin(), bytes.end()});
         }});
  }

  void add_journals() {
    BasinFileHeader header;
    header.study = toml;
    header.cpu_target = "AVX2";
    header.arithmetic = "fused";
    header.variables = {"x", "y", "u", "v", "phi_1", "phi_2", "phi_dot_1", "phi_dot_2"};
    const std::string result = path("d.nc"), part = result + ".part";
    {
      BasinFile file(result, header);
      StartArrays starts;
      starts.starts = 4;
      starts.phi.assign(8, 1.0);
      starts.outcome.assign(4, 1);
      starts.decision_time.assign(4, 2.0);
      starts.decided_by.assign(4, static_cast<signed char>(DecidedBy::windows));
      for (int k = 0; k < 3; ++k) file.append(starts, {});
      file.append_attractor_search(std::vector<double>(8, 2.0));
    }
    kinds.push_back(
        {"part of an ensemble", content(part), fuzz::changed_journal, [header, result, part](const std::string& bytes) {
           write(part, bytes);
           (void)inspect_file(part);
           const BasinFile file(result, header);
           (void)file.read(0, file.stored());
         }});
    const io::SliceFileHeader of_map = map_header();
    const std::string map = path("e.nc"), pixels = map + ".part";
    {
      SliceStore store(map, of_map);
      store.append_code({1, "balanced", "", {}});
      store.append({0, 1, 5}, std::vector<SlicePixel>(3));
      store.append_attractor_search(std::vector<double>(8, 2.0));
    }
    kinds.push_back(
        {"part of a map", content(pixels), fuzz::changed_journal, [of_map, map, pixels](const std::string& bytes) {
           write(pixels, bytes);
           read_map(map, of_map);
         }});
  }

  std::string folder_;
};

void check_message(const std::string& what) {
  bool good = what.size() < 2000;
  for (const char c : what) good = good && static_cast<unsigned char>(c) >= 0x20 && c != 0x7f;
  for (const char* inner : {"std::", "json.exception", "::at"}) good = good && what.find(inner) == std::string::npos;
  if (good) return;
  std::fprintf(stderr, "finding: no message in one line: %s\n", what.c_str());
  std::abort();
}

// Any other exception is a finding: it ends the program through std::abort.
void feed(const Kind& kind, const std::string& bytes) noexcept {
  try {
    kind.read(bytes);
  } catch (const InputError& e) {
    check_message(e.what());
  } catch (const RunError& e) {
    check_message(e.what());
  }
}

void name_input(int) {
  std::fprintf(stderr, "file_fuzz: at input %llu of seed %llu\n", static_cast<unsigned long long>(current_index),
               static_cast<unsigned long long>(current_seed));
  std::_Exit(1);
}

int run(std::uint64_t inputs, std::int64_t only) {
  const std::string folder = (fs::temp_directory_path() / ("equipoise_file_fuzz_" + std::to_string(getpid()))).string();
  fs::create_directories(folder);
  const Kinds all(folder);
  for (const Kind& kind : all.kinds) {
    feed(kind, kind.seed);
    kind.read(kind.seed);  // a sound example is read
  }
  const std::uint64_t first = only >= 0 ? static_cast<std::uint64_t>(only) : 0;
  for (current_index = first; current_index < (only >= 0 ? first + 1 : inputs); ++current_index) {
    fuzz::begin(current_seed, current_index);
    const Kind& kind = all.kinds[fuzz::below(all.kinds.size())];
    if (only >= 0) std::fprintf(stderr, "%s\n", kind.name.c_str());
    const std::clock_t begin = std::clock();
    feed(kind, kind.change(kind.seed));
    if (static_cast<double>(std::clock() - begin) > longest * CLOCKS_PER_SEC) {
      std::fprintf(stderr, "finding: %s takes too long\n", kind.name.c_str());
      std::abort();
    }
  }
  fs::remove_all(folder);
  std::printf("%llu inputs of %zu kinds\n", static_cast<unsigned long long>(inputs), all.kinds.size());
  return 0;
}

}  // namespace
}  // namespace equipoise

// file_fuzz [INPUTS [SEED [ONLY]]]
int main(int count, char** words) {
  const auto number = [&](int k, std::uint64_t otherwise) {
    return count > k ? std::strtoull(words[k], nullptr, 10) : otherwise;
  };
  for (const int end : {SIGABRT, SIGSEGV, SIGFPE}) std::signal(end, equipoise::name_input);
  equipoise::current_seed = number(2, 1);
  return equipoise::run(number(1, 20000), count > 3 ? static_cast<std::int64_t>(number(3, 0)) : -1);
}

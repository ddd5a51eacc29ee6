// Recognises kinds of files by their content.
#include "equipoise/results/result_files/inspection.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/read_file.hpp"
#include "equipoise/results/cell_files/cell_file.hpp"
#include "equipoise/results/io/journal.hpp"
#include "equipoise/results/io/replacement.hpp"
#include "equipoise/results/result_files/basin_outcomes.hpp"
#include "equipoise/results/result_files/result_identity.hpp"

namespace equipoise {

namespace {

// What was varied and looked for.
void add_question(const io::IdentityLines& identity, Inspection& i) {
  for (const std::string& parameter : identity.over()) i.facts.emplace_back("over", parameter);
  for (const char* key : {"of", "at_least", "by", "from", "to", "unit"})
    if (const std::string value = identity.value(std::string("capacity.") + key); !value.empty())
      i.facts.emplace_back(key, value);
}

std::string kind_of(const io::NetcdfFile& file) {
  if (std::string kind = file.attribute("kind"); !kind.empty()) return kind;
  if (file.length("start") > 0) return file.length("t") > 0 ? "trajectories" : "basin";
  if (file.length("x") > 0 && file.length("y") > 0) return "map";
  if (!file.attribute("parameter").empty()) return "branches";
  return file.length("t") > 0 || file.length("time") > 0 ? "trajectory" : "";
}

// Reads the records as the commands do. What those refuse is damage.
std::set<std::size_t> sound_cells(const io::CellFileKind& kind, Inspection& i) {
  std::set<std::size_t> cells;
  try {
    io::CellFile(kind, i.path, [&](std::size_t cell, const std::vector<std::uint8_t>& record) {
      kind.check(record);
      cells.insert(cell);
    });
  } catch (const InputError& e) {
    i.damage += (i.damage.empty() ? "" : "; ") + e.wrong();
  }
  return cells;
}

void read_results_file(Inspection& i) {
  const io::NetcdfFile file(i.path, io::NetcdfFile::Mode::read);
  i.kind = kind_of(file);
  const std::string source = file.attribute("source"), identity = file.lines("identity");
  i.version = source.starts_with("equipoise ") ? source.substr(10) : "";
  if (const std::string complete = file.attribute("complete"); !complete.empty()) i.complete = complete == "yes";
  i.study = file.lines("study");
  constexpr std::array told{"start",     "x", "y",    "value",    "attractor", "event",
                            "discovery", "t", "time", "ensemble", "front"};
  for (const char* dimension : told)
    if (const std::size_t length = file.length(dimension)) i.facts.emplace_back(dimension, fmt::format("{}", length));
  for (const io::CellFileKind& kind : io::cell_file_kinds) {
    if (i.kind != kind.name) continue;
    const std::size_t done = sound_cells(kind, i).size();
    if (const auto cells = io::IdentityLines(identity).cells())
      i.facts.emplace_back("cells done", fmt::format("{} of {}", done, *cells));
    add_question(io::IdentityLines(identity), i);
  }
  if (i.kind == "basin" || i.kind == "map") i.outcomes = io::read_outcome_kinds(file, i.kind == "map" ? "" : "kind_");
  if (i.kind == "basin") io::require_outcomes(file, i.outcomes);
  for (const char* name : {"parameter", "axes", "links", "cpu_target", "seconds"})
    if (const std::string value = file.attribute(name); !value.empty()) i.facts.emplace_back(name, value);
}

// A basin may have any number of starts, so its identity names none: it has 1 instead, except on a grid.
std::string study_of(const io::IdentityLines& identity) {
  const std::string placeholder = "starts = 1\n";
  std::string study = identity.study;
  const std::size_t at = identity.value("angles").empty() ? std::string::npos : study.find(placeholder);
  return at == std::string::npos ? study : study.erase(at, placeholder.size());
}

void read_unfinished(Inspection& i) {
  const io::Journal journal(i.path);
  const io::IdentityLines identity(display_lines(journal.identity()));
  i.kind = "unfinished results";
  i.complete = false;
  i.version = identity.value("version");
  i.study = study_of(identity);
  add_question(identity, i);
  using Kind = io::Journal::Kind;
  std::map<Kind, std::uint64_t> done;
  for (const io::Journal::Record& record : journal.records()) {
    std::uint64_t& count = done[record.kind];
    count = record.kind == Kind::starts ? std::max(count, record.first + record.count)
            : record.kind == Kind::note ? count + 1
                                        : count + record.count;
  }
  i.damage = journal.loss();
  for (const io::CellFileKind& kind : io::cell_file_kinds)
    if (done[kind.record] > 0)
      if (const std::size_t cells = sound_cells(kind, i).size(); kind.record == Kind::cell) done[Kind::cell] = cells;
  for (const auto& [kind, fact] : {std::pair{Kind::starts, "starts done"},
                                   {Kind::pixels, "pixels done"},
                                   {Kind::trial, "trials done"},
                                   {Kind::ensemble, "ensembles done"},
                                   {Kind::cell, "cells done"},
                                   {Kind::note, "steps of the search"}})
    if (done[kind] > 0)
      i.facts.emplace_back(fact, fmt::format("{}{}", kind == Kind::starts ? "up to number " : "", done[kind]));
  i.facts.emplace_back("sound records", fmt::format("{}", journal.records().size()));
}

}  // namespace

Inspection inspect_file(const std::string& path) {
  Inspection i;
  i.path = path;
  std::error_code error;
  i.bytes = std::filesystem::file_size(path, error);
  if (error || !std::filesystem::is_regular_file(path))
    throw InputError(
        path, "", "",
        fmt::format(
            "cannot be read ({}); must be a file of results (.nc), or its unfinished part (.nc.part)",
            error && error != std::errc::not_supported ? unreadable_because(error.value()) : "not a regular file"));
  if (!io::is_netcdf(path)) {
    read_unfinished(i);
    return i;
  }
  i.damage = io::why_not_whole(path);
  if (!i.damage.empty()) return i;
  try {
    read_results_file(i);
  } catch (const InputError& e) {
    i.damage = e.wrong();
  } catch (const RunError& e) {
    i.damage = e.what();
  }
  if (!i.damage.empty()) i.complete.reset();
  return i;
}

}  // namespace equipoise

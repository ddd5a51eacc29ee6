// Designs: one record an ensemble.
#include <algorithm>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "equipoise/results/cell_files/cell_dataset.hpp"
#include "equipoise/results/cell_files/cell_file.hpp"
#include "equipoise/results/io/dataset_file.hpp"

namespace equipoise {

namespace {

std::string variable_of(const std::string& figure) {
  std::string name;
  for (const char c : figure) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name.front() == '_' ? "less" + name : name;
}

// The columns refer to `samples`.
void add_figures(Dataset& data, const DesignResult& result, const std::string& prefix, std::size_t along,
                 const std::vector<const DesignSample*>& samples, const std::string& of) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const auto add = [&](const std::string& name, const std::string& unit, const std::string& meaning,
                       const std::function<double(const DesignSample&)>& value) {
    const auto of_sample = [&samples, value](std::size_t k) { return k < samples.size() ? value(*samples[k]) : none; };
    data.add(name, unit.empty() ? "1" : unit, meaning, {along}, of_sample).fill = none;
  };
  add(prefix + "starts", "1", "starts " + of, [](const DesignSample& s) { return static_cast<double>(s.starts); });
  add(prefix + "undecided", "1", "undecided share " + of, [](const DesignSample& s) { return s.undecided.value; });
  for (std::size_t k = 0; k < result.figures.size(); ++k) {
    const DesignFigure& figure = result.figures[k];
    const std::string name = prefix + variable_of(figure.name);
    const auto part = [k](double DesignEstimate::*end) {
      return [k, end](const DesignSample& s) { return s.figures.empty() ? none : s.figures[k].*end; };
    };
    add(name, figure.unit, figure.name + " " + of, part(&DesignEstimate::value));
    add(name + "_low", figure.unit, io::lower_end, part(&DesignEstimate::low));
    add(name + "_high", figure.unit, io::upper_end, part(&DesignEstimate::high));
  }
}

void write_design(const std::string& path, const std::string& identity, const DesignResult& result,
                  const KeptSamples& samples, const io::CellRecords& records) {
  io::CellDataset data("Design: candidates, and those that no other beats", {}, records);
  const std::size_t count = std::max<std::size_t>(samples.size(), 1), ensemble = data.dimension("ensemble", count);
  std::vector<std::string> names;
  std::vector<const DesignSample*> all, front;
  for (const auto& [number, kept] : samples) {
    names.push_back(kept.name);
    all.push_back(&kept.sample);
  }
  names.resize(count);
  data.add_texts("candidate", ensemble, names, "starts, seed and values of the candidate")
      .attributes.emplace_back("units", "1");
  add_figures(data, result, "", ensemble, all, "of the ensemble");
  for (const DesignCandidate& c : result.front) front.push_back(&c.best_known());
  if (!front.empty())
    add_figures(data, result, "front_", data.dimension("front", front.size()), front,
                result.partial ? "of the front, on the starts of the search" : "of the front, on held-out starts");
  data.add_records("design", identity, result.study, !result.partial);
  data.say("best_study", result.best_study);
  io::write_netcdf_file(path, data);
}

}  // namespace

namespace io {

std::unique_ptr<CellFile> open_design_file(const std::string& path, const std::string& identity, std::size_t most,
                                           KeptSamples& kept) {
  const auto take = [&kept](std::size_t number, const std::vector<std::uint8_t>& record) {
    kept[number] = sample_from(record);
  };
  return std::make_unique<CellFile>(design_kind, path, identity, most, take);
}

void finish_design_file(CellFile& file, const DesignResult& result, std::size_t most, const KeptSamples& kept) {
  const auto write = [&](const std::string& path) {
    std::vector<const KeptSample*> all(most);
    for (const auto& [number, sample] : kept)
      if (number < most) all[number] = &sample;
    const CellRecords records(all, [](const KeptSample& sample) { return bytes_of(sample); });
    write_design(path, file.identity(), result, kept, records);
  };
  file.finish(write, result.partial ? CellFile::Rest::all : CellFile::Rest::nothing);
}

}  // namespace io
}  // namespace equipoise

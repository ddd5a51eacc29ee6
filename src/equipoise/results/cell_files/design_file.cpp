// Designs: one record an ensemble.
#include "equipoise/results/cell_files/design_file.hpp"

#include <limits>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <netcdf.h>

#include "equipoise/results/cell_files/cell_netcdf.hpp"
#include "equipoise/results/io/netcdf.hpp"
#include "equipoise/results/words/files.hpp"

namespace equipoise {

namespace {

constexpr io::CellFileKind design_kind{"design", io::Journal::Kind::ensemble};

using KeptSamples = std::map<std::uint64_t, KeptSample>;

std::string variable_of(const std::string& figure) {
  std::string name;
  for (const char c : figure) name += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  return name.front() == '_' ? "less" + name : name;
}

class DesignWriter {
 public:
  DesignWriter(io::NetcdfFile& file, const std::string& identity, const DesignResult& result,
               const KeptSamples& samples, const io::CellRecords& records)
      : file_(file), identity_(identity), result_(result), samples_(samples), table_(file, {}, records) {}

  void write() {
    const std::size_t count = std::max<std::size_t>(samples_.size(), 1);
    const int ensemble = file_.dimension("ensemble", count);
    std::vector<std::string> names;
    std::vector<const DesignSample*> all, front;
    for (const auto& [number, kept] : samples_) {
      names.push_back(kept.name);
      all.push_back(&kept.sample);
    }
    names.resize(count);
    const int candidate = file_.text_variable("candidate", ensemble, names, words::files::candidate);
    file_.attribute(candidate, "units", "1");
    add_figures("", ensemble, all, "of the ensemble");
    if (!result_.front.empty()) {
      const int member = file_.dimension("front", result_.front.size());
      for (const DesignCandidate& c : result_.front) front.push_back(&c.best_known());
      add_figures("front_", member, front,
                  result_.partial ? words::files::front_of_search : words::files::front_held_out);
    }
    table_.define_records();
    io::define_cell_attributes(file_, "design", words::files::design, identity_, result_.study, !result_.partial);
    file_.attribute(NC_GLOBAL, "best_study", result_.best_study);
    file_.end_definitions();
    table_.write();
    file_.write_texts(candidate, names);
    for (const auto& [variable, values] : columns_) file_.write(variable, {0}, {values.size()}, values.data());
  }

 private:
  void add(const std::string& name, int dimension, const std::string& unit, const std::string& meaning,
           const std::vector<const DesignSample*>& samples, const std::function<double(const DesignSample&)>& value) {
    const int variable = file_.variable(name, NC_DOUBLE, {dimension}, unit.empty() ? "1" : unit, meaning);
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    file_.fill(variable, &none);
    std::vector<double> values;
    for (const DesignSample* s : samples) values.push_back(value(*s));
    columns_.emplace_back(variable, std::move(values));
  }

  void add_figures(const std::string& prefix, int dimension, const std::vector<const DesignSample*>& samples,
                   const std::string& of) {
    add(prefix + "starts", dimension, "1", "starts " + of, samples,
        [](const DesignSample& s) { return static_cast<double>(s.starts); });
    add(prefix + "undecided", dimension, "1", "undecided share " + of, samples,
        [](const DesignSample& s) { return s.undecided.value; });
    for (std::size_t k = 0; k < result_.figures.size(); ++k) {
      const DesignFigure& figure = result_.figures[k];
      const std::string name = prefix + variable_of(figure.name);
      const auto part = [k](double DesignEstimate::*end) {
        return [k, end](const DesignSample& s) {
          return s.figures.empty() ? std::numeric_limits<double>::quiet_NaN() : s.figures[k].*end;
        };
      };
      add(name, dimension, figure.unit, figure.name + " " + of, samples, part(&DesignEstimate::value));
      add(name + "_low", dimension, figure.unit, words::files::lower_end, samples, part(&DesignEstimate::low));
      add(name + "_high", dimension, figure.unit, words::files::upper_end, samples, part(&DesignEstimate::high));
    }
  }

  io::NetcdfFile& file_;
  const std::string& identity_;
  const DesignResult& result_;
  const KeptSamples& samples_;
  io::CellTable table_;
  std::vector<std::pair<int, std::vector<double>>> columns_;
};

}  // namespace

DesignFile::DesignFile(const std::string& path, const std::string& identity, std::size_t most)
    : most_(most),
      file_(design_kind, path, identity, most, [this](std::size_t number, const std::vector<std::uint8_t>& record) {
        samples_[number] = io::sample_from(record);
      }) {}

std::optional<DesignSample> DesignFile::sample(std::uint64_t number, const std::string& name) const {
  const auto at = samples_.find(number);
  if (at == samples_.end() || at->second.name != name) return std::nullopt;
  return at->second.sample;
}

void DesignFile::append(std::uint64_t number, const std::string& name, const DesignSample& sample) {
  const KeptSample& kept = samples_[number] = {name, sample};
  file_.append(number, io::bytes_of(kept));
}

void DesignFile::finish(const DesignResult& result) {
  const auto write = [&](const std::string& path, const std::string& identity) {
    const io::CellRecords records(most_, [&](std::size_t number) {
      const auto at = samples_.find(number);
      return at == samples_.end() ? std::vector<std::uint8_t>{} : io::bytes_of(at->second);
    });
    io::write_netcdf_file(
        path, [&](io::NetcdfFile& file) { DesignWriter(file, identity, result, samples_, records).write(); },
        records.mode());
  };
  file_.finish(write, result.partial ? io::CellFile::Rest::all : io::CellFile::Rest::nothing);
}

}  // namespace equipoise

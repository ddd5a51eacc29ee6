// Writes identities, and compares them key by key.
#include "equipoise/results/result_files/result_identity.hpp"

#include <filesystem>
#include <map>
#include <sstream>
#include <string_view>
#include <tuple>

#include <fmt/format.h>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/results/io/replacement.hpp"
#include "equipoise/results/result_files/basin_file.hpp"

namespace equipoise::io {

namespace {

// More would hide which ones differ.
constexpr std::size_t most_told = 3;

std::map<std::string, std::string> values_of(const std::string& identity) {
  std::map<std::string, std::string> values;
  for (const auto& [key, value] : IdentityLines(identity).lines) values[key] = value;
  return values;
}

}  // namespace

std::string identity_of(const BasinFileHeader& header) {
  const auto& asked = header.transients;
  const std::string transients =
      asked ? fmt::format("displacement {}, settled {}, window {}{}", asked->displacement, asked->settled,
                          asked->window, asked->work == WorkSource::none ? "" : ", energy")
            : "none";
  const std::string own = header.own_starts.empty() ? "" : fmt::format("own_starts = {}\n", header.own_starts);
  return fmt::format("{}\n[file]\nversion = {}\narithmetic = {}\n", header.study, version_string, header.arithmetic) +
         fmt::format("angles = {}\ntransients = {}\n{}", header.angles ? "kept" : "left out", transients, own);
}

IdentityLines::IdentityLines(const std::string& identity) : study(identity.substr(0, identity.find("\n[file]"))) {
  std::istringstream text(identity);
  std::string table;
  for (std::string line; std::getline(text, line);) {
    const std::size_t equals = line.find(" = ");
    if (line.starts_with("["))
      table = line.substr(1, line.find(']') - 1) + ".";
    else if (equals != std::string::npos)
      lines.emplace_back((table == "file." ? "" : table) + line.substr(0, equals), line.substr(equals + 3));
  }
}

std::string IdentityLines::value(const std::string& key) const {
  for (const auto& [name, text] : lines)
    if (name == key) return text;
  return "";
}

std::vector<std::string> IdentityLines::over() const {
  constexpr std::string_view table = "sweep.over.";
  std::vector<std::string> parameters;
  for (const auto& [key, text] : lines)
    if (key.starts_with(table)) parameters.push_back(key.substr(table.size()) + "=" + text);
  return parameters;
}

std::optional<std::size_t> IdentityLines::cells() const {
  const std::string axes = value("sweep.axes");
  const std::vector<std::string> parameters = over();
  if (axes.empty()) return {};
  std::size_t cells = 1;
  for (const std::string& parameter : parameters) {
    cells *= parts_of(parameter, ',').size();
    if (axes != std::to_string(parameters.size())) break;  // they vary together
  }
  return cells;
}

std::string axis_text(const SliceAxis& axis) {
  return fmt::format("{} from {} to {} in {} pixels", axis.key, axis.low, axis.high, axis.pixels);
}

std::vector<std::size_t> add_axes(Dataset& data, const SliceAxis& x, const SliceAxis& y) {
  const std::size_t rows = data.dimension("y", static_cast<std::size_t>(y.pixels)),
                    columns = data.dimension("x", static_cast<std::size_t>(x.pixels));
  for (const auto& [name, along, axis] : {std::tuple{"x", columns, &x}, {"y", rows, &y}})
    data.add(name, axis->angle() ? "radian" : "1", axis->key, {along},
             [axis = axis](std::size_t k) { return axis->centre(static_cast<int>(k)); });
  return {rows, columns};
}

void say_axes(Dataset& data, const SliceAxis& x, const SliceAxis& y) {
  data.say("x_key", x.key);
  data.say("y_key", y.key);
  data.say("x_range", fmt::format("{} {}", x.low, x.high));
  data.say("y_range", fmt::format("{} {}", y.low, y.high));
}

std::string difference(const std::string& there, const std::string& here) {
  const auto old_values = values_of(there), values = values_of(here);
  auto all = old_values;
  all.insert(values.begin(), values.end());
  std::string text;
  std::size_t count = 0;
  const auto told = [](const std::map<std::string, std::string>& from, const std::string& key) {
    const auto found = from.find(key);
    return found == from.end() ? "not given" : found->second;
  };
  for (const auto& [key, unused] : all) {
    const std::string before = told(old_values, key), now = told(values, key);
    if (before == now) continue;
    if (++count <= most_told)
      text += fmt::format("{}{} is {} there and {} here", count > 1 ? ", " : "", key, before, now);
  }
  if (count > most_told) text += fmt::format(", and {} more", count - most_told);
  return count == 0 && there != here ? "its header has a different format" : text;
}

void require_same(const std::string& there, const std::string& here, const std::string& of, const std::string& results,
                  const std::string& allowed) {
  const std::string how = difference(there, here);
  if (!how.empty())
    throw InputError(of, "", "", fmt::format("holds something other than {}: {}; {}", results, how, allowed));
}

std::string results_path(const std::string& path) {
  if (const std::string problem = why_no_results_at(path); !problem.empty())
    throw InputError("output", "", path, fmt::format("{}; must be a file that can be written", problem));
  return resolved(path);
}

std::string path_for_whole_results(const std::string& path) {
  const std::string place = results_path(path), unfinished = place + ".part";
  if (std::filesystem::exists(unfinished))
    throw InputError(
        "output", "", path,
        fmt::format("has unfinished results next to it, {}; must be another file, or finish those first", unfinished));
  return place;
}

}  // namespace equipoise::io

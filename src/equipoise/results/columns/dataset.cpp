// Dimensions, columns and attributes are kept in the order in which they are added: a file has them in that order.
#include "equipoise/results/columns/dataset.hpp"

#include <algorithm>

#include "equipoise/core/base/version.hpp"

namespace equipoise {

Dataset::Dataset(const std::string& title) {
  say("Conventions", "CF-1.8");
  say("title", title);
  say("source", std::string("equipoise ") + version_string);
}

std::size_t Dataset::dimension(const std::string& name, std::size_t length) {
  dimensions.push_back({name, length});
  return dimensions.size() - 1;
}

DataColumn& Dataset::add(const std::string& name, const std::string& units, const std::string& long_name,
                         const std::vector<std::size_t>& along, const DataValues& values, DataColumn::Type type) {
  return columns.emplace_back(DataColumn{name, units, long_name, along, values, type});
}

DataColumn& Dataset::add(const Column& told, const std::vector<std::size_t>& along, const DataValues& values,
                         DataColumn::Type type) {
  return add(told.name, told.cf_units(), told.long_name(), along, values, type);
}

DataColumn& Dataset::add_texts(const std::string& name, std::size_t along, const std::vector<std::string>& texts,
                               const std::string& long_name) {
  std::size_t width = 1;
  for (const std::string& text : texts) width = std::max(width, text.size());
  const auto character = [texts, width](std::size_t place) {
    const std::string& text = texts[place / width];
    return place % width < text.size() ? text[place % width] : '\0';
  };
  DataColumn& column =
      add(name, "", long_name, {along, dimension(name + "_characters", width)}, character, DataColumn::Type::text);
  column.attributes.emplace_back("_Encoding", "utf-8");
  return column;
}

}  // namespace equipoise

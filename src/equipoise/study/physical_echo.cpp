// The dimensionless echo with every quantity multiplied by its scale.
#include "equipoise/study/physical_echo.hpp"

#include <utility>

#include <fmt/format.h>

#include "equipoise/study/physical_keys.hpp"

namespace equipoise {

namespace {
using namespace study;

double number_in(const toml::node& node) { return *node.value<double>(); }

// Replaces the numbers of one key by quantities; `scale` has the scale of each entry, the last one for all that follow.
void multiply(toml::table& table, const std::string& key, Dimension dimension, const std::vector<double>& scale) {
  const toml::node* node = table.get(key);
  if (!node) return;
  const auto text = [&](const toml::node& entry, std::size_t i) {
    return quantity_text(number_in(entry) * scale[std::min(i, scale.size() - 1)], dimension);
  };
  if (!node->is_array()) {
    table.insert_or_assign(key, text(*node, 0));
    return;
  }
  toml::array quantities;
  for (const toml::node& entry : *node->as_array()) quantities.push_back(text(entry, quantities.size()));
  table.insert_or_assign(key, std::move(quantities));
}

std::string value_text(const toml::node& node) {
  if (const auto* text = node.as_string()) return fmt::format("\"{}\"", text->get());
  if (const auto* number = node.as_floating_point()) return number_text(number->get());
  if (const auto* whole = node.as_integer()) return fmt::format("{}", whole->get());
  if (const auto* truth = node.as_boolean()) return truth->get() ? "true" : "false";
  std::string entries;
  if (const auto* array = node.as_array())
    for (const toml::node& entry : *array) entries += (entries.empty() ? "" : ", ") + value_text(entry);
  return "[" + entries + "]";
}

// A table's own keys, then the tables in it.
std::string table_text(const std::string& name, const toml::table& table) {
  std::string keys, tables;
  for (const auto& [key, node] : table)
    if (const auto* inner = node.as_table())
      tables += table_text(fmt::format("{}.{}", name, key.str()), *inner);
    else
      keys += fmt::format("{} = {}\n", key.str(), value_text(node));
  return fmt::format("[{}]\n{}\n{}", name, keys, tables);
}

void make_physical(toml::table& root, const model::Parameters& p, const model::Scales& s) {
  toml::table& rotor = *find_table(root, "rotor");
  const auto scaled = [&](toml::table& table, const char* key, Dimension dimension) {
    multiply(table, key, dimension, {scale_of(dimension, s)});
  };
  rotor.insert_or_assign("mass", quantity_text(s.mass, Dimension::mass));
  scaled(rotor, "stiffness", Dimension::stiffness);
  scaled(rotor, "damping", Dimension::damping);
  scaled(rotor, "eccentricity", Dimension::length);
  scaled(rotor, "gravity", Dimension::acceleration);
  scaled(rotor, "inertia", Dimension::inertia);
  toml::table& balancer = *find_table(root, "balancer");
  balancer.insert_or_assign("race_radius", quantity_text(s.length, Dimension::length));
  std::vector<double> drag;  // D_i = beta_i m_i R^2 omega_c
  for (int i = 0; i < p.balls; ++i) drag.push_back(p.mass[static_cast<std::size_t>(i)] * scale_of(Dimension::gain, s));
  multiply(balancer, "drag", Dimension::gain, drag);
  scaled(balancer, "mass", Dimension::mass);
  scaled(balancer, "race_offset", Dimension::length);
  for (const QuantityTable& quantities : quantity_tables())
    if (toml::table* table = find_table(root, quantities.name))
      for (const auto& [key, dimension, range] : quantities.keys)
        if (dimension != Dimension::angle) scaled(*table, key, dimension);
  root.erase("units");
}

}  // namespace

std::string to_physical_toml(const Study& study) {
  if (!study.scales)
    throw InputError(study.name, "units", "", "missing; a dimensionless study is shown in physical units by [units]");
  Document document = parse_document(to_toml(study), study.name, {});
  make_physical(document.root, study.parameters, *study.scales);
  std::string text;
  for (const char* name : {"rotor", "balancer", "speed", "release", "initial", "sampling", "numerics", "limits"})
    if (const toml::table* table = find_table(document.root, name)) text += table_text(name, *table);
  return text;
}

}  // namespace equipoise

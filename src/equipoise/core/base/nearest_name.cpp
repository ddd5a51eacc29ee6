// Edit distances of V. I. Levenshtein (Soviet Physics Doklady 10 (1966) 707), with neighbours that changed places as
// one edit.
#include "equipoise/core/base/nearest_name.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

namespace equipoise {

namespace {

constexpr std::size_t longest_name = 60;

// Edits that make one text of the other: a letter more, less or another, or two neighbours that changed places.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before, above);
    std::swap(above, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

}  // namespace

std::string in_small_letters(std::string_view text) {
  std::string small(text);
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return small;
}

bool is_among(std::string_view names, std::string_view name) {
  if (name.empty() || name.find(' ') != std::string_view::npos) return false;
  for (std::size_t at = 0; (at = names.find(name, at)) != std::string_view::npos; ++at) {
    const std::size_t end = at + name.size();
    if ((at == 0 || names[at - 1] == ' ') && (end == names.size() || names[end] == ' ')) return true;
  }
  return false;
}

std::string nearest_name(std::string_view given, const std::vector<std::string>& known) {
  if (given.size() > longest_name) return "";
  const std::string small = in_small_letters(given);
  std::size_t least = std::min<std::size_t>(3, (small.size() + 1) / 2);
  std::string nearest;
  for (const std::string& name : known)
    if (const std::size_t distance = edit_distance(small, in_small_letters(name)); distance < least) {
      least = distance;
      nearest = name;
    }
  return nearest;
}

std::string did_you_mean(std::string_view given, const std::vector<std::string>& known) {
  const std::string name = nearest_name(given, known);
  return name.empty() ? "" : "did you mean \"" + name + "\"? ";
}

}  // namespace equipoise

// Words for the names that attractors/motions/motion_name.cpp gives.
#include "equipoise/report/decision/plain_names.hpp"

#include <string_view>

#include "equipoise/report/text/words.hpp"

namespace equipoise {

std::string plain_name(const std::string& name) {
  // What follows says which balls move as one and when the motion comes back: (2 together), quasi-periodic, period 3.
  for (const auto& [beginning, plain] : words::decision::plain_words)
    if (name.starts_with(beginning)) return plain + name.substr(std::string_view(beginning).size());
  // "2 captured, 1 drifting"
  const std::size_t stay = name.find(" captured"), go = name.find(" drifting");
  if (stay == name.npos || go == name.npos || stay > go) return "";
  std::string text = name;
  text.replace(go, std::string_view(" drifting").size(), " circulating");
  return "balls: " + text.replace(stay, std::string_view(" captured").size(), " staying");
}

}  // namespace equipoise

// Words for the names that attractors/motions/motion_name.cpp gives.
#include "equipoise/report/decision/plain_names.hpp"

#include <array>
#include <string_view>
#include <utility>

namespace equipoise {

namespace {

// By how names begin; longer beginnings first.
constexpr std::array<std::pair<std::string_view, const char*>, 11> plain_words{{
    {"co-drifting", "balls circulate together"},
    {"drifting apart", "balls circulate apart"},
    {"drifting at different rates", "balls circulate at different rates"},
    {"drifting", "ball circulates"},
    {"pair drift", "balls circulate as a pair"},
    {"one captured", "one ball stays, one circulates"},
    {"both captured", "balls stay, off balance"},
    {"all captured", "balls stay, off balance"},
    {"captured", "ball stays, off balance"},
    {"locked", "balls stay, off balance"},
    {"hanging", "balls stay below the shaft"},
}};

}  // namespace

std::string plain_name(const std::string& name) {
  // What follows says which balls move as one and when the motion comes back: (2 together), quasi-periodic, period 3.
  for (const auto& [beginning, plain] : plain_words)
    if (name.starts_with(beginning)) return plain + name.substr(beginning.size());
  // "2 captured, 1 drifting"
  const std::size_t stay = name.find(" captured"), go = name.find(" drifting");
  if (stay == name.npos || go == name.npos || stay > go) return "";
  std::string text = name;
  text.replace(go, std::string_view(" drifting").size(), " circulating");
  return "balls: " + text.replace(stay, std::string_view(" captured").size(), " staying");
}

}  // namespace equipoise

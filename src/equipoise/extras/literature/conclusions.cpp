// The conclusions, each with the pairs of rows that support it.
#include "equipoise/extras/literature/reproduction.hpp"

namespace equipoise {

namespace {

using Kind = Conclusion::Kind;

std::vector<Contrast> beside(const std::string& first, const std::string& second,
                             const std::vector<const char*>& values) {
  std::vector<Contrast> contrasts;
  for (const char* value : values) contrasts.push_back({first + value, second + value});
  return contrasts;
}

std::vector<Contrast> along(const std::string& stem, const std::vector<const char*>& values) {
  std::vector<Contrast> contrasts;
  for (std::size_t i = 1; i < values.size(); ++i) contrasts.push_back({stem + values[i - 1], stem + values[i]});
  return contrasts;
}

}  // namespace

const std::vector<Conclusion>& conclusions() {
  static const std::vector<Conclusion> list = {
      {"Balls released at the final speed 2.4: a ramp of T0 = 0.1 balances more often than one of 300", 3, Kind::rises,
       along("table-3-t0-", {"300", "0.1"})},
      {"Balls released at the final speed 2.4: from T0 = 5 on the length of the ramp does not matter",
       3,
       Kind::unchanged,
       {{"table-3-t0-300", "table-3-t0-5"},
        {"table-3-t0-300", "table-3-t0-10"},
        {"table-3-t0-300", "table-3-t0-50"},
        {"table-3-t0-300", "table-3-t0-100"}}},
      {"Clamping the balls until the final speed is reached (T0 = 500) balances more often than starting with free "
       "balls at that speed, for 2.0 to 4.0",
       4, Kind::rises,
       beside("table-2-omega-", "table-4-omega-", {"2.0", "2.2", "2.4", "3.0", "3.2", "3.4", "3.6", "3.8", "4.0"})},
      {"Slow spin-up to 2.4 (T0 = 400 and more): releasing the balls early, at 2.2, balances more often than at 2.4",
       5,
       Kind::rises,
       {{"table-3-t0-300", "table-5-t0-400"},
        {"table-4-omega-2.4", "table-5-t0-500"},
        {"table-4-omega-2.4", "table-5-t0-600"},
        {"table-4-omega-2.4", "table-5-t0-800"}}},
      {"Fast spin-up to 2.4 (T0 = 100, 200): releasing at 2.4 balances more often than early, at 2.2", 5, Kind::rises,
       beside("table-5-t0-", "table-3-t0-", {"100", "200"})},
      {"Balls released at 2.2: the slower the spin-up to 2.4, the larger the balanced share (steps of at least 100 "
       "from T0 = 100 to 600)",
       5, Kind::rises, along("table-5-t0-", {"100", "200", "300", "400", "500", "600"})},
      {"Balls released at 2: the slower the spin-up to 5, the larger the balanced share", 6, Kind::rises,
       along("table-6-release-2-t0-", {"100", "150", "200", "300", "400", "500", "1000"})},
      {"Balls released at 3: the slower the spin-up to 5, the larger the balanced share", 6, Kind::rises,
       along("table-6-release-3-t0-", {"100", "150", "200", "300", "400", "500", "1000"})},
      {"Spin-up to 5: releasing at 3 balances more often than releasing at 2", 6, Kind::rises,
       beside("table-6-release-2-t0-", "table-6-release-3-t0-", {"100", "150", "200", "300", "400", "500", "1000"})},
      {"Trapezoid over the final speed 2: the faster the rise to 3, the larger the balanced share",
       7,
       Kind::rises,
       {{"table-7-t0-100-t1-400-t2-500", "table-7-t0-50-t1-400-t2-500"},
        {"table-7-t0-200-t1-400-t2-500", "table-7-t0-100-t1-400-t2-500"}}}};
  return list;
}

}  // namespace equipoise

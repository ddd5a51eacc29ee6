// A note on a result: a sentence whose quantities are known, so that it can be shown in a study's units.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace equipoise {

/// A speed, or growth rates from `least` to `most`, and its place in the text.
struct NotedQuantity {
  enum class Kind { speed, rates };
  Kind kind;
  double least, most;
  std::size_t begin, length;
};

/// Without dimensions, as results are stored; note_text() has it in units.
struct Note : std::string {
  Note& operator=(const std::string& words) {
    assign(words);
    quantities.clear();
    return *this;
  }
  void clear() { *this = std::string(); }

  Note& add(const std::string& words) {
    append(words);
    return *this;
  }
  Note& add_before(const std::string& words) {
    insert(0, words);
    for (NotedQuantity& q : quantities) q.begin += words.size();
    return *this;
  }
  Note& add_speed(double speed) {
    return add(NotedQuantity::Kind::speed, speed, speed, fmt::format("at speed {}", speed));
  }
  Note& add_rates(double least, double most) {
    return add(NotedQuantity::Kind::rates, least, most,
               least == most ? fmt::format("(growth rate {:.3g})", least)
                             : fmt::format("(growth rates {:.3g} to {:.3g})", least, most));
  }

  std::vector<NotedQuantity> quantities;  ///< in the order of the text

 private:
  Note& add(NotedQuantity::Kind kind, double least, double most, const std::string& words) {
    quantities.push_back({kind, least, most, size(), words.size()});
    return add(words);
  }
};

}  // namespace equipoise

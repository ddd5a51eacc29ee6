// Codes of a map's pixels and the names of what they stand for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "equipoise/attractors/motion.hpp"
#include "equipoise/results/basin_slice.hpp"

namespace equipoise {

/// Motions with an identifier of their own have it as their code, others get the next ones, one a name: those usual in
/// maps the same ones everywhere, the rest as they are met while pixels are computed, and in the order of pixels once a
/// map is put together.
class SliceNames {
 public:
  /// Its code, a new one if it is met for the first time.
  short code(const MotionName& motion);
  /// As it was given by an earlier run.
  void know(const OutcomeShare& code);
  /// In the order in which they were met.
  const std::vector<OutcomeShare>& codes() const { return codes_; }

  /// A pixel that was computed.
  void see(short code, std::uint32_t position);
  /// What was seen of pixels, by the codes given so far. In a whole map codes that were given freely become others, in
  /// the order of pixels.
  std::map<short, OutcomeShare> seen(bool whole) const;

 private:
  bool listed(short code) const;

  std::vector<OutcomeShare> codes_;
  std::map<short, std::uint32_t> first_;  // positions
  short last_ = not_computed_code;        // seen, and before it
  std::uint32_t last_first_ = 0;
};

}  // namespace equipoise

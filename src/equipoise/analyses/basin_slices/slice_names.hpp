// Codes of a slice's pixels, and the names behind them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/results/commands/basin_slice.hpp"

namespace equipoise {

/// A motion with a fixed identifier has it as its code. Others get the next codes, one per name. Usual names have the
/// same code in every slice; the rest are numbered as met, and in pixel order once a slice is complete.
class SliceNames {
 public:
  /// The motion's code; a new one if it is met for the first time.
  short code(const MotionName& motion);
  /// A code given by an earlier run.
  void know(const OutcomeShare& code);
  /// A code whose name is lost: no other motion gets it.
  void avoid(short code) { highest_ = std::max(highest_, code); }
  /// In the order in which they were met.
  const std::vector<OutcomeShare>& codes() const { return codes_; }

  /// Records a computed pixel.
  void see(short code, std::uint32_t position);
  /// What was seen of pixels, by the codes given so far. A complete slice renumbers them in pixel order.
  std::map<short, OutcomeShare> seen(bool whole) const;

  /// Whether the code has a name.
  bool listed(short code) const;

 private:
  std::vector<OutcomeShare> codes_;
  short highest_ = 0;                     // of the codes to avoid
  std::map<short, std::uint32_t> first_;  // positions
  short last_ = not_computed_code;        // last code seen; before the first, not_computed_code
  std::uint32_t last_first_ = 0;
};

}  // namespace equipoise

// What was understood of a study, in a few lines: before anything is computed of it.
#pragma once

#include <string>
#include <vector>

#include "equipoise/core/base/stop_flag.hpp"

namespace equipoise {

struct StudyCheck {
  std::string leave_out;                  ///< why no balancer can help, if that is known at once
  std::string machine, unbalance, balls;  ///< as understood, in the study's units
  /// What the study does not state and what matters, each a few words: "balls free from t = 0".
  std::vector<std::string> assumed;
  /// Which of the estimated quantities matters most, and how that was judged.
  std::string most;

  std::string text() const;  ///< at most six lines
};

/// Among what is assumed of a study with uncertain values: what follows without simulation takes them so.
extern const char* const medians_assumed;

/// Of a text that parse_study() takes; throws what it throws. Uncertain values are taken at their medians. Once `stop`
/// is set, what takes integration is left out.
StudyCheck check_study(const std::string& toml_text, const std::string& name,
                       const std::vector<std::string>& overrides = {}, const StopFlag* stop = nullptr);

}  // namespace equipoise

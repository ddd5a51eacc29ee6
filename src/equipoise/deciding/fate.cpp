// Names and codes of outcomes.
#include "equipoise/deciding/fate.hpp"

namespace equipoise {

const char* name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::attracted:
      return "attracted";
    case Outcome::undecided:
      return "undecided";
    case Outcome::diverged:
      return "diverged";
    case Outcome::stalled:
      return "stalled";
    case Outcome::failed:
      break;
  }
  return "failed";
}

short code_of(const Fate& fate) {
  switch (fate.outcome) {
    case Outcome::attracted:
      return fate.attractor;
    case Outcome::undecided:
      return undecided_code;
    case Outcome::diverged:
      return diverged_code;
    case Outcome::stalled:
      return stalled_code;
    default:
      return failed_code;
  }
}

}  // namespace equipoise

// Words and codes for what became of a start.
#include "equipoise/results/types/fate.hpp"

#include "equipoise/results/types/outcomes.hpp"

namespace equipoise {

const char* name_of(Outcome outcome) { return outcome == Outcome::attracted ? "attracted" : told_of(outcome).name; }

short code_of(const Fate& fate) {
  return fate.outcome == Outcome::attracted ? fate.attractor : told_of(fate.outcome).code;
}

}  // namespace equipoise

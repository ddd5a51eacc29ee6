// Pieces that reports share: numbers, the study, how its starts begin.
// This room: words, numbers and tables that reports share.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "equipoise/core/statistics/share.hpp"
#include "equipoise/machine/balance/carrying.hpp"
#include "equipoise/report/text/quantities.hpp"
#include "equipoise/results/types/note.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// With a capital letter, as a sentence begins.
inline std::string capitalised(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
  return text;
}
/// "60.40 %".
std::string percent(double share, int digits);
/// Digits of a percentage that its interval supports.
int digits_for(const Share& s);
/// "60.40 %", without digits that its interval does not support; of none "0 %".
std::string share_text(const Share& s);
/// "60.22 to 60.57 %", "below 0.0013 %".
std::string interval(const Share& s);
/// The same for the bounds that hold whatever open starts come to.
std::string bounds_text(const Share& s);
/// Name, balls, rotor, speed, how long balls are held: the start of every report, with an empty line after it.
std::string study_heading(const Study& study);
/// A note about balance (balanced_regions/balanced_analysis.cpp), with its speed and its growth rates in the study's
/// units, to four digits.
std::string note_text(const Study& study, const Note& note);

std::optional<model::Carrying> carrying(const Study& study);
/// "drag carries hanging balls round from 884 rpm on".
std::string carried_text(const Study& study, const model::Carrying& carrying);
/// A warning if balls may hang at the final speed; else empty.
std::string hanging_text(const Study& study);

/// "published" or "kinematic".
const char* name_of(model::SpeedLaw law);

/// "balls held until t = 40, the end of the ramp"; empty if they are free from the start.
std::string release_text(const Study& study);

/// Keys of [initial] that the study states but an ensemble draws: initial.phi, and those in [sampling.box].
std::vector<std::string> drawn_instead(const Study& study);
/// The same as a sentence with a line end; empty if there are none.
std::string drawn_instead_text(const Study& study);

/// "balls 1 and 2 are alike and start in one place: ..."; empty if there are none.
std::string coincident_text(const Study& study);

}  // namespace equipoise

// Sentences about balls that hang below a shaft across which gravity acts.
#pragma once

#include <optional>
#include <string>

#include "equipoise/machine/balance/carrying.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

std::optional<model::Carrying> carrying(const Study& study);
/// "drag carries hanging balls round from 884 rpm on".
std::string carried_text(const Study& study, const model::Carrying& carrying);
/// A warning if balls may hang at the final speed; else empty.
std::string hanging_text(const Study& study);

}  // namespace equipoise

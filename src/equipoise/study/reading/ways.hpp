// What a data sheet may state in several ways, each with its own key.
#pragma once

#include <string>
#include <string_view>

#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/reading/rules.hpp"

namespace equipoise::study {

/// ", or give rotor.unbalance, mass times eccentricity, such as "300 g mm"": the other ways of a key; else empty.
std::string or_give(std::string_view dotted);

/// Refuses a study that states one thing in several ways.
void refuse_several_ways(const Study& study, const Refuse& refuse);

/// The key, without its table, in which a study states what may be stated by `first`, the first of these ways; empty if
/// it does in none, which is refused if it is `required`.
std::string_view way_of(const Study& study, std::string_view first, const Refuse& refuse, bool required = true);

}  // namespace equipoise::study

// Makes text from outside fit into a one-line message.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace equipoise::study {

inline constexpr std::size_t longest_shown = 60;

/// Escapes control characters; cuts at a whole UTF-8 character.
std::string printable(std::string_view text, std::size_t longest = longest_shown);

}  // namespace equipoise::study

// Makes names from outside, such as file names, fit for any output.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace equipoise {

/// Valid UTF-8 on one line: other bytes become U+FFFD, control characters \u001B and the like.
std::string display_text(std::string_view text);

/// Bytes of the UTF-8 character that begins at `at`; 0 if none does.
std::size_t character_length(std::string_view text, std::size_t at);

}  // namespace equipoise

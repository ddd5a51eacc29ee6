// Names from outside (of files) in a form that any output can hold.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace equipoise {

/// `text` as valid UTF-8 on one line: what is no UTF-8 becomes U+FFFD, control characters become \u001B and their like.
std::string display_text(std::string_view text);

/// Bytes of the UTF-8 character that begins at `at`; 0 if none does.
std::size_t character_length(std::string_view text, std::size_t at);

}  // namespace equipoise

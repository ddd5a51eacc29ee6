// Names from outside (of files) in a form that any output can hold.
#pragma once

#include <string>
#include <string_view>

namespace equipoise {

/// `text` as valid UTF-8 on one line: what is no UTF-8 becomes U+FFFD, control characters become \u001B and their like.
std::string display_text(std::string_view text);

}  // namespace equipoise

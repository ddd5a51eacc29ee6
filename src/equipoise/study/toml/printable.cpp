// Text from outside, shortened to one line.
#include "equipoise/study/toml/printable.hpp"

#include <fmt/format.h>

namespace equipoise::study {

std::string printable(std::string_view text, std::size_t longest) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool continues_character = (byte & 0xC0) == 0x80;
    if (result.size() >= longest && !continues_character) return result + "...";
    if (byte < 0x20 || byte == 0x7F)
      result += fmt::format("\\u{:04X}", byte);
    else
      result += c;
  }
  return result;
}

}  // namespace equipoise::study

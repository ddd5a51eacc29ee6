// Escapes text for pages.
#pragma once

#include <string>

namespace equipoise {

/// `text` with markup characters escaped.
inline std::string html_text(const std::string& text) {
  std::string result;
  for (const char c : text) switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  return result;
}

}  // namespace equipoise

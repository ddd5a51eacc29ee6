// A whole file as text, or why it cannot be read.
#pragma once

#include <cstddef>
#include <string>

namespace equipoise {

/// Why a file that could not be opened cannot be read, in words: by `errno` of the attempt.
std::string unreadable_because(int error);

struct FileText {
  std::string text;
  std::string problem;  ///< empty if the file was read
};

/// An endless file such as /dev/zero stops at `longest` bytes, a multiple of 1 MiB. Throws Interrupted if a signal ends
/// the wait for a pipe.
FileText read_file(const std::string& path, std::size_t longest);

}  // namespace equipoise

// Files that tests write and read.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

namespace equipoise {

inline std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A path used only by this process, where nothing exists yet.
inline std::string scratch_file(const std::string& name) {
  const std::string path = testing::TempDir() + "equipoise_" + std::to_string(getpid()) + "_" + name;
  std::filesystem::remove(path);
  std::filesystem::remove(path + ".part");
  return path;
}

}  // namespace equipoise

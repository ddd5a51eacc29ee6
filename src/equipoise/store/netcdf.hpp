// A thin, owning wrapper around the NetCDF C library: every call is checked, every failure an exception.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace equipoise::store {

/// One open NetCDF-4 file, closed on destruction.
class NetcdfFile {
 public:
  enum class Mode { create, update };
  /// Throws RunError naming the file.
  NetcdfFile(const std::string& path, Mode mode);
  ~NetcdfFile();
  NetcdfFile(const NetcdfFile&) = delete;
  NetcdfFile& operator=(const NetcdfFile&) = delete;

  static constexpr std::size_t unlimited = 0;
  int dimension(const std::string& name, std::size_t length);
  std::size_t length(const std::string& dimension) const;
  /// Every variable carries its units and a long_name.
  int variable(const std::string& name, int type, const std::vector<int>& dimensions, const std::string& units,
               const std::string& long_name);
  int variable(const std::string& name) const;
  /// What stands where nothing was written, of the variable's type; also its attribute _FillValue.
  void fill(int variable, const void* value);
  void chunk(int variable, const std::vector<std::size_t>& sizes);
  /// Lossless compression; the variable is chunked.
  void compress(int variable);
  void attribute(int variable, const std::string& name, const std::string& text);
  void attribute(int variable, const std::string& name, const std::vector<signed char>& values);
  void attribute(int variable, const std::string& name, const std::vector<short>& values);
  std::string attribute(const std::string& name) const;  ///< global text attribute; empty if absent
  void end_definitions();
  void write(int variable, const std::vector<std::size_t>& start, const std::vector<std::size_t>& count,
             const void* data);
  void read(int variable, const std::vector<std::size_t>& start, const std::vector<std::size_t>& count,
            void* data) const;
  std::string read_string(int variable, std::size_t index) const;
  void sync();

  void check(int status, const std::string& what) const;

 private:
  std::string path_;
  int id_ = -1;
};

}  // namespace equipoise::store

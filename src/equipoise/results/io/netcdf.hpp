// A thin, owning wrapper around the NetCDF C library: every call is checked, every failure an exception.
//
// The library is not thread-safe: all calls to it are here, under one lock. Only one thread may use a file at a time.
//
// Files are in the classic format with 64-bit offsets. HDF5, behind NetCDF-4, loses a file on a full disk, ends the
// process when it closes such a file at exit, and may crash on damaged files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "equipoise/results/columns/dataset.hpp"

namespace equipoise::io {

int netcdf_type(DataColumn::Type type);

/// Whether it is a regular file that begins as the classic formats do.
bool is_netcdf(const std::string& path);

/// Why the header of a classic NetCDF file contradicts itself or the file's length, at which the C library (4.9) takes
/// all memory, loops or crashes; empty if the library may read it. Formats 1, 2 and 5 of the format's specification
/// (docs.unidata.ucar.edu/netcdf-c/current/file_format_specifications.html).
std::string netcdf_fault(const std::string& path);

/// One open NetCDF file, closed on destruction.
class NetcdfFile {
 public:
  enum class Mode { create, create_large, read };
  /// create: fills an existing, empty file; create_large: for variables of 2 GiB and more. `name`: the file's name in
  /// messages, if not `path`. Throws RunError naming the file.
  NetcdfFile(const std::string& path, Mode mode, const std::string& name = {});
  ~NetcdfFile();
  NetcdfFile(const NetcdfFile&) = delete;
  NetcdfFile& operator=(const NetcdfFile&) = delete;

  const std::string& name() const { return name_; }
  /// Length 0: an unlimited dimension; a file has at most one.
  int dimension(const std::string& name, std::size_t length);
  /// 0 if it is absent. Throws RunError if the file that is read has fewer bytes.
  std::size_t length(const std::string& dimension) const;
  /// Every variable carries its units and a long_name.
  int variable(const std::string& name, int type, const std::vector<int>& dimensions, const std::string& units,
               const std::string& long_name);
  int variable(const std::string& name) const;
  bool has_variable(const std::string& name) const;
  /// Throws RunError unless the variable exists with exactly this type and shape.
  int variable(const std::string& name, int type, const std::vector<std::size_t>& shape) const;
  /// _FillValue; `value` has the variable's type.
  void fill(int variable, const void* value);
  /// Skips filling: every value will be written.
  void leave_unfilled();
  void attribute(int variable, const std::string& name, const std::string& text);
  void attribute(const std::string& name, const std::string& text);  ///< of the file
  void attribute(int variable, const std::string& name, int type, const std::vector<int>& values);
  /// Global text attribute, as display_text() leaves it; empty if absent.
  std::string attribute(const std::string& name) const;
  /// The same of a text of several lines, as display_lines() leaves it.
  std::string lines(const std::string& name) const;
  void end_definitions();
  void write(int variable, const std::vector<std::size_t>& start, const std::vector<std::size_t>& count,
             const void* data);
  void read(int variable, const std::vector<std::size_t>& start, const std::vector<std::size_t>& count,
            void* data) const;
  /// As display_text() leaves it.
  std::string read_text(const std::string& variable, std::size_t index) const;
  /// Writes everything out to the system.
  void close();

  void check(int status, const std::string& what) const;

 private:
  std::string global_text(const std::string& name) const;

  std::string name_;
  std::uintmax_t bytes_ = 0;  ///< of a file that is read
  bool defining_ = true;
  int id_ = -1;
};

/// The name as one word for the attribute flag_meanings.
std::string flag_word(const std::string& name);

}  // namespace equipoise::io

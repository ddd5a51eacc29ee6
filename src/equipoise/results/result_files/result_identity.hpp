// The identity of results in a file: a run may add to a file only if they share it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "equipoise/results/columns/dataset.hpp"
#include "equipoise/results/commands/basin_slice.hpp"

namespace equipoise {

struct BasinFileHeader;

namespace io {

/// Everything that determines the file's content for start i; one key per line, as in a study.
std::string identity_of(const BasinFileHeader& header);

/// An identity taken apart. The program writes such texts itself: one table or key per line.
struct IdentityLines {
  explicit IdentityLines(const std::string& identity);
  /// By dotted key; those of [file] by their bare key ("version"). Empty if there is none.
  std::string value(const std::string& key) const;
  /// What a sweep varies, such as "speed.final=2.4, 2.6".
  std::vector<std::string> over() const;
  /// How many cells a sweep or a capacity has; empty for other results.
  std::optional<std::size_t> cells() const;

  std::string study;                                       ///< what stands before [file], as TOML
  std::vector<std::pair<std::string, std::string>> lines;  ///< dotted key and value, in order
};

/// How two identities differ, in words: "balancer.drag is [0.05] there and [0.06] here"; empty if they agree.
std::string difference(const std::string& there, const std::string& here);

/// Throws InputError about the file `of` if they differ. `results`: what this run makes, "results of this study";
/// `allowed`: what such a file must be.
void require_same(const std::string& there, const std::string& here, const std::string& of, const std::string& results,
                  const std::string& allowed);

/// "speed.final from 1 to 3 in 200 pixels".
std::string axis_text(const SliceAxis& axis);
/// Dimensions y and x of a plane, with their coordinates; their places.
std::vector<std::size_t> add_axes(Dataset& data, const SliceAxis& x, const SliceAxis& y);
/// Keys and ranges of a plane's axes as attributes.
void say_axes(Dataset& data, const SliceAxis& x, const SliceAxis& y);

/// The path of results requested at `path`, with links followed. Throws InputError unless it can be written, and is a
/// regular file or does not exist yet.
std::string results_path(const std::string& path);
/// The same for results that are written whole and replace an old file. Also throws next to unfinished results.
std::string path_for_whole_results(const std::string& path);

}  // namespace io
}  // namespace equipoise

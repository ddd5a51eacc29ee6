// Whose results a file holds: what it must share with a run for the run to add to it.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace equipoise {

struct BasinFileHeader;

namespace io {

/// All that decides what stands in a file for start i, a key a line as in a study.
std::string identity_of(const BasinFileHeader& header);

/// An identity taken apart. The texts are the program's own: a table or a key a line.
struct IdentityLines {
  explicit IdentityLines(const std::string& identity);
  /// By dotted key, those of [file] by their bare one ("version"); empty if there is none.
  std::string value(const std::string& key) const;
  /// What a sweep varies: "speed.final=2.4, 2.6" and the like.
  std::vector<std::string> over() const;

  std::string study;                                       ///< what stands before [file], as TOML
  std::vector<std::pair<std::string, std::string>> lines;  ///< dotted key and value, in order
};

/// How two identities differ, in words: "balancer.drag is [0.05] there and [0.06] here"; empty if they do not.
std::string difference(const std::string& there, const std::string& here);

/// Throws InputError about the file `of` if they do. `results`: what this run makes, "results of this study";
/// `allowed`: what such a file must be.
void require_same(const std::string& there, const std::string& here, const std::string& of, const std::string& results,
                  const std::string& allowed);

/// Where results are kept that are asked for at `path`, links followed. Throws InputError unless that can be written
/// and is a regular file, or none yet.
std::string results_path(const std::string& path, const std::string& allowed);
/// The same for results that are written whole, over what is there. Throws InputError too if unfinished ones stand
/// beside.
std::string path_for_whole_results(const std::string& path);

}  // namespace io
}  // namespace equipoise

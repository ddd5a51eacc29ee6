// A stand-alone driver for LLVMFuzzerTestOneInput, for compilers without libFuzzer: seeded mutations of seed files.
//
// Input number i depends only on the seed, on i, on the seed files and on the keys of a study, so any input can be
// repeated alone.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "equipoise/study/contents/keys.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
// Present if a sanitizer is linked in.
extern "C" void __sanitizer_set_death_callback(void (*callback)()) __attribute__((weak));

namespace {

constexpr const char* usage =
    "usage: study_fuzz [--inputs N] [--seed S] [--dictionary FILE] [--only I] FILE-OR-FOLDER...\n"
    "Feeds N mutations (default 20000) of the *.toml files given, or of those in the folders given, to the target.\n"
    "--only I prints input I and feeds that one only. Exits with 0 if the target took every input.\n";

// Far above every shipped study, yet small enough to keep each input quick.
constexpr std::size_t longest_input = 16384;

struct Options {
  std::uint64_t inputs = 20000, seed = 1;
  std::int64_t only = -1;
  std::string dictionary;
  std::vector<std::string> sources;
};

std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read " + path.string());
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> read_seeds(const std::vector<std::string>& sources) {
  std::vector<std::filesystem::path> paths;
  for (const std::string& source : sources) {
    if (!std::filesystem::is_directory(source)) {
      paths.push_back(source);
      continue;
    }
    for (const auto& entry : std::filesystem::recursive_directory_iterator(source))
      if (entry.path().extension() == ".toml") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());  // the order of a folder differs between machines
  std::vector<std::string> seeds;
  for (const auto& path : paths) seeds.push_back(read_file(path));
  if (seeds.empty()) throw std::runtime_error("no seed files");
  return seeds;
}

// One quoted token per line, with the escapes \\ \" \xHH; comments and blank lines are skipped.
std::vector<std::string> read_dictionary(const std::string& path) {
  std::vector<std::string> tokens;
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::string token;
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
      if (line[i] != '\\') {
        token += line[i];
      } else if (line[++i] == 'x') {
        token += static_cast<char>(std::stoi(line.substr(i + 1, 2), nullptr, 16));
        i += 2;
      } else {
        token += line[i];
      }
    }
    tokens.push_back(token);
  }
  return tokens;
}

class Mutator {
 public:
  Mutator(std::vector<std::string> seeds, std::vector<std::string> tokens)
      : seeds_(std::move(seeds)), tokens_(std::move(tokens)) {
    for (const equipoise::study::KeyTable& table : equipoise::study::key_tables()) {
      keys_.push_back(table.name);
      for (const equipoise::study::Key& key : table.keys) {
        tokens_.push_back(key.name);
        keys_.push_back(table.name + "." + key.name);
      }
    }
  }

  std::string input(std::uint64_t seed, std::uint64_t index) {
    std::seed_seq words{seed, seed >> 32, index, index >> 32};
    random_.seed(words);
    std::string text = pick(seeds_);
    for (std::size_t left = 1 + below(1 + below(6)); left > 0; --left)
      mutate(text);  // few, so that many inputs remain
                     // studies
    if (text.size() > longest_input) text.resize(longest_input);
    return text;
  }

 private:
  // Not std::uniform_int_distribution, whose numbers differ between standard libraries. The bias does not matter.
  std::size_t below(std::size_t count) { return count == 0 ? 0 : random_() % count; }

  const std::string& pick(const std::vector<std::string>& from) { return from[below(from.size())]; }

  void mutate(std::string& text) {
    switch (below(10)) {
      case 0:
        return flip_bit(text);
      case 1:
        return splice(text);
      case 2:
        return insert(text, text.empty() ? "" : piece(text));
      case 3:
        text.erase(below(text.size() + 1), 1 + below(40));
        return;
      case 4:
        return replace_word(text, "0123456789.+-eE_", pick(tokens_));
      case 5:
        return replace_word(text, "0123456789.", number());
      case 6:
        return replace_word(text, "abcdefghijklmnopqrstuvwxyz_\"", pick(tokens_));
      case 7:
        return insert(text, pick(tokens_));
      case 8:
        return add_override(text, pick(tokens_));
      default:
        return add_override(text, number());
    }
  }

  void insert(std::string& text, const std::string& what) { text.insert(below(text.size() + 1), what); }

  std::string piece(const std::string& text) { return text.substr(below(text.size()), 1 + below(100)); }

  void flip_bit(std::string& text) {
    if (!text.empty()) text[below(text.size())] ^= static_cast<char>(1u << below(8));
  }

  // Joins the head of this text and the tail of another.
  void splice(std::string& text) {
    const std::string& other = pick(seeds_);
    text = text.substr(0, below(text.size() + 1)) + other.substr(below(other.size() + 1));
  }

  // Replaces one run of the given characters, so that the result is often still TOML.
  void replace_word(std::string& text, std::string_view characters, const std::string& by) {
    const std::size_t begin = text.find_first_of(characters, below(text.size() + 1));
    if (begin == std::string::npos) return insert(text, by);
    const std::size_t end = std::min(text.find_first_not_of(characters, begin), text.size());
    text.replace(begin, end - begin, by);
  }

  // Mostly of a size that a study may hold.
  std::string number() {
    std::string text = std::to_string(below(1000));
    if (below(2) == 0) text.insert(below(text.size()) + 1, below(2) == 0 ? ".0" : "e-2");
    return below(8) == 0 ? "-" + text : text;
  }

  void add_override(std::string& text, const std::string& value) {
    text += "\n#--set " + pick(below(6) == 0 ? tokens_ : keys_) + "=" + value + "\n";
  }

  std::vector<std::string> seeds_, tokens_, keys_;
  std::mt19937_64 random_;
};

std::uint64_t current_seed = 0, current_index = 0;

void name_input() {
  std::fprintf(stderr, "study_fuzz: at input %llu; again with --seed %llu --only %llu\n",
               static_cast<unsigned long long>(current_index), static_cast<unsigned long long>(current_seed),
               static_cast<unsigned long long>(current_index));
}

void name_input_and_stop(int) {
  name_input();
  std::_Exit(1);
}

Options read_options(int count, char** words) {
  Options options;
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    if (!word.starts_with("--")) {
      options.sources.push_back(word);
      continue;
    }
    if (++i == count) throw std::runtime_error(word + " needs a value");
    const std::string value = words[i];
    if (word == "--inputs")
      options.inputs = std::stoull(value);
    else if (word == "--seed")
      options.seed = std::stoull(value);
    else if (word == "--only")
      options.only = std::stoll(value);
    else if (word == "--dictionary")
      options.dictionary = value;
    else
      throw std::runtime_error("unknown option " + word);
  }
  return options;
}

// An exception from the target is a finding: it ends the program through std::abort.
void feed(const std::string& text) noexcept {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

void run(const Options& options) {
  auto seeds = read_seeds(options.sources);
  auto tokens = options.dictionary.empty() ? std::vector<std::string>{"0"} : read_dictionary(options.dictionary);
  Mutator mutator(seeds, std::move(tokens));
  current_seed = options.seed;
  if (options.only >= 0) {
    current_index = static_cast<std::uint64_t>(options.only);
    const std::string text = mutator.input(options.seed, current_index);
    std::fwrite(text.data(), 1, text.size(), stdout);
    std::fflush(stdout);
    return feed(text);
  }
  const auto begin = std::chrono::steady_clock::now();
  for (const std::string& seed : seeds) feed(seed);
  for (; current_index < options.inputs; ++current_index) feed(mutator.input(options.seed, current_index));
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  std::printf("%llu inputs from %zu seed files in %.1f s\n", static_cast<unsigned long long>(options.inputs),
              seeds.size(), spent.count());
}

}  // namespace

int main(int count, char** words) {
  if (__sanitizer_set_death_callback) __sanitizer_set_death_callback(name_input);
  std::signal(SIGABRT, name_input_and_stop);
  try {
    const Options options = read_options(count, words);
    if (options.sources.empty()) throw std::runtime_error("no seed files given");
    run(options);
    return 0;
  } catch (const std::logic_error& e) {  // from std::stoull
    std::fprintf(stderr, "study_fuzz: not a number: %s\n%s", e.what(), usage);
  } catch (const std::runtime_error& e) {
    std::fprintf(stderr, "study_fuzz: %s\n%s", e.what(), usage);
  }
  return 2;
}

#include "fuzz/mutator.h"

#include <algorithm>
#include <optional>
#include <sstream>
#include <utility>

#include "support/lines.h"
#include "support/read_file.h"

namespace cbc::fuzz {
namespace {

using oracle::Random;

/// At least one.
std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines = test::lines_of(text);
  if (lines.empty()) lines.emplace_back();
  return lines;
}

std::string text_of(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

/// Removes, repeats or moves a line.
void change_lines(std::vector<std::string>& lines, Random& random) {
  const std::size_t line = random.below(lines.size());
  const std::size_t other = random.below(lines.size());
  switch (random.below(3)) {
    case 0:
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(line));
      break;
    case 1: {
      std::string copy = lines[line];
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(other), std::move(copy));
      break;
    }
    default:
      std::swap(lines[line], lines[other]);
  }
}

/// Adds a comment, one that allows a finding most often.
void add_comment(std::vector<std::string>& lines, Random& random) {
  std::string& line = lines[random.below(lines.size())];
  std::string comment = random.percent(90) ? "# cbc: allow " : "# cbc: ";
  comment += random.pick(dictionary());
  if (random.percent(20)) comment += ", " + random.pick(dictionary());
  if (random.percent(30)) {
    line.insert(0, comment + '\n');
  } else {
    line += " " + comment;
  }
}

/// Changes the text as a tree, a few times. Empty if it is none.
std::optional<std::string> mutate_tree(std::string_view text, Language language, Random& random,
                                       MutateBytes mutate_bytes) {
  std::optional<Tree> tree = read_tree(text);
  if (!tree) return std::nullopt;
  do {
    change_tree(*tree, random, dictionary(), mutate_bytes);
  } while (random.percent(50));
  return write_tree(*tree, language);
}

std::string mutate_yaml(const std::string& part, std::size_t most, Random& random,
                        MutateBytes mutate_bytes) {
  if (random.percent(65)) {
    if (auto text = mutate_tree(part, Language::yaml, random, mutate_bytes)) return *text;
  }
  if (random.percent(60)) {
    std::vector<std::string> lines = lines_of(part);
    if (random.percent(50)) {
      change_lines(lines, random);
    } else {
      add_comment(lines, random);
    }
    return text_of(lines);
  }
  return mutate_bytes(part, most);
}

std::string mutate_json_lines(const std::string& part, std::size_t most, Random& random,
                              MutateBytes mutate_bytes) {
  std::vector<std::string> lines = lines_of(part);
  if (random.percent(65)) {
    std::string& line = lines[random.below(lines.size())];
    if (auto text = mutate_tree(line, Language::json, random, mutate_bytes)) {
      text->pop_back();
      line = std::move(*text);
      return text_of(lines);
    }
  }
  if (random.percent(70)) {
    change_lines(lines, random);
    return text_of(lines);
  }
  return mutate_bytes(part, most);
}

std::string mutate_part(const std::string& part, Language language, std::size_t most,
                        Random& random, MutateBytes mutate_bytes) {
  switch (language) {
    case Language::yaml:
      return mutate_yaml(part, most, random, mutate_bytes);
    case Language::json_lines:
      return mutate_json_lines(part, most, random, mutate_bytes);
    case Language::json:
      if (random.percent(85)) {
        if (auto text = mutate_tree(part, Language::json, random, mutate_bytes)) return *text;
      }
      break;
    case Language::bytes:
      break;
  }
  return mutate_bytes(part, most);
}

}  // namespace

const std::vector<std::string>& dictionary() {
  static const std::vector<std::string> words = [] {
    std::vector<std::string> found;
    std::istringstream file(test::read_file(CBC_SOURCE_DIR "/tests/fuzz/dictionary.txt"));
    for (std::string line; std::getline(file, line);) {
      if (line.size() > 2 && line.front() == '"') found.push_back(line.substr(1, line.size() - 2));
    }
    return found;
  }();
  return words;
}

std::string mutate(const Target& target, std::string_view input, std::size_t most,
                   std::uint64_t seed, MutateBytes mutate_bytes) {
  if (target.language == Language::bytes) return mutate_bytes(std::string(input), most);
  Random random(seed);
  std::vector<std::string> parts = split_parts(input);
  const std::size_t fixed = std::min(target.fixed_parts, parts.size() - 1);
  std::string& part = parts[fixed + random.below(parts.size() - fixed)];
  std::size_t others = 0;
  for (const std::string& one : parts) others += one.size() + 5;  // with a separator
  others -= part.size();
  part =
      mutate_part(part, target.language, others < most ? most - others : 1, random, mutate_bytes);
  std::string mutated = join_parts(parts);
  if (mutated.size() > most) mutated.resize(most);
  return mutated;
}

}  // namespace cbc::fuzz

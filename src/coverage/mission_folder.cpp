#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>
#include <system_error>
#include <unistd.h>

#include <fmt/core.h>

#include "core/command_line/command_line.h"
#include "core/files/output.h"
#include "core/files/read.h"
#include "coverage/coverage.h"
#include "runtime/base/text.h"
#include "runtime/compiled/compiled_file.h"

namespace cbc::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view mark =
    "# Written by 'cbc coverage --write-missing', which replaces this file unless it was changed: ";

std::string sign(const std::string& text) {
  return fmt::format("{}{}\n{}", mark, to_hex(digest_of(text)), text);
}

/// Whether this program wrote the file, and nobody has changed it.
bool is_signed(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(file), {}};
  const std::size_t end = content.find('\n');
  return end != std::string::npos && content == sign(content.substr(end + 1));
}

}  // namespace

std::string MissionFolder::path_of(const std::string& name) const {
  return (fs::path(path_) / name).string();
}

bool MissionFolder::open() {
  std::error_code error;
  fs::path lowest = fs::absolute(path_, error).lexically_normal();
  if (!lowest.has_filename()) lowest = lowest.parent_path();  // "tests/"
  const fs::path folder = lowest;
  while (!error && !fs::exists(lowest, error) && !error) lowest = lowest.parent_path();
  if (!error && !fs::is_directory(lowest, error) && !error) {
    error = std::make_error_code(std::errc::not_a_directory);
  }
  if (!error && ::access(lowest.c_str(), W_OK | X_OK) != 0) {
    error = std::error_code(errno, std::generic_category());
  }
  if (error) {
    complain("cannot write to the folder {}: {}", quote(path_), error.message());
    return false;
  }
  if (lowest != folder) return true;
  std::vector<std::string> foreign;
  fs::directory_iterator entry(path_, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::error_code ignored;
    const bool is_file = fs::is_regular_file(entry->symlink_status(ignored));
    const std::string name = entry->path().filename().string();
    const bool is_ours = is_file && name.ends_with(".yaml") && is_signed(entry->path());
    (is_ours ? names_ : foreign).push_back(name);
    if (const auto refusal = find_read_file(path_of(name))) {
      complain(*refusal);
      return false;
    }
  }
  if (error) {
    complain("cannot read the folder {}: {}", quote(path_), error.message());
    return false;
  }
  if (!foreign.empty()) {
    const std::string& first = *std::min_element(foreign.begin(), foreign.end());
    complain(
        "the folder {} has {}, which --write-missing did not write, or which was changed since; "
        "expected a folder for its scripts alone",
        quote(path_), quote(first));
    return false;
  }
  return true;
}

int MissionFolder::replace(const std::vector<File>& files) {
  std::vector<std::string> made;
  if (!files.empty()) {
    if (const std::error_code error = make_folder(path_)) {
      return complain("cannot make the folder {}: {}", quote(path_), error.message());
    }
  }
  for (const File& file : files) {
    const int status = write_output(path_of(file.name), sign(file.text));
    if (status == exit_ok) {
      made.push_back(file.name);
      continue;
    }
    std::error_code ignored;
    for (const std::string& name : made) {
      const bool was_there = std::find(names_.begin(), names_.end(), name) != names_.end();
      if (!was_there) fs::remove(path_of(name), ignored);
    }
    return status;
  }
  for (const std::string& name : names_) {
    if (std::find(made.begin(), made.end(), name) != made.end()) continue;
    std::error_code error;
    fs::remove(path_of(name), error);
    if (error) return complain("cannot remove {}: {}", quote(path_of(name)), error.message());
  }
  return exit_ok;
}

}  // namespace cbc::cli

#include "core/files/read.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <fmt/core.h>

#include "core/files/output.h"
#include "runtime/base/text.h"
#include "runtime/compiled/compiled_file.h"

namespace cbc::cli {

namespace {

namespace fs = std::filesystem;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

std::nullopt_t cannot_read(const std::string& path, const std::string& reason) {
  complain("cannot read {}: {}", quote(display_name(path)), reason);
  return std::nullopt;
}

namespace {

/// Larger texts are refused, so that no input can exhaust the memory of the machine. Compiled
/// catalogs have a limit of their own.
constexpr std::size_t largest_file = std::size_t{256} << 20;

std::optional<std::string> read_stream(std::FILE* stream, const std::string& path) {
  std::string text;
  std::array<char, 1 << 16> block{};
  errno = 0;
  for (;;) {
    const std::size_t count = std::fread(block.data(), 1, block.size(), stream);
    text.append(block.data(), count);
    const std::size_t largest = is_compiled(text) ? largest_compiled_file : largest_file;
    if (text.size() > largest) {
      return cannot_read(path, fmt::format("it is larger than {} MiB", largest >> 20));
    }
    if (count == 0) break;
  }
  if (std::ferror(stream) != 0) return cannot_read(path, std::strerror(errno));
  return text;
}

}  // namespace

std::optional<std::string> read_input(const std::string& path) {
  note_read(path);
  if (path == "-") return read_stream(stdin, path);
  if (const auto refusal = find_refusal(path)) return cannot_read(path, *refusal);
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rbe"));
  if (file == nullptr) return cannot_read(path, std::strerror(errno));
  return read_stream(file.get(), path);
}

std::string display_name(const std::string& path) { return path == "-" ? "<stdin>" : path; }

std::vector<std::string> list_folder(const std::string& path,
                                     std::initializer_list<std::string_view> suffixes,
                                     bool& has_failed) {
  std::vector<std::string> files;
  std::vector<fs::path> folders{path};
  while (!folders.empty()) {
    const fs::path folder = std::move(folders.back());
    folders.pop_back();
    std::error_code error;
    std::error_code ignored;
    if (const auto refusal = find_refusal(folder.string())) {
      cannot_read(folder.string(), *refusal);
      has_failed = true;
      continue;
    }
    fs::directory_iterator entry(folder, error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
      if (entry->path().filename().string().starts_with('.')) continue;
      if (entry->is_directory(ignored) && !entry->is_symlink(ignored)) {
        folders.push_back(entry->path());
      } else if (std::find(suffixes.begin(), suffixes.end(), entry->path().extension()) !=
                     suffixes.end() &&
                 (entry->is_regular_file(ignored) || find_refusal(entry->path().string()))) {
        files.push_back(entry->path().string());
      }
    }
    if (error) {
      cannot_read(folder.string(), error.message());
      has_failed = true;
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

bool is_folder(const std::string& path) {
  std::error_code ignored;
  return path != "-" && fs::is_directory(path, ignored);
}

bool is_special(const std::string& path) {
  std::error_code ignored;
  return !find_refusal(path) && fs::is_other(path, ignored);
}

bool can_be_mapped(const std::string& path) {
  std::error_code ignored;
  if (path == "-" || find_refusal(path)) return false;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  std::array<char, 8> begin{};
  std::ifstream file(path, std::ios::binary);
  file.read(begin.data(), begin.size());
  return is_compiled({begin.data(), static_cast<std::size_t>(file.gcount())});
}

namespace {

namespace fs = std::filesystem;

/// What tells whether two names are those of one file.
using Identity = std::pair<dev_t, ino_t>;

std::optional<Identity> identity_of(const std::string& path) {
  struct stat status {};
  const int result = path == "-" ? ::fstat(STDIN_FILENO, &status) : ::stat(path.c_str(), &status);
  if (result != 0) return std::nullopt;
  return Identity{status.st_dev, status.st_ino};
}

struct ReadFiles {
  std::mutex mutex;
  std::map<Identity, std::string> names;  ///< as they were first read
  fs::path confinement;                   ///< empty: any file may be read
};

/// Of the process, as files are.
ReadFiles& read_files() {
  static ReadFiles files;
  return files;
}

/// Where a path leads if its first link to something that does not exist is followed; empty if it
/// has no such link. `path` is what weakly_canonical makes of it.
fs::path follow_dangling_link(const fs::path& path) {
  fs::path link;
  for (auto part = path.begin(); part != path.end(); ++part) {
    link /= *part;
    std::error_code error;
    if (!fs::is_symlink(fs::symlink_status(link, error))) continue;
    fs::path target = link.parent_path() / fs::read_symlink(link, error);
    if (error) return {};
    while (++part != path.end()) target /= *part;
    return target;
  }
  return {};
}

/// Whether the file behind a path is in a folder, which is canonical, or below. What a link leads
/// to need not exist.
bool is_inside(const fs::path& folder, const std::string& path) {
  constexpr int most_links = 40;
  std::error_code error;
  fs::path next = fs::absolute(path, error);
  for (int links = 0; !error && links < most_links; ++links) {
    const fs::path real = fs::weakly_canonical(next, error);
    if (error) break;
    next = follow_dangling_link(real);
    if (!next.empty()) continue;
    return std::mismatch(folder.begin(), folder.end(), real.begin(), real.end()).first ==
           folder.end();
  }
  return false;
}

}  // namespace

void note_read(const std::string& path) {
  const std::optional<Identity> identity = identity_of(path);
  if (!identity) return;
  ReadFiles& files = read_files();
  const std::lock_guard lock(files.mutex);
  files.names.try_emplace(*identity, path);
}

bool leads_out_of(const std::string& folder, const std::string& path) {
  std::error_code error;
  const fs::path top = fs::canonical(folder, error);
  return error || !is_inside(top, path);
}

void confine_reading(const std::string& folder) {
  read_files().confinement = fs::canonical(folder);
}

std::string confinement() { return read_files().confinement.string(); }

std::optional<std::string> find_refusal(const std::string& path) {
  if (path.find('\0') != std::string::npos) return "its name has a NUL character";
  const fs::path& folder = read_files().confinement;
  if (folder.empty() || path == "-") return std::nullopt;
  // Also of what does not exist, so that nobody learns of that.
  if (is_inside(folder, path)) return std::nullopt;
  return fmt::format("it is outside of {} (--confine)", quote(folder.string()));
}

std::optional<std::string> find_read_file(const std::string& output) {
  if (output == "-") return std::nullopt;
  const std::optional<Identity> identity = identity_of(output);
  if (!identity) return std::nullopt;
  ReadFiles& files = read_files();
  const std::lock_guard lock(files.mutex);
  const auto found = files.names.find(*identity);
  if (found == files.names.end()) return std::nullopt;
  const std::string message = fmt::format("the output {} is also an input", quote(output));
  if (found->second == output || found->second == "-") return message;
  return fmt::format("{}: it is the same file as {}, which was read", message,
                     quote(found->second));
}

}  // namespace cbc::cli

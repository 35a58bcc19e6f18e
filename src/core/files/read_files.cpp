#include "core/files/read_files.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <fmt/core.h>

#include "runtime/base/text.h"

namespace cbc::cli {
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

#include "cli/input.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>

#include <fmt/format.h>

#include "cli/exit_status.h"
#include "compiled/compiled_file.h"
#include "text/quote.h"

namespace cbc::cli {
namespace {

namespace fs = std::filesystem;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

std::optional<std::string> fail(const std::string& path, const std::string& reason) {
  complain(fmt::format("cannot read {}: {}", quote(display_name(path)), reason));
  return std::nullopt;
}

std::optional<std::string> read_stream(std::FILE* stream, const std::string& path) {
  std::string text;
  std::array<char, 1 << 16> block{};
  errno = 0;
  for (;;) {
    const std::size_t count = std::fread(block.data(), 1, block.size(), stream);
    text.append(block.data(), count);
    const std::size_t largest = is_compiled(text) ? largest_compiled_file : largest_file;
    if (text.size() > largest) {
      return fail(path, fmt::format("it is larger than {} MiB", largest >> 20));
    }
    if (count == 0) break;
  }
  if (std::ferror(stream) != 0) return fail(path, std::strerror(errno));
  return text;
}

}  // namespace

std::optional<std::string> read_input(const std::string& path) {
  if (path == "-") return read_stream(stdin, path);
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rbe"));
  if (file == nullptr) return fail(path, std::strerror(errno));
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
    fs::directory_iterator entry(folder, error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
      if (entry->path().filename().string().starts_with('.')) continue;
      if (entry->is_directory(ignored) && !entry->is_symlink(ignored)) {
        folders.push_back(entry->path());
      } else if (std::find(suffixes.begin(), suffixes.end(), entry->path().extension()) !=
                     suffixes.end() &&
                 entry->is_regular_file(ignored)) {
        files.push_back(entry->path().string());
      }
    }
    if (error) {
      (void)fail(folder.string(), error.message());
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

void complain(const std::string& message) {
  const std::string line = "cbc: " + message + "\n";
  // Where it cannot be written, the exit status still tells; no stream ends for it.
  static_cast<void>(std::fwrite(line.data(), 1, line.size(), stderr));
}

int usage_error(std::string_view command, const std::string& message) {
  complain(fmt::format("{}\nSee 'cbc {} --help'.", message, command));
  return exit_unusable;
}

}  // namespace cbc::cli

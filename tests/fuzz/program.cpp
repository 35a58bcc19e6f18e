#include "fuzz/program.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <map>
#include <memory>
#include <sys/mman.h>
#include <unistd.h>
#include <utility>

#include <fmt/core.h>

#include "core/files/output.h"
#include "fuzz/catalogs.h"
#include "fuzz/target.h"
#include "runtime/compiled/compiled_file.h"

namespace cbc::fuzz {
namespace {

constexpr std::uint64_t most_nodes_of_program = 2000;
constexpr std::uint64_t most_clock_events = 300;

void check(bool is_done, std::string_view what) {
  if (!is_done) fail(fmt::format("cannot {} for the target: {}", what, std::strerror(errno)));
}

/// A file that exists only in memory.
class MemoryDescriptor {
 public:
  MemoryDescriptor() : number_(::memfd_create("cbc", MFD_CLOEXEC)) {
    check(number_ >= 0, "make a file");
  }
  ~MemoryDescriptor() { ::close(number_); }
  MemoryDescriptor(const MemoryDescriptor&) = delete;
  MemoryDescriptor& operator=(const MemoryDescriptor&) = delete;

  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] std::string path() const { return fmt::format("/proc/self/fd/{}", number_); }

  /// Sets the content, and the place in it to its beginning.
  void set(std::string_view content) const {
    check(::ftruncate(number_, 0) == 0 && ::lseek(number_, 0, SEEK_SET) == 0, "empty a file");
    while (!content.empty()) {
      const auto written = ::write(number_, content.data(), content.size());
      check(written > 0, "write a file");
      content.remove_prefix(static_cast<std::size_t>(written));
    }
    check(::lseek(number_, 0, SEEK_SET) == 0, "rewind a file");
  }

  [[nodiscard]] std::string content() const {
    std::string text(static_cast<std::size_t>(::lseek(number_, 0, SEEK_END)), '\0');
    const auto got = ::pread(number_, text.data(), text.size(), 0);
    check(got == static_cast<ssize_t>(text.size()), "read a file");
    return text;
  }

 private:
  int number_;
};

/// Puts another file in the place of a standard stream.
class Redirection {
 public:
  Redirection(int stream, int file) : stream_(stream), before_(::dup(stream)) {
    check(before_ >= 0 && ::dup2(file, stream) == stream, "redirect");
  }
  ~Redirection() {
    ::dup2(before_, stream_);
    ::close(before_);
  }
  Redirection(const Redirection&) = delete;
  Redirection& operator=(const Redirection&) = delete;

 private:
  int stream_;
  int before_;
};

/// Streams catch these signals, and ignore them once they have ended.
class KeptSignals {
 public:
  KeptSignals() {
    for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], nullptr, &actions_[i]);
  }
  ~KeptSignals() {
    for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], &actions_[i], nullptr);
  }
  KeptSignals(const KeptSignals&) = delete;
  KeptSignals& operator=(const KeptSignals&) = delete;

 private:
  static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP, SIGPIPE};
  std::array<struct sigaction, signals.size()> actions_{};
};

}  // namespace

std::string memory_file(std::size_t number, std::string_view content) {
  static std::map<std::size_t, MemoryDescriptor> files;
  const MemoryDescriptor& file = files[number];
  file.set(content);
  return file.path();
}

std::string compiled_file_of(const std::string& catalog_yaml) {
  constexpr std::size_t most_files = 256;
  static std::map<std::string, std::unique_ptr<const MemoryDescriptor>> files;
  if (files.size() > most_files) files.clear();
  const auto [entry, is_new] = files.try_emplace(catalog_yaml);
  if (is_new) {
    if (const auto catalog = catalog_of(catalog_yaml)) {
      auto file = std::make_unique<const MemoryDescriptor>();
      file->set(write_compiled(*catalog, digest_of(catalog_yaml)));
      entry->second = std::move(file);
    }
  }
  return entry->second == nullptr ? std::string() : entry->second->path();
}

ProgramRun run_program(std::string_view standard_input, const std::function<int()>& command) {
  static const MemoryDescriptor input;
  static const MemoryDescriptor output;
  input.set(standard_input);
  output.set("");
  ProgramRun run;
  {
    const KeptSignals signals;
    std::fflush(stdout);
    const Redirection from(STDIN_FILENO, input.number());
    const Redirection to(STDOUT_FILENO, output.number());
    run.status = command();
    std::fflush(stdout);
  }
  run.output = output.content();
  require(run.status != cli::exit_internal, "exit status 3");
  return run;
}

cli::SolveOptions bounded_options() {
  cli::SolveOptions options;
  options.search.max_nodes = most_nodes_of_program;
  options.search.max_clock_events = most_clock_events;
  return options;
}

CoordinatorOptions bounded_coordinator() {
  CoordinatorOptions options;
  options.search.max_nodes = most_nodes_of_program;
  options.max_clock_events = most_clock_events;
  return options;
}

}  // namespace cbc::fuzz

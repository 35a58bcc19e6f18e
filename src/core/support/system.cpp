#include "core/support/system.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <iterator>
#include <random>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

#include <fmt/core.h>

#include "runtime/base/mapped_file.h"

namespace cbc {
namespace {

namespace fs = std::filesystem;

/// What a system call says about its failure, to be asked right after it.
std::string reason(int code = errno) { return std::generic_category().message(code); }

/// Holds back the signals that would end the program and leave a temporary file behind.
class SignalsHeld {
 public:
  SignalsHeld() {
    sigset_t held;
    sigemptyset(&held);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGXFSZ}) {
      sigaddset(&held, signal);
    }
    pthread_sigmask(SIG_BLOCK, &held, &before_);
  }
  ~SignalsHeld() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  SignalsHeld(const SignalsHeld&) = delete;
  SignalsHeld& operator=(const SignalsHeld&) = delete;

 private:
  sigset_t before_{};
};

/// A random number, as the numbers of processes repeat in containers. mkostemp would ignore the
/// umask.
std::string draw_temporary_name() {
  std::uint64_t number = 0;
  if (getentropy(&number, sizeof number) != 0) number = std::random_device()();
  return fmt::format(".cbc-{:016x}.tmp", number);
}

[[nodiscard]] bool write_all(int descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) content.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// A new file in a folder, removed again unless it was given its name.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& folder) {
    constexpr int attempts = 10;  // the first one can fail only if somebody knows the number
    for (int attempt = 0; attempt < attempts; ++attempt) {
      path_ = (folder / draw_temporary_name()).string();
      descriptor_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor_ >= 0 || errno != EEXIST) return;
    }
  }
  ~TemporaryFile() {
    if (descriptor_ < 0) return;
    ::close(descriptor_);
    if (!is_named_) unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] bool exists() const { return descriptor_ >= 0; }

  /// Gives it the permissions and, if possible, the owner of another file.
  [[nodiscard]] bool resemble(const struct stat& other) const {
    // Only the system's administrator can give files away.
    const bool ignored = fchown(descriptor_, other.st_uid, other.st_gid) != 0;
    (void)ignored;
    return fchmod(descriptor_, other.st_mode & 07777) == 0;
  }

  [[nodiscard]] bool write(std::string_view content) const {
    return write_all(descriptor_, content) && fsync(descriptor_) == 0;
  }

  [[nodiscard]] bool rename_to(const fs::path& path) {
    is_named_ = std::rename(path_.c_str(), path.c_str()) == 0;
    return is_named_;
  }

  /// Fails if there is a file of that name. Not every system knows how to rename so, nor every one
  /// how to link.
  [[nodiscard]] bool become_new(const fs::path& path) {
#ifdef RENAME_NOREPLACE
    is_named_ = renameat2(AT_FDCWD, path_.c_str(), AT_FDCWD, path.c_str(), RENAME_NOREPLACE) == 0;
    if (is_named_ || (errno != EINVAL && errno != ENOSYS)) return is_named_;
#endif
    return link(path_.c_str(), path.c_str()) == 0;  // the destructor removes the other name
  }

 private:
  std::string path_;
  int descriptor_ = -1;
  bool is_named_ = false;
};

/// Whether a path, such as /dev/stdout, is another name of what a program has open: to replace the
/// file behind it would not reach those who have it open.
bool is_descriptor(const fs::path& path) {
  std::error_code error;
  const fs::path folder = fs::canonical(path.has_parent_path() ? path.parent_path() : ".", error);
  return !error && folder.filename() == "fd" && *std::next(folder.begin()) == "proc";
}

/// Makes of a path that to which symbolic links lead in the end, whether or not there is a file.
/// Returns why it cannot be replaced, or nothing.
std::optional<std::string> follow_links(fs::path& path) {
  constexpr int most_links = 40;
  for (int links = 0; links <= most_links; ++links) {
    if (is_descriptor(path)) return "it is not the name of a file; '-' is standard output";
    std::error_code no_link;
    const fs::path target = fs::read_symlink(path, no_link);
    if (no_link) return std::nullopt;
    path = path.parent_path() / target;
  }
  return reason(ELOOP);
}

}  // namespace

std::string target_of(const std::string& path) {
  fs::path target(path);
  if (follow_links(target)) return path;
  std::error_code error;
  const fs::path whole = fs::weakly_canonical(fs::absolute(target, error), error);
  return error ? path : whole.string();
}

namespace {

/// Makes the new name last. The content is complete either way, so failures do not matter.
void sync_folder(const fs::path& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  fsync(descriptor);
  ::close(descriptor);
}

fs::path folder_with(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// Where a content is to be put.
struct Target {
  fs::path path;
  fs::path folder;
  bool exists = false;
  struct stat existing {};
};

/// Returns why nothing can be put there, or nothing.
std::optional<std::string> find_target(const std::string& path, Target& target) {
  target.path = path;
  if (auto obstacle = follow_links(target.path)) return obstacle;
  if (!target.path.has_filename()) return reason(EISDIR);
  target.folder = folder_with(target.path);

  target.exists = stat(target.path.c_str(), &target.existing) == 0;
  if (!target.exists) return errno == ENOENT ? std::nullopt : std::optional(reason());
  if (S_ISDIR(target.existing.st_mode)) return reason(EISDIR);
  if (!S_ISREG(target.existing.st_mode)) return "it is not a regular file";
  // The folder would allow to replace a file that may not be changed.
  if (faccessat(AT_FDCWD, target.path.c_str(), W_OK, AT_EACCESS) != 0) return reason();
  return std::nullopt;
}

}  // namespace

std::optional<std::string> write_atomically(const std::string& path, std::string_view content) {
  Target target;
  if (auto obstacle = find_target(path, target)) return obstacle;
  const SignalsHeld signals_held;
  TemporaryFile file(target.folder);
  if (!file.exists()) return reason();
  if (target.exists && !file.resemble(target.existing)) return reason();
  if (!file.write(content)) return reason();
  if (!file.rename_to(target.path)) return reason();
  sync_folder(target.folder);
  return std::nullopt;
}

std::optional<std::string> create_atomically(const std::string& path, std::string_view content) {
  const fs::path folder = folder_with(path);
  const SignalsHeld signals_held;
  TemporaryFile file(folder);
  if (!file.exists()) return reason();
  if (!file.write(content)) return reason();
  if (!file.become_new(path)) return reason();
  sync_folder(folder);
  return std::nullopt;
}

std::optional<std::string> find_obstacle(const std::string& path) {
  Target target;
  if (auto obstacle = find_target(path, target)) return obstacle;
  const SignalsHeld signals_held;
  const TemporaryFile file(target.folder);
  if (!file.exists()) return reason();
  return std::nullopt;
}

namespace {

constexpr int second_input_number = 3;
constexpr std::size_t stream_count = 4;

/// Starts a program with these files for its standard streams, and the second input. Returns a
/// value of errno.
int start(const std::vector<std::string>& command,
          const std::array<Descriptor, stream_count>& streams, pid_t& process) {
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  for (int stream = STDIN_FILENO; stream <= second_input_number; ++stream) {
    posix_spawn_file_actions_adddup2(&actions,
                                     streams.at(static_cast<std::size_t>(stream)).number(), stream);
  }
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t defaults;
  sigemptyset(&defaults);
  sigaddset(&defaults, SIGPIPE);
  sigaddset(&defaults, SIGXFSZ);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  const int error =
      posix_spawnp(&process, arguments.front(), &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

std::string end_of(int status) {
  if (WIFEXITED(status)) return fmt::format("exit status {}", WEXITSTATUS(status));
  return fmt::format("ended by signal {}", WTERMSIG(status));
}

/// Reads what was written to a file that is open. False: it cannot be read, and errno says why.
[[nodiscard]] bool read_all(const Descriptor& file, std::string& content) {
  const off_t end = lseek(file.number(), 0, SEEK_END);
  if (end < 0 || lseek(file.number(), 0, SEEK_SET) < 0) return false;
  content.resize(static_cast<std::size_t>(end));
  for (std::size_t size = 0; size < content.size();) {
    const ssize_t count = read(file.number(), content.data() + size, content.size() - size);
    if (count < 0) return false;
    if (count == 0) content.resize(size);
    size += static_cast<std::size_t>(count);
  }
  return true;
}

}  // namespace

Filtered run_filter(const std::vector<std::string>& command, std::string_view input,
                    const std::function<bool()>& is_stopped, std::string_view second_input) {
  // Files in memory, of which neither side waits for the other.
  const auto fail = [] { return Filtered{true, false, {}, reason(), -1}; };
  std::array<Descriptor, stream_count> streams;
  for (Descriptor& stream : streams) {
    stream.set(memfd_create("stream", MFD_CLOEXEC));
    if (stream.number() < 0) return fail();
  }
  const int input_file = streams[STDIN_FILENO].number();
  if (!write_all(input_file, input) || lseek(input_file, 0, SEEK_SET) < 0) return fail();
  if (!write_all(streams[second_input_number].number(), second_input)) return fail();
  pid_t process = 0;
  if (const int error = start(command, streams, process); error != 0) {
    return {false, false, {}, reason(error), -1};
  }
  int status = 0;
  bool is_killed = false;
  for (;;) {
    const bool may_stop = is_stopped != nullptr && !is_killed;
    const pid_t ended = waitpid(process, &status, may_stop ? WNOHANG : 0);
    if (ended > 0) break;
    if (ended < 0 && errno != EINTR) return fail();
    if (!may_stop) continue;
    is_killed = is_stopped();
    if (is_killed) {
      kill(process, SIGKILL);
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
  Filtered result;
  result.is_found = true;
  if (WIFEXITED(status)) result.status = WEXITSTATUS(status);
  result.is_done = result.status == 0;
  if (!read_all(streams[STDOUT_FILENO], result.output) ||
      !read_all(streams[STDERR_FILENO], result.error_output)) {
    return fail();
  }
  // POSIX lets a system start a process before it knows that there is no program; emulators do.
  constexpr int no_program = 127;
  if (result.status == no_program && result.output.empty() && result.error_output.empty()) {
    return {false, false, {}, reason(ENOENT), -1};
  }
  if (!result.is_done && result.error_output.empty()) result.error_output = end_of(status);
  return result;
}

}  // namespace cbc

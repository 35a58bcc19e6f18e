#include "golden/process.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <spawn.h>
#include <string_view>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace cbc::golden {
namespace {

[[noreturn]] void fail(const std::string& what, int error) {
  throw std::system_error(error, std::generic_category(), what);
}

/// Owns a file descriptor.
class File {
 public:
  File() = default;
  explicit File(int descriptor) : descriptor_(descriptor) {}
  File(File&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  File& operator=(File&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() { close(); }

  void close() {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
  }
  [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  int descriptor_ = -1;
};

File open_file(const std::filesystem::path& path, int flags) {
  const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
  if (descriptor < 0) fail(path.string(), errno);
  return File(descriptor);
}

struct Ends {
  File read;
  File write;
};

Ends open_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail("pipe2", errno);
  return {File(ends[0]), File(ends[1])};
}

Ends open_terminal() {
  int master = -1;
  int slave = -1;
  if (::openpty(&master, &slave, nullptr, nullptr, nullptr) != 0) {
    fail("openpty (is /dev/pts mounted?)", errno);
  }
  ::fcntl(master, F_SETFD, FD_CLOEXEC);
  ::fcntl(slave, F_SETFD, FD_CLOEXEC);
  return {File(master), File(slave)};
}

std::vector<std::string> environment_of(const Call& call) {
  std::vector<std::string> environment;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    const std::string name(text.substr(0, text.find('=')));
    if (name != "NO_COLOR" && !call.environment.contains(name)) environment.emplace_back(text);
  }
  for (const auto& [name, value] : call.environment) {
    environment.push_back(std::string(name).append("=").append(value));
  }
  return environment;
}

/// The form in which C functions take lists of texts.
std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

pid_t spawn(const Call& call, const File& in, const File& out, const File& err) {
  std::vector<std::string> arguments{CBC_PROGRAM_PATH};
  arguments.insert(arguments.end(), call.arguments.begin(), call.arguments.end());
  std::vector<std::string> environment = environment_of(call);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in.descriptor(), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out.descriptor(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.descriptor(), STDERR_FILENO);
  posix_spawn_file_actions_addchdir_np(&actions, call.folder.c_str());
  // What runs in the background of a shell ignores interrupts, and below nohup hangups.
  sigset_t ignored;
  sigemptyset(&ignored);
  sigaddset(&ignored, SIGHUP);
  sigaddset(&ignored, SIGINT);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setsigdefault(&attributes, &ignored);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  pid_t process = -1;
  const int error = ::posix_spawn(&process, CBC_PROGRAM_PATH, &actions, &attributes,
                                  pointers_to(arguments).data(), pointers_to(environment).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) fail(CBC_PROGRAM_PATH, error);
  return process;
}

int wait_for(pid_t process) {
  int status = 0;
  while (::waitpid(process, &status, 0) < 0) {
    if (errno != EINTR) fail("waitpid", errno);
  }
  constexpr int signal_base = 128;
  return WIFEXITED(status) ? WEXITSTATUS(status) : signal_base + WTERMSIG(status);
}

/// Reads some bytes; closes the file at its end.
void read_some(File& file, std::string& text) {
  std::array<char, 1 << 14> block{};
  const ssize_t count = ::read(file.descriptor(), block.data(), block.size());
  if (count > 0) {
    text.append(block.data(), static_cast<std::size_t>(count));
  } else if (count == 0 || errno != EINTR) {
    file.close();  // a terminal that nobody has open any more ends with an error
  }
}

/// Reads from both files as the bytes come, so that neither of their writers has to wait.
void read_all(File& out, File& err, Result& result) {
  while (out.is_open() || err.is_open()) {
    std::array<pollfd, 2> waiting{{{out.descriptor(), POLLIN, 0}, {err.descriptor(), POLLIN, 0}}};
    if (::poll(waiting.data(), waiting.size(), -1) < 0) {
      if (errno == EINTR) continue;
      fail("poll", errno);
    }
    if (waiting[0].revents != 0) read_some(out, result.out);
    if (waiting[1].revents != 0) read_some(err, result.err);
  }
}

}  // namespace

Result run(const Call& call) {
  return run(call, [](pid_t) {});
}

Result run(const Call& call, const std::function<void(pid_t)>& meanwhile) {
  Ends out;
  if (call.standard_output.empty()) {
    out = open_pipe();
  } else {
    out.write =
        open_file(call.standard_output, O_WRONLY | O_CREAT | O_TRUNC | call.standard_output_flags);
  }
  Ends err = open_pipe();
  const pid_t process = spawn(call, open_file(call.standard_input, O_RDONLY), out.write, err.write);
  out.write.close();
  err.write.close();
  meanwhile(process);
  Result result;
  read_all(out.read, err.read, result);
  result.status = wait_for(process);
  return result;
}

Result run_on_terminal(const Call& call) { return run_on_terminal_until(call, ""); }

Result run_on_terminal_until(const Call& call, const std::string& text) {
  Ends terminal = open_terminal();
  const pid_t process =
      spawn(call, open_file(call.standard_input, O_RDONLY), terminal.write, terminal.write);
  terminal.write.close();
  Result result;
  while (!text.empty() && terminal.read.is_open()) {
    read_some(terminal.read, result.out);
    if (result.out.find(text) == std::string::npos) continue;
    ::kill(process, SIGINT);
    break;
  }
  File none;
  read_all(terminal.read, none, result);
  result.status = wait_for(process);
  return result;
}

}  // namespace cbc::golden

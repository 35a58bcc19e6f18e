#include "file/filter.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

#include "file/descriptor.h"

namespace cbc {
namespace {

struct Pipe {
  Descriptor read_end;
  Descriptor write_end;

  [[nodiscard]] bool open() {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) return false;
    read_end.set(ends[0]);
    write_end.set(ends[1]);
    return true;
  }
};

/// Holds off the signal that writing to a program that has ended brings.
class PipeSignalIgnored {
 public:
  PipeSignalIgnored() : before_(std::signal(SIGPIPE, SIG_IGN)) {}
  PipeSignalIgnored(const PipeSignalIgnored&) = delete;
  PipeSignalIgnored& operator=(const PipeSignalIgnored&) = delete;
  ~PipeSignalIgnored() { std::signal(SIGPIPE, before_); }

 private:
  void (*before_)(int);
};

class Filter {
 public:
  explicit Filter(std::string_view input) : left_(input) {}

  Filtered run(const std::vector<std::string>& command) {
    const PipeSignalIgnored ignored;
    if (!input_.open() || !output_.open() || !errors_.open()) return fail(errno);
    pid_t process = 0;
    if (const int error = start(command, process); error != 0) return fail(error);
    result_.is_found = true;
    input_.read_end.close();
    output_.write_end.close();
    errors_.write_end.close();
    fcntl(input_.write_end.number(), F_SETFL, O_NONBLOCK);
    exchange();
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    result_.is_done = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    return std::move(result_);
  }

 private:
  Filtered fail(int error) {
    result_.error_output = std::strerror(error);
    return std::move(result_);
  }

  int start(const std::vector<std::string>& command, pid_t& process) {
    std::vector<std::string> words = command;
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input_.read_end.number(), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output_.write_end.number(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, errors_.write_end.number(), STDERR_FILENO);
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

  /// Writes and reads in turn, whichever is possible, until the program has closed its outputs.
  void exchange() {
    while (output_.read_end.number() >= 0 || errors_.read_end.number() >= 0) {
      if (left_.empty()) input_.write_end.close();
      std::array<pollfd, 3> ends{{{input_.write_end.number(), POLLOUT, 0},
                                  {output_.read_end.number(), POLLIN, 0},
                                  {errors_.read_end.number(), POLLIN, 0}}};
      if (poll(ends.data(), ends.size(), -1) < 0) {
        if (errno == EINTR) continue;
        return;
      }
      if (ends[0].revents != 0) write_some();
      if (ends[1].revents != 0) read_some(output_.read_end, result_.output);
      if (ends[2].revents != 0) read_some(errors_.read_end, result_.error_output);
    }
  }

  void write_some() {
    const ssize_t count = write(input_.write_end.number(), left_.data(), left_.size());
    if (count >= 0) {
      left_.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno != EAGAIN && errno != EINTR) {
      left_ = {};  // it has read enough
    }
  }

  static void read_some(Descriptor& end, std::string& text) {
    std::array<char, 1 << 16> block{};
    const ssize_t count = read(end.number(), block.data(), block.size());
    if (count > 0) {
      text.append(block.data(), static_cast<std::size_t>(count));
    } else if (count == 0 || errno != EINTR) {
      end.close();
    }
  }

  std::string_view left_;
  Pipe input_;
  Pipe output_;
  Pipe errors_;
  Filtered result_;
};

}  // namespace

Filtered run_filter(const std::vector<std::string>& command, std::string_view input) {
  return Filter(input).run(command);
}

}  // namespace cbc

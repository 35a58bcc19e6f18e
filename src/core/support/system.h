#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace cbc {

/// Puts a content in the place of a file, or makes a new one: whoever reads the file sees the old
/// content or the new one, never a part, even if the machine stops meanwhile. A symbolic link is
/// followed. Permissions stay as they are, the owner where the system allows it; other hard links
/// keep the old content. Signals that end the program wait until it is done.
///
/// Returns what went wrong, for people ("No space left on device"), or nothing. After an error the
/// file is as before, and nothing else is left behind.
[[nodiscard]] std::optional<std::string> write_atomically(const std::string& path,
                                                          std::string_view content);

/// The same for a file that must not exist: "File exists" if there is one, which stays as it is.
[[nodiscard]] std::optional<std::string> create_atomically(const std::string& path,
                                                           std::string_view content);

/// Why write_atomically could not write there now, or nothing: for what is written only after long
/// work. Nothing changes.
[[nodiscard]] std::optional<std::string> find_obstacle(const std::string& path);

/// The file that write_atomically would write, which need not exist: absolute, without links.
[[nodiscard]] std::string target_of(const std::string& path);

/// What a program made of a text.
struct Filtered {
  bool is_found = false;     ///< nothing says that the program could not be started
  bool is_done = false;      ///< it ended with exit status 0
  std::string output;        ///< its standard output
  std::string error_output;  ///< its standard error, or why it could not be run, or how it ended
  int status = -1;           ///< its exit status, if it had one
};

/// Where a filter reads a second text.
inline constexpr std::string_view second_input_of_filter = "/dev/fd/3";

/// Runs a program, found by PATH, with a text as standard input. No shell is involved. Once
/// `is_stopped` holds, which is asked every 20 ms, the program is ended.
[[nodiscard]] Filtered run_filter(const std::vector<std::string>& command, std::string_view input,
                                  const std::function<bool()>& is_stopped = nullptr,
                                  std::string_view second_input = {});

/// A C stream that writes to memory.
class MemoryFile {
 public:
  MemoryFile() : file_(open_memstream(&data_, &size_)) {
    if (file_ == nullptr) throw std::bad_alloc();
  }
  ~MemoryFile() {
    std::fclose(file_);
    std::free(data_);  // NOLINT(cppcoreguidelines-no-malloc): open_memstream wants it
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] std::FILE* stream() { return file_; }
  /// How much was written so far.
  [[nodiscard]] std::size_t size() { return static_cast<std::size_t>(std::ftell(file_)); }
  /// What was written so far; valid until the next write.
  [[nodiscard]] std::string_view text() {
    if (std::fflush(file_) != 0 || std::ferror(file_) != 0) throw std::bad_alloc();
    return {data_, size_};
  }

 private:
  char* data_ = nullptr;
  std::size_t size_ = 0;
  std::FILE* const file_;
};

/// Calls work(0) in this thread, and work(1) to work(count - 1) in others at the same time; those
/// that the system cannot start are left out, so what is to be done must not depend on their
/// number. Waits for all. If one threw an exception, throws that of the lowest number.
inline void run_in_threads(std::size_t count, const std::function<void(std::size_t)>& work) {
  std::vector<std::exception_ptr> errors(count);
  const auto run = [&](std::size_t number) {
    try {
      work(number);
    } catch (...) {
      errors[number] = std::current_exception();
    }
  };
  std::vector<std::thread> threads;
  threads.reserve(count);
  try {
    while (threads.size() + 1 < count) threads.emplace_back(run, threads.size() + 1);
  } catch (const std::exception&) {
    // There are no more threads, or there is no memory for them: those that exist do the work.
  }
  run(0);
  for (std::thread& thread : threads) thread.join();
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
}

/// Calls work(job, number) for all numbers below `count`, on up to `jobs` threads; `job` tells the
/// threads apart, and 0 is this one. After an exception no further number is begun.
inline void for_each_in_threads(std::size_t count, std::size_t jobs,
                                const std::function<void(std::size_t, std::size_t)>& work) {
  if (count == 0) return;
  std::atomic<std::size_t> next{0};
  run_in_threads(std::clamp<std::size_t>(jobs, 1, count), [&](std::size_t job) {
    try {
      for (std::size_t number = next++; number < count; number = next++) work(job, number);
    } catch (...) {
      next = count;
      throw;
    }
  });
}

}  // namespace cbc

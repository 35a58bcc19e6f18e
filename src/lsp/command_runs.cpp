#include "lsp/command_runs.h"

#include <chrono>
#include <utility>

#include "core/files/read.h"

namespace cbc::lsp {
namespace {

/// Nobody waits longer in an editor; what takes more is for a terminal.
constexpr auto longest_command = std::chrono::seconds(60);

}  // namespace

void CommandRuns::begin(Words words) {
  stop();
  is_stopped_ = false;
  thread_ = std::thread([this, words = std::move(words)] {
    Words line{"/proc/self/exe"};
    line.insert(line.end(), words.begin(), words.end());
    if (const std::string folder = cli::confinement(); !folder.empty()) {
      line.insert(line.end(), {"--confine", folder});
    }
    const auto end = std::chrono::steady_clock::now() + longest_command;
    bool is_late = false;
    Filtered said = run_filter(line, "", [&] {
      is_late = std::chrono::steady_clock::now() >= end;
      return is_late || is_stopped_;
    });
    if (is_stopped_) return;
    if (is_late) said.error_output = "it was ended after 60 s; a terminal can wait longer";
    done_(words, std::move(said));
  });
}

void CommandRuns::stop() {
  is_stopped_ = true;
  if (thread_.joinable()) thread_.join();
}

}  // namespace cbc::lsp

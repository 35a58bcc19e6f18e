#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "core/check/check.h"
#include "core/check/controls.h"
#include "core/files/file_set.h"

namespace cbc::lsp {

/// Finds what takes a search, beside everything else: one catalog at a time, on a thread of its
/// own. A proof that is not wanted any more ends soon.
class Proofs {
 public:
  struct Job {
    std::string path;
    std::shared_ptr<const cli::InputFile> input;
    SeveritySettings settings;
  };
  using Done = std::function<void(const Job& job, CheckedCatalog proved)>;

  /// `done` is called on the other thread.
  explicit Proofs(Done done);
  Proofs(const Proofs&) = delete;
  Proofs& operator=(const Proofs&) = delete;
  ~Proofs();

  /// What is being proved, if anything; it may end at any time.
  [[nodiscard]] std::shared_ptr<const cli::InputFile> present() const;
  /// Begins with this one; the present one ends without an answer.
  void begin(Job job);
  void stop();

 private:
  void run();

  const Done done_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Job> next_;
  std::shared_ptr<const cli::InputFile> present_;
  std::atomic<bool> is_stopped_ = false;  ///< the present one
  bool is_over_ = false;
  std::thread thread_;
};

}  // namespace cbc::lsp

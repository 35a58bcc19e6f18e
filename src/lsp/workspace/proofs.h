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
#include "core/check/severity_settings.h"
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
    std::uint64_t check = 0;  ///< see File
  };
  using Done = std::function<void(const Job& job, CheckedCatalog proved)>;

  /// `done` is called on the other thread.
  explicit Proofs(Done done);
  Proofs(const Proofs&) = delete;
  Proofs& operator=(const Proofs&) = delete;
  ~Proofs();

  /// The check after which something is being proved, or 0; it may end at any time.
  [[nodiscard]] std::uint64_t present() const;
  /// Begins with this one; the present one ends without an answer.
  void begin(Job job);
  void stop();

 private:
  void run();

  const Done done_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Job> next_;
  std::uint64_t present_ = 0;
  std::atomic<bool> is_stopped_ = false;  ///< the present one
  bool is_over_ = false;
  std::thread thread_;
};

}  // namespace cbc::lsp

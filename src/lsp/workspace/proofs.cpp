#include "lsp/workspace/proofs.h"

#include <utility>

#include "core/files/check_file.h"

namespace cbc::lsp {

Proofs::Proofs(Done done) : done_(std::move(done)), thread_([this] { run(); }) {}

Proofs::~Proofs() {
  {
    const std::lock_guard lock(mutex_);
    is_over_ = true;
    is_stopped_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

std::uint64_t Proofs::present() const {
  const std::lock_guard lock(mutex_);
  return next_ ? next_->check : present_;
}

void Proofs::begin(Job job) {
  {
    const std::lock_guard lock(mutex_);
    is_stopped_ = true;
    next_ = std::move(job);
  }
  changed_.notify_one();
}

void Proofs::stop() {
  const std::lock_guard lock(mutex_);
  is_stopped_ = true;
  next_.reset();
}

void Proofs::run() {
  for (;;) {
    Job job;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return is_over_ || next_; });
      if (is_over_) return;
      job = std::move(*next_);
      next_.reset();
      present_ = job.check;
      is_stopped_ = false;
    }
    LintOptions options;
    options.is_stopped = [this] { return is_stopped_.load(); };
    CheckedCatalog proved = cli::check_catalog_file(*job.input, job.settings, options);
    {
      const std::lock_guard lock(mutex_);
      present_ = 0;
      if (is_stopped_) continue;
    }
    done_(job, std::move(proved));
  }
}

}  // namespace cbc::lsp

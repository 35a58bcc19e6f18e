#pragma once

#include <string>
#include <vector>

#include "compiled/compiled_catalog.h"
#include "coordinator/record.h"
#include "script/runner.h"
#include "script/script.h"

namespace cbc {

/// Knows what came before a failed expectation: the event it follows, and why the last scripted
/// start, stop or finish was rejected, if it was.
class FailureStory {
 public:
  /// At the begin of a run. The catalog outlives it.
  void begin_run(const CompiledCatalog& catalog);
  void add(const EventRecord& record, const Step* step);

  /// In lines. To be asked before the next event is handled.
  [[nodiscard]] std::vector<std::string> tell() const;

 private:
  [[nodiscard]] std::string describe(const EventRecord& record, const Step* step) const;

  const CompiledCatalog* catalog_ = nullptr;
  const EventRecord* last_ = nullptr;  ///< null: none yet
  const Step* last_step_ = nullptr;
  std::string rejected_;  ///< the last scripted start, stop or finish, if it was rejected
  std::vector<std::string> reasons_;
};

}  // namespace cbc

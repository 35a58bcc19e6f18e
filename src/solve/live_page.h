#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "core/report/event_json.h"
#include "core/script/runner.h"
#include "page/serve/history.h"
#include "page/serve/server.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/coordinator.h"

namespace cbc::cli {

/// The page of --serve, which shows a stream while it runs.
class LivePage {
 public:
  /// Serves the page at an address that serve::read_address() accepts, and prints where it is.
  /// `name` is that of the stream, `index` the number of the event before it. Null if it cannot be
  /// served, which is reported. The catalog must outlive it.
  [[nodiscard]] static std::unique_ptr<LivePage> open(const CompiledCatalog& catalog,
                                                      std::string_view address, std::string name,
                                                      std::uint64_t index,
                                                      const Coordinator& coordinator);

  explicit LivePage(const CompiledCatalog& catalog) : catalog_(catalog) {}

  void add(const EventStream::Line& line);
  void add(const Failure& failure);
  /// The answer to a line that is no event.
  void add_refusal(const std::string& answer);
  /// After the stream: waits until all browsers have it, but not for long. `error`: why it ended
  /// early, or empty.
  void end(const RunResult& result, const std::string& error);

 private:
  void add(std::string_view type, std::string_view data);

  const CompiledCatalog& catalog_;
  serve::History history_{serve::History::Limits()};
  std::unique_ptr<serve::Server> server_;
};

}  // namespace cbc::cli

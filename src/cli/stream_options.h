#pragma once

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace cbc::cli {

/// The options of `cbc solve` for events in a pipe, and for missions that go on.
struct StreamOptions {
  std::optional<std::string> state_in;
  std::optional<std::string> state_out;
  std::optional<std::string> replay;
};

void add_stream_options(CLI::App& command, StreamOptions& options);

}  // namespace cbc::cli

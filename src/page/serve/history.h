#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace cbc::serve {

/// The last messages of a stream, as server-sent events, for any number of readers: one thread adds
/// them, another reads. They are kept in parts; the first message of each says what the state is
/// there, so that a reader can begin with it. Only the last parts are kept, and a reader that is
/// still before them goes on with the first one that is left: no reader makes the stream wait, or
/// takes memory of its own.
class History {
  struct Part;

 public:
  struct Limits {
    std::size_t messages = 1000;  ///< of a part
    std::size_t bytes = std::size_t{1} << 21;
    std::size_t parts = 6;
  };

  /// What a browser has of the history. It keeps the part that it reads.
  class Reader {
    friend class History;
    std::shared_ptr<const Part> part_;  ///< null: it has nothing yet
    std::size_t place_ = 0;             ///< in the text of the part
  };

  explicit History(const Limits& limits) : limits_(limits) {}

  // For the thread that adds.

  /// Whether the next message begins a part.
  [[nodiscard]] bool wants_state() const;
  /// Begins a part. `state` is JSON on one line, as all data.
  void begin_part(std::string_view state);
  /// Adds a message, whose number is its ID; the first one is 1. An empty type is that of messages
  /// without one. Call begin_part() before.
  void add(std::string_view type, std::string_view data);
  /// Says that nothing follows.
  void end();

  // For the thread that reads.

  /// Whether there is nothing more to read, and never will be.
  [[nodiscard]] bool is_over(const Reader& reader) const;
  /// The next bytes for a reader, at most `most`; empty if there are none yet.
  [[nodiscard]] std::string read(Reader& reader, std::size_t most) const;
  /// A reader that has all messages up to one, whose ID its browser sent. If that is none of those
  /// kept, it begins with the first part.
  [[nodiscard]] Reader reader_after(std::string_view id) const;

 private:
  struct Part {
    std::uint64_t number = 0;
    std::uint64_t first_id = 0;
    std::string text;
    std::vector<std::size_t> ends;  ///< of the messages with IDs, in `text`
  };

  const Limits limits_;
  mutable std::mutex mutex_;
  std::deque<std::shared_ptr<Part>> parts_;
  std::uint64_t next_part_ = 0;
  std::uint64_t next_id_ = 1;
  bool is_at_end_ = false;
};

}  // namespace cbc::serve

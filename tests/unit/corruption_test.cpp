#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "compiled/compiled_file.h"
#include "coordinator/coordinator.h"
#include "support/content_place.h"
#include "unit/compiled_bytes.h"

/// Damaged compiled catalogs: cut off anywhere, or with any byte changed.
namespace cbc {
namespace {

class NoListener final : public EventListener {
 public:
  void on_event(const EventRecord&) override {}
};

/// Lets everything happen to a catalog: each task is started and each behavior fails. The checker
/// looks at every answer.
void exercise(const CompiledCatalog& catalog) {
  NoListener nobody;
  CoordinatorOptions options;
  options.max_clock_events = 50;
  options.search.max_nodes = 1000;
  Coordinator coordinator(catalog, options, nobody);
  coordinator.begin({});
  Microseconds now = 0;
  const auto step = [&](Verb verb, std::uint32_t subject, std::int32_t priority) {
    now += second;
    Event event;
    event.verb = verb;
    event.subject = subject;
    event.cause = FinishCause::wrong_progress;
    if (verb == Verb::start) event.priority = priority;
    Coordinator::Status status = coordinator.advance_to(now);
    if (status == Coordinator::Status::ok) status = coordinator.handle(event);
    EXPECT_NE(status, Coordinator::Status::refused_answer) << coordinator.internal_error();
    return status == Coordinator::Status::ok;
  };
  for (std::uint32_t task = 0; task < catalog.tasks.size(); ++task) {
    if (!step(Verb::start, task, static_cast<std::int32_t>(1 + task % 3))) return;
  }
  for (std::uint32_t behavior = 0; behavior < catalog.behaviors.size(); ++behavior) {
    if (!step(Verb::finish, behavior, 0)) return;
  }
}

/// Whether a file was refused, with a reason; if not, it must hold the same as `bytes`.
bool is_refused(const CompiledFileResult& result, const std::string& bytes) {
  if (result.file) {
    EXPECT_EQ(write_compiled(result.file->catalog, result.file->source), bytes);
    return false;
  }
  EXPECT_FALSE(result.error.empty());
  return true;
}

TEST(Corruption, EveryCutIsRefused) {
  const std::string bytes = test::compiled_bytes(test::rich_catalog);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    ASSERT_TRUE(is_refused(read_compiled(bytes.substr(0, size)), bytes)) << size;
  }
}

TEST(Corruption, WhateverIsAppendedIsRefused) {
  const std::string bytes = test::compiled_bytes(test::rich_catalog);
  for (const std::string& more : {std::string(1, '\0'), std::string(100, 'x'), bytes}) {
    EXPECT_TRUE(is_refused(read_compiled(bytes + more), bytes));
  }
}

TEST(Corruption, EveryChangedByteIsRefusedOrChangesNothing) {
  const std::string bytes = test::compiled_bytes(test::rich_catalog);
  std::size_t refused = 0;
  std::string changed = bytes;
  for (std::size_t place = 0; place < bytes.size(); ++place) {
    for (unsigned change = 1; change < 256; ++change) {
      changed[place] = static_cast<char>(static_cast<unsigned char>(bytes[place]) ^ change);
      if (is_refused(read_compiled(changed), bytes)) ++refused;
      if (HasFailure()) FAIL() << "byte " << place << " changed by " << change;
    }
    changed[place] = bytes[place];
  }
  // All but the padding around the content.
  EXPECT_GT(refused, (bytes.size() - 100) * 255);
}

/// With a digest that fits it is for the structure to refuse; what is let through is another
/// catalog, and solved like one.
TEST(Corruption, EveryChangedByteUnderANewDigestIsRefusedOrAGoodCatalog) {
  const std::string bytes = test::compiled_bytes(test::rich_catalog);
  const test::ContentPlace content = test::find_content(bytes);
  std::size_t refused = 0;
  std::size_t taken = 0;
  for (std::size_t place = content.begin; place < content.begin + content.size; ++place) {
    for (const unsigned change : {0x01U, 0x02U, 0x04U, 0x08U, 0x10U, 0x20U, 0x40U, 0x80U, 0xFFU}) {
      std::string changed = bytes;
      changed[place] = static_cast<char>(static_cast<unsigned char>(bytes[place]) ^ change);
      test::sign_anew(changed, content);
      const CompiledFileResult result = read_compiled(changed);
      if (!result.file) {
        ++refused;
        ASSERT_FALSE(result.error.empty());
        continue;
      }
      ++taken;
      exercise(result.file->catalog);
      if (HasFailure()) FAIL() << "byte " << place << " changed by " << change;
    }
  }
  EXPECT_GT(refused, taken);
  EXPECT_GT(taken, 1000U) << "names, lines, timeouts and flags can be changed";
}

}  // namespace
}  // namespace cbc

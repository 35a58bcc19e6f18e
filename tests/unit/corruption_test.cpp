#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "runtime/compiled/compiled_file.h"
#include "support/content_place.h"
#include "support/exercise.h"
#include "unit/compiled_bytes.h"

/// Damaged compiled catalogs: cut off anywhere, or with any byte changed.
namespace cbc::corruption_test {
namespace {

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
      EXPECT_EQ(test::exercise(result.file->catalog), std::nullopt);
      if (HasFailure()) FAIL() << "byte " << place << " changed by " << change;
    }
  }
  EXPECT_GT(refused, taken);
  EXPECT_GT(taken, 1000U) << "names, lines, timeouts and flags can be changed";
}

}  // namespace
}  // namespace cbc::corruption_test

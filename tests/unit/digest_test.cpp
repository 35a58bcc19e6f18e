#include <string>

#include <gtest/gtest.h>

#include "runtime/compiled/compiled_file.h"

namespace cbc::digest_test {
namespace {

// As xxh128sum of the xxhash project prints them.
TEST(Digest, IsXxh3Of128Bits) {
  EXPECT_EQ(to_hex(digest_of("")), "99aa06d3014798d86001c324468d497f");
  EXPECT_EQ(to_hex(digest_of("behavior")), "ae58c8c936560a1a9bb3bf0e05ec5172");
  std::string lines;
  for (int line = 1; line <= 1000; ++line) lines += std::to_string(line) + "\n";
  EXPECT_EQ(to_hex(digest_of(lines)), "8527d9296fb8f4a6764aaaecde28829e");
}

}  // namespace
}  // namespace cbc::digest_test

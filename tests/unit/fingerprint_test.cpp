#include <gtest/gtest.h>

#include "support/wording.h"

namespace cbc {
namespace {

// Test vectors of the authors of FNV.
TEST(Fingerprint, IsFnv1a) {
  EXPECT_EQ(fingerprint(""), 0xcbf29ce484222325U);
  EXPECT_EQ(fingerprint("a"), 0xaf63dc4c8601ec8cU);
  EXPECT_EQ(fingerprint("foobar"), 0x85944171f73967e8U);
}

// It must not depend on whether char is signed.
TEST(Fingerprint, TakesBytesAsUnsigned) {
  EXPECT_EQ(fingerprint("\xff"), (0xcbf29ce484222325U ^ 0xffU) * 0x100000001b3U);
}

}  // namespace
}  // namespace cbc

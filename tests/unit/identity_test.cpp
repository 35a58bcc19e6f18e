#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "core/catalog/reader.h"
#include "core/compile/compile.h"
#include "runtime/compiled/compiled_file.h"

namespace cbc::identity_test {
namespace {

constexpr std::string_view text =
    "behaviors:\n"
    "- {behavior: a, task: A, package: one.yaml, suitability: 90}\n"
    "- {behavior: b, task: A, package: two}\n"
    "tasks:\n"
    "- {task: A, timeout: 2, parameters: [{parameter: p, allowed_values: [0, 30]}]}\n";

CompiledCatalog compiled(std::string_view yaml, const std::string& path) {
  Diagnostics diagnostics;
  return compile(read_catalog(std::string(yaml), path, diagnostics).value());
}

std::string replaced(std::string_view old, std::string_view by) {
  std::string result(text);
  result.replace(result.find(old), old.size(), by);
  return result;
}

TEST(Identity, DoesNotDependOnThePath) {
  const Digest digest = identity_of(compiled(text, "x/catalog.yaml"));
  EXPECT_EQ(identity_of(compiled(text, "")), digest);
  EXPECT_EQ(identity_of(compiled(text, "one.yaml")), digest);  // the name of a package, too
}

TEST(Identity, IsTheSameOfTheCompiledFile) {
  const CompiledCatalog catalog = compiled(text, "catalog.yaml");
  const CompiledFileResult loaded = read_compiled(write_compiled(catalog, {}));
  ASSERT_TRUE(loaded.file) << loaded.error;
  EXPECT_EQ(identity_of(loaded.file->catalog), identity_of(catalog));
}

TEST(Identity, DependsOnAllThatIsCompiled) {
  const Digest digest = identity_of(compiled(text, "catalog.yaml"));
  const auto differs = [&digest](std::string_view old, std::string_view by) {
    return !(identity_of(compiled(replaced(old, by), "catalog.yaml")) == digest);
  };
  EXPECT_TRUE(differs("behavior: b", "behavior: c"));
  EXPECT_TRUE(differs("90", "80"));
  EXPECT_TRUE(differs("timeout: 2", "timeout: 3"));
  EXPECT_TRUE(differs("package: two", "package: three"));
  EXPECT_TRUE(differs("parameter: p", "parameter: q"));
  EXPECT_TRUE(differs("[0, 30]", "[0, 31]"));
  EXPECT_FALSE(differs("tasks:", "# a comment\ntasks:"));  // no line of a constraint moves
}

}  // namespace
}  // namespace cbc::identity_test

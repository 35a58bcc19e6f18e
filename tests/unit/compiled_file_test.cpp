#include "runtime/compiled/compiled_file.h"

#include <cstring>
#include <string>

#include <gtest/gtest.h>

#include "cbc/version.h"
#include "core/compile/compile.h"
#include "property/random.h"
#include "support/content_place.h"
#include "support/scratch_folder.h"
#include "unit/compiled_bytes.h"
#include "unit/compiled_fixture.h"
#include "unit/random_problems.h"

namespace cbc::compiled_file_test {
namespace {

TEST(CompiledFile, TellsWhatItWasMadeOfAndByWhom) {
  const std::string bytes = test::compiled_bytes(test::rich_catalog);
  const CompiledFileResult result = read_compiled(bytes);
  ASSERT_TRUE(result.file) << result.error;
  EXPECT_EQ(result.file->format, newest_format);
  EXPECT_EQ(result.file->written_by, version);
  EXPECT_EQ(result.file->source, digest_of(test::rich_catalog));
  EXPECT_EQ(result.file->size, bytes.size());
  EXPECT_EQ(result.file->catalog.file, "a.yaml");
}

/// Writing again what was read shows that nothing was lost or confused, since the writer names the
/// arrays by their order and the reader by their names.
TEST(CompiledFile, HoldsTheWholeCatalog) {
  const CompiledCatalog catalog = test::compile_text(test::rich_catalog);
  const std::string bytes = write_compiled(catalog, digest_of("x"));
  const CompiledFileResult result = read_compiled(bytes);
  ASSERT_TRUE(result.file) << result.error;
  const CompiledCatalog& read = result.file->catalog;
  EXPECT_EQ(write_compiled(read, digest_of("x")), bytes);
  EXPECT_EQ(read.find_task("MOVE"), catalog.find_task("MOVE"));
  EXPECT_EQ(read.find_behavior("both"), catalog.find_behavior("both"));
  EXPECT_EQ(read.find_task("both"), std::nullopt);
  const TaskId move = test::task_id(read, "MOVE");
  EXPECT_EQ(read.tasks[move].minimum_performance, 400'000U);
  EXPECT_EQ(read.tasks[move].keep_running, 1);
  EXPECT_EQ(read.values[move][1].suitability, 805'000U);
  EXPECT_EQ(read.texts[read.behavior_packages[*read.find_behavior("talk")]], "voice");
  EXPECT_EQ(read.requirements[test::behavior_id(read, "go")][0].minimum_performance, 600'000U);
  EXPECT_EQ(read.line_of(read.requirements[test::behavior_id(read, "go")][0]), 11U);
  EXPECT_EQ(read.rules_of(test::task_id(read, "GO")).improve, Improve::at_once);
  EXPECT_EQ(read.rules_of(test::task_id(read, "REST")).reactive_priority, 2);
  EXPECT_EQ(read.retry_of(test::behavior_id(read, "look")), Retry::when_started);
  EXPECT_EQ(read.limits[0].most, 2U);
}

TEST(CompiledFile, OfRandomCatalogsIsReadAsItWasWritten) {
  oracle::Random random(4);
  for (int round = 0; round < 300; ++round) {
    test::Shape shape;
    shape.tasks = 1 + static_cast<std::uint32_t>(round) % 12;
    shape.most_behaviors = round % 50 == 0 ? 130 : 4;
    const CompiledCatalog catalog = compile(test::random_catalog(random, shape));
    const std::string bytes = write_compiled(catalog, {});
    const CompiledFileResult result = read_compiled(bytes);
    ASSERT_TRUE(result.file) << result.error;
    EXPECT_EQ(write_compiled(result.file->catalog, {}), bytes);
  }
}

TEST(CompiledFile, OfAnEmptyCatalogIsRead) {
  const CompiledFileResult result = read_compiled(test::compiled_bytes("behaviors: []"));
  ASSERT_TRUE(result.file) << result.error;
  EXPECT_EQ(result.file->catalog.group_count(), 0U);
}

TEST(CompiledFile, KeepsItsContentWhenItIsReplacedOrRemoved) {
  const test::ScratchFolder folder;
  folder.write("a.cbc", test::compiled_bytes(test::rich_catalog));
  CompiledFileResult result = load_compiled(folder / "a.cbc");
  ASSERT_TRUE(result.file) << result.error;
  std::filesystem::remove(folder / "a.cbc");
  const CompiledCatalog copy = result.file->catalog;
  result.file.reset();
  EXPECT_TRUE(copy.find_task("MOVE"));
}

TEST(CompiledFile, IsToldByItsContent) {
  const std::string bytes = test::compiled_bytes(test::rich_catalog);
  EXPECT_TRUE(is_compiled(bytes));
  EXPECT_TRUE(is_compiled(bytes.substr(0, 8)));
  EXPECT_FALSE(is_compiled(bytes.substr(0, 7)));
  EXPECT_FALSE(is_compiled(test::rich_catalog));
  EXPECT_FALSE(is_compiled(""));
}

std::string error_of(const std::string& path) { return load_compiled(path).error; }

TEST(CompiledFile, SaysWhyItCannotBeLoaded) {
  const test::ScratchFolder folder;
  folder.write("empty", "");
  folder.write("catalog.yaml", test::rich_catalog);
  folder.write("huge", test::compiled_bytes(test::rich_catalog));
  std::filesystem::resize_file(folder / "huge", largest_compiled_file + 1);  // takes no space
  EXPECT_EQ(error_of(folder / "missing"), "No such file or directory");
  EXPECT_EQ(error_of(folder.path()), "Is a directory");
  EXPECT_EQ(error_of("/dev/null"), "it is not a regular file");
  EXPECT_EQ(error_of(folder / "huge"), "it is larger than 1024 MiB");
  EXPECT_EQ(error_of(folder / "empty"), "it is not a compiled catalog");
  EXPECT_EQ(error_of(folder / "catalog.yaml"), "it is not a compiled catalog");
}

/// Where the format number lies in a file: right behind the content's offset and
/// digest, so before the content.
std::size_t place_of_format(const std::string& bytes, const test::ContentPlace& content) {
  for (std::size_t place = 8; place < content.begin; place += 4) {
    std::uint32_t number = 0;
    std::memcpy(&number, bytes.data() + place, sizeof number);
    if (number != newest_format) continue;
    std::string changed = bytes;
    changed[place] = newest_format + 1;
    if (read_compiled(changed).error.find("format") != std::string::npos) return place;
  }
  ADD_FAILURE() << "the format is not found";
  return 0;
}

/// Such as zeros that a copy left which did not go to its end.
TEST(CompiledFile, IsRefusedWithMoreBehindItsEnd) {
  const std::string file = write_compiled(test::compile_text("behaviors: [{behavior: a, task: A}]"),
                                          digest_of("source"));
  ASSERT_TRUE(read_compiled(file).file);
  for (const std::size_t size : {1U, 8U, 16U, 4096U}) {
    for (const char byte : {'\0', 'x'}) {
      const CompiledFileResult result = read_compiled(file + std::string(size, byte));
      EXPECT_FALSE(result.file) << size;
      EXPECT_EQ(result.error, "it is damaged: it does not end where its content does");
    }
  }
}

TEST(CompiledFile, OfANewerFormatIsRefusedByItsNumber) {
  std::string bytes = test::compiled_bytes(test::rich_catalog);
  const test::ContentPlace content = test::find_content(bytes);
  const std::size_t place = place_of_format(bytes, content);
  bytes[place] = 7;
  // Whatever a newer format may hold.
  bytes.replace(content.begin, content.size, content.size, '\xFF');
  EXPECT_EQ(read_compiled(bytes).error, "its format is version 7, but cbc " + std::string(version) +
                                            " knows none above 3; a newer cbc can read it");
  bytes[place] = 0;
  EXPECT_EQ(read_compiled(bytes).error, "it is damaged or truncated");
}

}  // namespace
}  // namespace cbc::compiled_file_test

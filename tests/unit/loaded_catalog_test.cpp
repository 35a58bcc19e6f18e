#include "cbc/loaded_catalog.h"

#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "runtime/compiled/compiled_file.h"
#include "support/scratch_folder.h"
#include "unit/compiled_fixture.h"
#include "unit/loaded_fixture.h"

namespace cbc::loaded_catalog_test {
namespace {

// In groups the tasks stand as HOVER, LOCALIZE | BLINK.
constexpr const char* text = R"(
tasks:
- {task: HOVER}
- {task: BLINK}
- {task: LOCALIZE, start_on_request: false}
behaviors:
- {behavior: lamp, task: BLINK}
- {behavior: hover, task: HOVER, requires: [{task: LOCALIZE}]}
- {behavior: gps, task: LOCALIZE}
- {behavior: mast, tasks: [{task: BLINK}]}
)";

TEST(LoadedCatalog, CountsInCatalogOrder) {
  const LoadedCatalog catalog = test::load_text(text);
  ASSERT_EQ(catalog.task_count(), 3U);
  EXPECT_EQ(catalog.task_name(0), "HOVER");
  EXPECT_EQ(catalog.task_name(1), "BLINK");
  EXPECT_EQ(catalog.task_name(2), "LOCALIZE");
  ASSERT_EQ(catalog.behavior_count(), 4U);
  EXPECT_EQ(catalog.behavior_name(0), "lamp");
  EXPECT_EQ(catalog.behavior_name(3), "mast");
}

TEST(LoadedCatalog, FindsWhatItNames) {
  const LoadedCatalog catalog = test::load_text(text);
  for (std::uint32_t index = 0; index < catalog.task_count(); ++index) {
    EXPECT_EQ(catalog.find_task(catalog.task_name(index)), index);
  }
  for (std::uint32_t index = 0; index < catalog.behavior_count(); ++index) {
    EXPECT_EQ(catalog.find_behavior(catalog.behavior_name(index)), index);
  }
  EXPECT_EQ(catalog.find_task("hover"), std::nullopt);
  EXPECT_EQ(catalog.find_behavior("HOVER"), std::nullopt);
  EXPECT_EQ(catalog.find_task({}), std::nullopt);
}

TEST(LoadedCatalog, HasNoNameForAnIndexThatIsNotThere) {
  const LoadedCatalog catalog = test::load_text(text);
  EXPECT_EQ(catalog.task_name(3), "");
  EXPECT_EQ(catalog.task_name(UINT32_MAX), "");
  EXPECT_EQ(catalog.behavior_name(4), "");
  EXPECT_EQ(catalog.behavior_name(UINT32_MAX), "");
}

TEST(LoadedCatalog, MayBeEmpty) {
  const LoadedCatalog catalog = test::load_text("behaviors: []");
  EXPECT_EQ(catalog.task_count(), 0U);
  EXPECT_EQ(catalog.behavior_count(), 0U);
  EXPECT_EQ(catalog.task_name(0), "");
  EXPECT_EQ(catalog.find_task(""), std::nullopt);
}

TEST(LoadedCatalog, IsThereAfterItWasMovedFrom) {
  LoadedCatalog first = test::load_text(text);
  // NOLINTBEGIN(bugprone-use-after-move, performance-move-const-arg): a move is a copy
  const LoadedCatalog second = std::move(first);
  EXPECT_EQ(first.task_count(), 3U);
  EXPECT_EQ(second.task_name(0).data(), first.task_name(0).data()) << "copies share it";
  // NOLINTEND(bugprone-use-after-move, performance-move-const-arg)
}

TEST(LoadedCatalog, IsRefusedWithAReason) {
  const test::ScratchFolder folder;
  const std::string good = write_compiled(test::compile_text(text), {});
  folder.write("empty", "");
  folder.write("yaml", text);
  folder.write("cut", good.substr(0, good.size() - 1));
  std::string damaged = good;
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 1);
  folder.write("damaged", damaged);
  for (const char* const name : {"missing", "", "empty", "yaml", "cut", "damaged"}) {
    const CatalogLoading loading = LoadedCatalog::load(folder / name);
    EXPECT_FALSE(loading.catalog) << name;
    EXPECT_NE(loading.error, "") << name;
  }
  EXPECT_FALSE(LoadedCatalog::load("").catalog);
  folder.write("good", good);
  const CatalogLoading loading = LoadedCatalog::load(folder / "good");
  EXPECT_TRUE(loading.catalog);
  EXPECT_EQ(loading.error, "");
}

}  // namespace
}  // namespace cbc::loaded_catalog_test

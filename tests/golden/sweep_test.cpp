// `cbc sweep` from outside: what it writes can be used as the manual says.
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "golden/json_relations.h"
#include "golden/process.h"
#include "support/scratch_folder.h"

namespace cbc::golden::sweep_test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const std::string catalog = CBC_SOURCE_DIR "/catalogs/quadrotor.yaml";

class Sweep : public testing::Test {
 protected:
  /// The standard output of a call that has to succeed.
  [[nodiscard]] std::string call(const std::vector<std::string>& arguments) const {
    Call call{arguments, scratch.path()};
    const Result result = run(call);
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.err, "");
    return result.out;
  }

  test::ScratchFolder scratch;
};

/// The nodes of an event in a report of `cbc solve`.
Json nodes_of(const std::string& report, const Json& index) {
  const Json json = Json::parse(report);
  for (const Json& event : json["runs"][0]["events"]) {
    if (event["index"] == index) return event["search"]["nodes"];
  }
  return nullptr;
}

TEST_F(Sweep, WritesTheSlowestEventAsAScript) {
  const Json sweep = Json::parse(call(
      {"sweep", catalog, "--sequences", "50", "--slowest", "slowest.yaml", "--format", "json"}));
  const std::string report = call({"solve", catalog, "slowest.yaml", "--format", "json"});
  EXPECT_EQ(nodes_of(report, sweep["slowest"]["event"]), sweep["slowest"]["nodes"]);
  EXPECT_EQ(scratch.read("slowest.yaml"), sweep["slowest"]["script"].get<std::string>());
}

TEST_F(Sweep, WritesTheEventThatTookLongestAsAScript) {
  const Json sweep = Json::parse(call({"sweep", catalog, "--sequences", "50", "--stats",
                                       "--slowest-by-time", "longest.yaml", "--format", "json"}));
  EXPECT_TRUE(nodes_of(call({"solve", catalog, "longest.yaml", "--format", "json"}),
                       sweep["stats"]["slowest"]["event"])
                  .is_number());
}

TEST_F(Sweep, IsTheSameForACompiledCatalogElsewhere) {
  const Result compiled = run({{"compile", catalog, "-o", "q.cbc"}, scratch.path()});
  ASSERT_EQ(compiled.status, 0);
  fs::copy(catalog, scratch / "moved.yaml");
  const std::string text =
      call({"sweep", catalog, "--sequences", "20", "--format", "json", "-j", "1"});
  EXPECT_EQ(call({"sweep", "q.cbc", "--sequences", "20", "--format", "json", "-j", "3"}), text);
  Json moved = Json::parse(call({"sweep", "moved.yaml", "--sequences", "20", "--format", "json"}));
  EXPECT_EQ(moved["catalog"], "moved.yaml");
  moved["catalog"] = catalog;
  EXPECT_EQ(moved, Json::parse(text));
}

}  // namespace
}  // namespace cbc::golden::sweep_test

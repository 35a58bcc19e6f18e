// The JSON Schemas in schemas/ of what the program writes are those of its descriptions.
// CBC_UPDATE_GOLDEN=1 writes them anew.
#include <cstdlib>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "compile/catalog_dump.h"
#include "core/report/event_json.h"
#include "core/report/run_json.h"
#include "core/script/state_json.h"
#include "coverage/report/coverage_report.h"
#include "graph/report/graph_report.h"
#include "graph/report/tables.h"
#include "lint/report/lint_report.h"
#include "solve/report/what_if_report.h"
#include "support/read_file.h"
#include "sweep/report/sweep_report.h"
#include "tune/report/tune_report.h"
#include "verify/report/verify_report.h"

namespace cbc::schema_files_test {
namespace {

struct File {
  const char* name;
  std::string (*schema)();
};

constexpr File files[] = {{"catalog-dump", catalog_schema},
                          {"coverage", coverage_schema},
                          {"diff", diff_schema},
                          {"events", stream_schema},
                          {"graph", graph_schema},
                          {"lint", lint_schema},
                          {"mutants", mutants_schema},
                          {"situation", situation_schema},
                          {"solve", solve_schema},
                          {"state", state_schema},
                          {"sweep", sweep_schema},
                          {"together", together_schema},
                          {"tune", tune_schema},
                          {"verify", verify_schema},
                          {"what-if", what_if_schema}};

class SchemaFile : public testing::TestWithParam<File> {};

TEST_P(SchemaFile, IsThatOfTheDescription) {
  const std::string path = std::string(CBC_SOURCE_DIR "/schemas/") + GetParam().name + ".json";
  const std::string schema = GetParam().schema();
  if (std::getenv("CBC_UPDATE_GOLDEN") != nullptr) std::ofstream(path) << schema;
  EXPECT_EQ(test::read_file(path), schema);
}

INSTANTIATE_TEST_SUITE_P(All, SchemaFile, testing::ValuesIn(files), [](const auto& of) {
  std::string name = of.param.name;
  std::erase(name, '-');
  return name;
});

}  // namespace
}  // namespace cbc::schema_files_test

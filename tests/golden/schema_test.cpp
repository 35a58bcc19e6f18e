// What `cbc schema NAME` prints is the file of that name in schemas/, with the files that it refers
// to.
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "golden/process.h"
#include "support/read_file.h"

namespace cbc::golden::schema_test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

std::vector<fs::path> schema_files() {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(CBC_SOURCE_DIR "/schemas")) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  return files;
}

/// The schemas that a part refers to, by their ids.
void add_references(const Json& part, std::set<std::string>& ids) {
  if (part.is_object() && part.contains("$ref")) {
    const auto reference = part["$ref"].get<std::string>();
    if (reference.front() != '#') ids.insert(reference.substr(0, reference.find('#')));
  }
  for (const Json& member : part) {
    if (member.is_structured()) add_references(member, ids);
  }
}

std::string print(const fs::path& file) {
  const Result result = run({{"schema", file.stem()}, "/"});
  EXPECT_EQ(result.status, 0) << file;
  EXPECT_EQ(result.err, "") << file;
  return result.out;
}

TEST(Schemas, ArePrintedAsTheyAre) {
  for (const fs::path& file : schema_files()) {
    const std::string text = test::read_file(file);
    const Json schema = Json::parse(text);
    std::set<std::string> references;
    add_references(schema, references);
    const std::string printed = print(file);
    if (references.empty()) {
      EXPECT_EQ(printed, text);
    } else {
      Json without = Json::parse(printed);
      for (std::size_t known = 0; known < references.size();) {
        known = references.size();
        const std::set<std::string> so_far = references;
        for (const std::string& id : so_far) add_references(without["$defs"][id], references);
      }
      for (const std::string& id : references) {
        EXPECT_EQ(without["$defs"][id]["$id"], id) << file;
        without["$defs"].erase(id);
      }
      EXPECT_EQ(without, schema) << file;
    }
  }
}

TEST(Schemas, NeedNoOtherFile) {
  std::size_t embedded = 0;
  for (const fs::path& file : schema_files()) {
    const Json schema = Json::parse(print(file));
    std::set<std::string> references;
    add_references(schema, references);
    for (const std::string& id : references) {
      EXPECT_TRUE(schema["$defs"].contains(id)) << file << " lacks " << id;
      ++embedded;
    }
  }
  EXPECT_GE(embedded, 1U);
}

TEST(Schemas, AreListed) {
  const Result result = run({{"schema"}, "/"});
  for (const fs::path& file : schema_files()) {
    EXPECT_NE(("\n" + result.out).find("\n" + file.stem().string() + " "), std::string::npos);
  }
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'),
            static_cast<std::ptrdiff_t>(schema_files().size()));
}

}  // namespace
}  // namespace cbc::golden::schema_test

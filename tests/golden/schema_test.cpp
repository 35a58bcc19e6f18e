// What `cbc schema NAME` prints is the file of that name in schemas/.
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "golden/process.h"
#include "support/read_file.h"

namespace cbc::golden::schema_test {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> schema_files() {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(CBC_SOURCE_DIR "/schemas")) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  return files;
}

std::string print(const fs::path& file) {
  const Result result = run({{"schema", file.stem()}, "/"});
  EXPECT_EQ(result.status, 0) << file;
  EXPECT_EQ(result.err, "") << file;
  return result.out;
}

TEST(Schemas, ArePrintedAsTheyAre) {
  for (const fs::path& file : schema_files()) EXPECT_EQ(print(file), test::read_file(file));
}

TEST(Schemas, NeedNoOtherFile) {
  for (const fs::path& file : schema_files()) {
    const std::string text = test::read_file(file);
    const std::string reference = R"("$ref": ")";
    for (std::size_t at = 0; (at = text.find(reference, at)) != std::string::npos; ++at) {
      EXPECT_EQ(text[at + reference.size()], '#') << file;
    }
  }
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

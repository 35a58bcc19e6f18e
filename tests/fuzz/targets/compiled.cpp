#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "compile/catalog_dump.h"
#include "fuzz/catalogs.h"
#include "fuzz/target.h"
#include "runtime/compiled/compiled_file.h"
#include "support/content_place.h"
#include "support/exercise.h"

// The content of a compiled catalog, in a file with the right digest: what gets past the digest is
// for the verification to refuse.
namespace cbc::fuzz {
namespace {

std::string compiled_bytes(const std::string& yaml) {
  const auto catalog = catalog_of(yaml);
  return catalog == nullptr ? std::string() : write_compiled(*catalog, {});
}

/// A file with this content, which is the last thing in it but for padding.
std::string file_with(std::string_view content) {
  static const std::string sample = compiled_bytes(catalog_texts().front());
  static const test::ContentPlace place_in_sample = test::find_content(sample);
  constexpr std::size_t alignment = 16;
  test::ContentPlace place = place_in_sample;
  place.size = content.size();
  const auto size = static_cast<std::uint32_t>(content.size());
  std::string bytes = sample.substr(0, place.begin);
  std::memcpy(bytes.data() + place.begin - sizeof size, &size, sizeof size);
  bytes += content;
  bytes.append((alignment - content.size() % alignment) % alignment, '\0');
  test::sign_anew(bytes, place);
  return bytes;
}

void run(const std::string& input) {
  const CompiledFileResult result = read_compiled(file_with(input));
  if (!result.file) {
    require(!result.error.empty(), "a file is refused without a reason");
    return;
  }
  const CompiledCatalog& catalog = result.file->catalog;
  require(!catalog_json(*result.file).empty(), "the dump is empty");
  const std::string bytes = write_compiled(catalog, {});
  const CompiledFileResult again = read_compiled(bytes);
  if (!again.file) fail("what was accepted is refused when written: " + again.error);
  require(write_compiled(again.file->catalog, {}) == bytes, "the written catalog has changed");
  if (const auto refusal = test::exercise(catalog)) fail(*refusal);
}

std::vector<std::string> seeds() {
  std::vector<std::string> contents;
  for (const std::string& yaml : catalog_texts()) {
    const std::string bytes = compiled_bytes(yaml);
    if (bytes.empty()) continue;
    const test::ContentPlace place = test::find_content(bytes);
    contents.push_back(bytes.substr(place.begin, place.size));
  }
  return contents;
}

}  // namespace

Target compiled_target() {
  return {"compiled",
          "the content of a compiled catalog, under the right digest",
          Language::bytes,
          0,
          8192,
          run,
          seeds};
}

}  // namespace cbc::fuzz

#include "unit/compiled_bytes.h"

#include <cstdint>
#include <cstring>

#include <gtest/gtest.h>

#include "compiled/compiled_file.h"
#include "unit/compiled_fixture.h"

namespace cbc::test {

const std::string_view rich_catalog = R"(
default_values:
  tasks: {start_on_request: FALSE}
tasks:
- {task: GO, start_on_request: TRUE, timeout: 5}
- {task: LOOK, parameters: [{parameter: speed, allowed_values: [0, 30]}, {parameter: to}]}
- {task: MOVE, minimum_performance: 40, execution_goal: keep_running}
- {task: REST, reactive_start: TRUE, execution_goal: keep_running}
- {task: TALK, parameters: [{parameter: text, allowed_values: string}]}
behaviors:
- {behavior: go, task: GO, package: drive, requires: [{task: MOVE, minimum_performance: 60}]}
- {behavior: go_slowly, task: GO, suitability: 70, requires: [{task: MOVE}, {task: LOOK}]}
- {behavior: look, task: LOOK, suitability: 95}
- {behavior: both, package: drive, tasks: [{task: LOOK, suitability: 50}, {task: MOVE}]}
- {behavior: move, task: MOVE, suitability: 80.5, timeout: 9}
- {behavior: rest, task: REST}
- {behavior: talk, task: TALK, package: voice}
exclusivity_constraints:
- mutually_exclusive: [REST, GO, TALK]
- mutually_exclusive: [REST, LOOK]
)";

std::string compiled_bytes(std::string_view yaml) {
  return write_compiled(compile_text(yaml), digest_of(yaml));
}

ContentPlace find_content(const std::string& file) {
  const CompiledFileResult result = read_compiled(file);
  EXPECT_TRUE(result.file) << result.error;
  if (!result.file) return {};
  const Digest digest = result.file->content;
  const std::string_view signature(reinterpret_cast<const char*>(digest.bytes.data()),
                                   digest.bytes.size());
  ContentPlace place;
  place.digest = file.find(signature);
  // A vector: its size in four bytes, and then the items.
  for (place.begin = 4; place.begin < file.size(); place.begin += 4) {
    std::uint32_t size = 0;
    std::memcpy(&size, file.data() + place.begin - 4, sizeof size);
    place.size = size;
    if (place.begin + size <= file.size() &&
        digest_of(std::string_view(file).substr(place.begin, size)) == digest) {
      return place;
    }
  }
  ADD_FAILURE() << "the content is not found";
  return {};
}

void sign_anew(std::string& file, const ContentPlace& place) {
  const Digest digest = digest_of(std::string_view(file).substr(place.begin, place.size));
  std::memcpy(file.data() + place.digest, digest.bytes.data(), digest.bytes.size());
}

}  // namespace cbc::test

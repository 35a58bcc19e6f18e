#include "support/content_place.h"

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string_view>

#include "runtime/compiled/compiled_file.h"

namespace cbc::test {

ContentPlace find_content(const std::string& file) {
  const CompiledFileResult result = read_compiled(file);
  if (!result.file) throw std::runtime_error(result.error);
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
  throw std::runtime_error("the content is not found");
}

void sign_anew(std::string& file, const ContentPlace& place) {
  const Digest digest = digest_of(std::string_view(file).substr(place.begin, place.size));
  std::memcpy(file.data() + place.digest, digest.bytes.data(), digest.bytes.size());
}

}  // namespace cbc::test

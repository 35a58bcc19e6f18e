#include "unit/compiled_bytes.h"

#include <utility>

#include "unit/compiled_fixture.h"

namespace cbc::test {

std::string compiled_bytes(std::string_view yaml) {
  return write_compiled(compile_text(yaml), digest_of(yaml));
}

CompiledFile compiled_file(CompiledCatalog catalog) {
  CompiledFile file;
  file.catalog = std::move(catalog);
  file.catalog.file = "robot.yaml";
  file.format = 7;
  file.written_by = "1.2.3";
  file.source.bytes.fill(0xab);
  file.content.bytes.fill(0x01);
  file.size = 4321;
  return file;
}

}  // namespace cbc::test

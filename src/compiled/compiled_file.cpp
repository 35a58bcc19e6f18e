#include "compiled/compiled_file.h"

#include <utility>

#include "compiled/encoding.h"
#include "compiled/verify.h"
#include "file/mapped_file.h"

namespace cbc {
namespace {

CompiledFileResult open(MappedFile memory) {
  if (memory.memory == nullptr) return {std::nullopt, std::move(memory.error)};
  CompiledFileResult result = decode(memory.content);
  if (!result.file) return result;
  result.file->catalog.storage = std::move(memory.memory);
  if (const auto fault = find_fault(result.file->catalog)) {
    return {std::nullopt, "it is damaged: " + *fault};
  }
  return result;
}

}  // namespace

CompiledFileResult load_compiled(const std::string& path) {
  return open(map_file(path, largest_compiled_file));
}

CompiledFileResult read_compiled(std::string_view content) { return open(copy_to_memory(content)); }

}  // namespace cbc

#include "bench/compiled_inputs.h"

#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>
#include <unistd.h>
#include <utility>

#include "bench/inputs.h"
#include "core/catalog/reader.h"
#include "core/compile/compile.h"
#include "core/yaml/document.h"
#include "runtime/compiled/compiled_file.h"

namespace cbc::bench {
namespace {

/// Counts the time of the processor: what takes seconds is held up by other programs, too.
class StopWatch {
 public:
  /// Seconds since the last call.
  double lap() {
    const std::clock_t now = std::clock();
    return static_cast<double>(now - std::exchange(last_, now)) / CLOCKS_PER_SEC;
  }

 private:
  std::clock_t last_ = std::clock();
};

}  // namespace

Compilation compile_to_bytes(std::string_view text, const std::string& name) {
  Compilation compilation;
  Diagnostics diagnostics;
  StopWatch watch;
  const auto document = yaml::parse(text, name, diagnostics);
  if (document == nullptr) refuse(diagnostics);
  compilation.parsing = watch.lap();
  const std::optional<Catalog> catalog = read_catalog(*document, diagnostics);
  if (!catalog) refuse(diagnostics);
  compilation.understanding = watch.lap();
  compilation.bytes = write_compiled(compile(*catalog), digest_of(text));
  compilation.compiling = watch.lap();
  if (compilation.bytes.empty()) throw std::runtime_error(name + " is too large to be compiled");
  return compilation;
}

TemporaryFile::TemporaryFile(std::string_view content)
    : path_((std::filesystem::temp_directory_path() / "cbc-bench-XXXXXX").string()) {
  const int descriptor = mkstemp(path_.data());
  if (descriptor < 0) throw std::runtime_error("no temporary file");
  close(descriptor);
  std::ofstream file(path_, std::ios::binary);
  if (!file.write(content.data(), static_cast<std::streamsize>(content.size())).flush()) {
    throw std::runtime_error("cannot write " + path_);
  }
}

TemporaryFile::~TemporaryFile() {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace cbc::bench

#include <string>
#include <vector>

#include "fuzz/catalogs.h"
#include "fuzz/program.h"
#include "fuzz/target.h"
#include "verify/verify.h"

// A property file on a catalog, as `cbc verify` takes it: it runs what it finds as scripts, and
// says so (exit status 3) if one does not break its property.
namespace cbc::fuzz {
namespace {

void run(const std::string& input) {
  const std::vector<std::string> parts = split_parts(input);
  if (parts.size() != 2) return;
  cli::VerifyOptions options;
  options.paths = {compiled_file_of(parts.front()), memory_file(0, parts.back())};
  if (options.paths.front().empty()) return;
  options.format = "json";
  options.jobs = 1;
  options.limits.max_states = 300;
  options.limits.max_memory = "64M";
  static_cast<void>(run_program("", [&options] { return cli::verify(options); }));
}

std::vector<std::string> seeds() {
  std::vector<std::string> inputs;
  for (const Pair& pair : catalogs_with_properties()) {
    inputs.push_back(join_parts(std::vector{pair.catalog, pair.text}));
  }
  return inputs;
}

}  // namespace

Target properties_target() {
  return {"properties", "a property file, on a catalog", Language::yaml, 1, 8192, run, seeds};
}

}  // namespace cbc::fuzz

// The entry points of libFuzzer. One program has all targets: CBC_FUZZ_TARGET names the one to run.
// With CBC_FUZZ_SEEDS=FOLDER it only writes the inputs to begin with; without CBC_FUZZ_TARGET it
// lists the targets. `./dev fuzz` sets both.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <fmt/core.h>

#include "fuzz/mutator.h"
#include "fuzz/target.h"
#include "runtime/compiled/compiled_file.h"

using namespace cbc::fuzz;

// The names are those of libFuzzer.
// NOLINTBEGIN(readability-identifier-naming)
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed);
// NOLINTEND(readability-identifier-naming)

namespace {

const Target* target = nullptr;

void list_targets() {
  for (const Target& one : targets()) {
    fmt::print("{} {} {}\n", one.name, one.longest, one.what);
  }
}

void write_seeds(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const std::string& seed : seeds_of(*target)) {
    const auto name = "seed-" + cbc::to_hex(cbc::digest_of(seed)).substr(0, 16);
    std::ofstream(folder / name, std::ios::binary) << seed;
  }
}

std::string mutate_bytes(std::string text, std::size_t most) {
  const std::size_t size = text.size();
  text.resize(std::max(most, size));
  text.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(text.data()), size, text.size()));
  return text;
}

}  // namespace

int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  const char* const name = std::getenv("CBC_FUZZ_TARGET");
  if (name == nullptr) {
    list_targets();
    std::exit(EXIT_SUCCESS);
  }
  target = find_target(name);
  if (target == nullptr) {
    fmt::print(stderr, "there is no target '{}'\n", name);
    std::exit(EXIT_FAILURE);
  }
  if (const char* const folder = std::getenv("CBC_FUZZ_SEEDS")) {
    write_seeds(folder);
    std::exit(EXIT_SUCCESS);
  }
  return 0;
}

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  target->run(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}

std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                    unsigned seed) {
  const std::string_view input(reinterpret_cast<const char*>(data), size);
  const std::string mutated = mutate(*target, input, most, seed, mutate_bytes);
  std::copy(mutated.begin(), mutated.end(), data);
  return mutated.size();
}

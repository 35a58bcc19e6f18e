#include <cstddef>
#include <string>
#include <vector>

#include "fuzz/target.h"
#include "property/event_case.h"
#include "property/generator.h"
#include "property/random.h"

// A catalog and events, made of the bytes, of which the program must say the same as the oracle,
// which enumerates.
namespace cbc::fuzz {
namespace {

void run(const std::string& input) {
  oracle::Random random(input);
  const oracle::Case sample = oracle::generate_case(random);
  if (const auto fault = oracle::find_fault(sample, random, nullptr)) fail(*fault);
}

/// The longer, the more of a case is made of them; the rest of it is always the same.
std::vector<std::string> seeds() {
  std::vector<std::string> inputs;
  oracle::Random random(1);
  for (std::size_t size = 1; size <= 1024; size *= 2) {
    for (int i = 0; i < 2; ++i) {
      std::string& input = inputs.emplace_back();
      while (input.size() < size) input += static_cast<char>(random.below(256));
    }
  }
  return inputs;
}

}  // namespace

Target oracle_target() {
  return {"oracle",
          "choices of a catalog and of events; compared with the brute force",
          Language::bytes,
          0,
          2048,
          run,
          seeds};
}

}  // namespace cbc::fuzz

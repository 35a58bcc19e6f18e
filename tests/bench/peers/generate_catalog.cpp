// Prints a generated catalog; see bench/catalog_generator.h:
//
//     cbc_generate_catalog TASKS BEHAVIORS REQUIREMENTS LEVELS EXCLUSIONS SEED

#include <cstdlib>
#include <iostream>

#include "bench/catalog_generator.h"

int main(int argc, char** argv) {
  if (argc != 7) {
    std::cerr << "expected TASKS BEHAVIORS REQUIREMENTS LEVELS EXCLUSIONS SEED\n";
    return 2;
  }
  const auto number = [&](int place) { return std::strtoull(argv[place], nullptr, 10); };
  std::cout << cbc::bench::generate_catalog(
      {number(1), number(2), number(3), number(4), number(5), number(6)});
  return std::cout.flush() ? 0 : 2;
}

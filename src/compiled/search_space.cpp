#include "compiled/search_space.h"

#include <boost/multiprecision/cpp_int.hpp>

namespace cbc {

std::string search_space(const std::vector<std::uint32_t>& domain_sizes) {
  // Most products fit in a machine word.
  std::uint64_t word = 1;
  std::size_t place = 0;
  while (place < domain_sizes.size() && word <= UINT32_MAX) word *= domain_sizes[place++];
  if (place == domain_sizes.size()) return std::to_string(word);

  boost::multiprecision::cpp_int product = word;
  for (; place < domain_sizes.size(); ++place) {
    if (domain_sizes[place] != 1) product *= domain_sizes[place];
  }
  return product.str();
}

}  // namespace cbc

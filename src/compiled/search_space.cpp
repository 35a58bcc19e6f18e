#include "compiled/search_space.h"

#include <boost/multiprecision/cpp_int.hpp>

namespace cbc {

std::string search_space(const std::vector<std::uint32_t>& domain_sizes) {
  boost::multiprecision::cpp_int product = 1;
  for (const std::uint32_t size : domain_sizes) {
    if (size != 1) product *= size;
  }
  return product.str();
}

}  // namespace cbc

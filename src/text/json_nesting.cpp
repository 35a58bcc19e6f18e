#include "text/json_nesting.h"

#include <algorithm>

namespace cbc {

std::size_t nesting_of(std::string_view json) {
  std::size_t open = 0;
  std::size_t deepest = 0;
  bool is_string = false;
  for (std::size_t place = 0; place < json.size(); ++place) {
    const char c = json[place];
    if (c == '"') {
      is_string = !is_string;
    } else if (is_string) {
      if (c == '\\') ++place;
    } else if (c == '[' || c == '{') {
      deepest = std::max(deepest, ++open);
    } else if ((c == ']' || c == '}') && open > 0) {
      --open;
    }
  }
  return deepest;
}

}  // namespace cbc

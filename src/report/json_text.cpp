#include "report/json_text.h"

#include <nlohmann/json.hpp>

namespace cbc {

std::string to_text(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void append_item(std::string& array, const std::string& item) {
  array += array.back() == '[' ? "\n" : ",\n";
  array += item;
}

}  // namespace cbc

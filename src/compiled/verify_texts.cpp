#include <algorithm>
#include <cstring>

#include <fmt/format.h>

#include "compiled/verify_parts.h"
#include "text/quote.h"
#include "text/utf8.h"

namespace cbc::verify {
namespace {

bool is_ascii(std::span<const char> characters) {
  std::uint64_t bits = 0;
  std::size_t i = 0;
  for (; i + sizeof(bits) <= characters.size(); i += sizeof(bits)) {
    std::uint64_t eight = 0;
    std::memcpy(&eight, characters.data() + i, sizeof(eight));
    bits |= eight;
  }
  for (; i < characters.size(); ++i) bits |= static_cast<unsigned char>(characters[i]);
  return (bits & 0x8080808080808080U) == 0;
}

/// The source is exempt: its name is what the operating system says.
Fault find_encoding_fault(const CompiledCatalog& catalog) {
  constexpr std::size_t block = 256;  // texts that are looked at at once, as most are ASCII
  const Rows<char>& texts = catalog.texts.rows();
  for (std::size_t first = 0; first < texts.size(); first += block) {
    const std::size_t end = std::min(first + block, texts.size());
    if (is_ascii(
            {texts.items.data() + texts.begin[first], texts.items.data() + texts.begin[end]})) {
      continue;
    }
    for (std::size_t text = first; text < end; ++text) {
      const std::string_view characters = catalog.texts[text];
      const bool is_file =
          characters.data() == catalog.file.data() && characters.size() == catalog.file.size();
      if (!is_file && utf8::find_invalid(characters)) {
        return fmt::format("text {}, {}, is not UTF-8", text, quote(characters));
      }
    }
  }
  return std::nullopt;
}

bool is_same(const Rows<char>& a, const Rows<char>& b) {
  return a.items.data() == b.items.data() && a.items.size() == b.items.size() &&
         std::equal(a.begin.begin(), a.begin.end(), b.begin.begin(), b.begin.end());
}

/// `names` are those of the texts from `first` on, one for each of `by_name`. No two are equal, as
/// they ascend.
Fault find_name_fault(std::string_view kind, const CompiledCatalog& catalog, const Texts& names,
                      std::size_t first, std::span<const std::uint32_t> by_name) {
  const std::size_t count = by_name.size();
  if (!is_same(names.rows(), catalog.texts.part(first, count).rows())) {
    return fmt::format("the names of the {}s are not texts {} to {}", kind, first, first + count);
  }
  for (std::size_t place = 0; place < count; ++place) {
    if (names[place].empty()) return fmt::format("the name of {} {} is empty", kind, place);
  }
  std::string_view before;
  for (const std::uint32_t place : by_name) {
    if (place >= count) return fmt::format("'{}s_by_name' has {} of {}", kind, place, count);
    const std::string_view name = names[place];
    if (before >= name) {
      return before == name
                 ? fmt::format("two {}s have the name {}", kind, quote(name))
                 : fmt::format("'{}s_by_name' has {} before {}", kind, quote(before), quote(name));
    }
    before = name;
  }
  return std::nullopt;
}

Fault find_text_id_fault(std::string_view what, std::span<const TextId> ids, std::size_t texts) {
  TextId highest = 0;
  for (const TextId id : ids) highest = std::max(highest, id);
  if (ids.empty() || highest < texts) return std::nullopt;
  return fmt::format("'{}' has text {} of {}", what, highest, texts);
}

/// The allowed values stand in the order of the parameters, without gaps.
Fault find_parameter_fault(const CompiledCatalog& catalog) {
  std::uint64_t next = 0;
  for (std::size_t place = 0; place < catalog.parameters.items.size(); ++place) {
    const CompiledParameter& parameter = catalog.parameters.items[place];
    if (parameter.name >= catalog.texts.size()) {
      return fmt::format("the name of parameter {} is text {} of {}", place, parameter.name,
                         catalog.texts.size());
    }
    if (catalog.texts[parameter.name].empty()) {
      return fmt::format("the name of parameter {} is empty", place);
    }
    if (parameter.allowed_is_list > 1) {
      return fmt::format("allowed_is_list of parameter {} is {}, expected 0 or 1", place,
                         parameter.allowed_is_list);
    }
    if (parameter.allowed_is_list == 0 && parameter.allowed_count > 1) {
      return fmt::format("parameter {} has {} types, expected at most one", place,
                         parameter.allowed_count);
    }
    if (parameter.first_allowed != next) {
      return fmt::format("the allowed values of parameter {} begin at {}, expected {}", place,
                         parameter.first_allowed, next);
    }
    next += parameter.allowed_count;
  }
  if (next == catalog.allowed_values.size()) return std::nullopt;
  return fmt::format("'allowed_values' has {} entries, expected {}", catalog.allowed_values.size(),
                     next);
}

}  // namespace

Fault find_text_fault(const CompiledCatalog& catalog) {
  const std::size_t tasks = catalog.tasks.size();
  const std::size_t texts = catalog.texts.size();
  if (auto fault = find_encoding_fault(catalog)) return fault;
  if (auto fault = find_name_fault("task", catalog, catalog.task_names, 0, catalog.tasks_by_name)) {
    return fault;
  }
  if (auto fault = find_name_fault("behavior", catalog, catalog.behavior_names, tasks,
                                   catalog.behaviors_by_name)) {
    return fault;
  }
  if (auto fault = find_text_id_fault("behavior_packages", catalog.behavior_packages, texts)) {
    return fault;
  }
  if (auto fault = find_text_id_fault("allowed_values", catalog.allowed_values, texts)) {
    return fault;
  }
  return find_parameter_fault(catalog);
}

}  // namespace cbc::verify

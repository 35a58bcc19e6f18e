#include "yaml/duplicates.h"

#include <string_view>
#include <unordered_map>

#include "cbc/rules.h"
#include "text/quote.h"

namespace cbc::yaml {

void report_duplicate_keys(const Node& mapping, Reporter& reporter) {
  std::unordered_map<std::string_view, const Node*> known;
  for (const auto& entry : mapping.entries) {
    const Node& key = *entry.first;
    const auto [first, is_new] = known.try_emplace(key.text, &key);
    if (is_new) continue;
    reporter.report(rule::duplicate_key, key.range, quote(key.text) + " is given twice",
                    {reporter.note(first->second->range, "first given here")});
  }
}

}  // namespace cbc::yaml

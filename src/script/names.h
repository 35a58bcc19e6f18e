#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>

#include "diagnostic/reporter.h"
#include "script/script_names.h"
#include "text/nearest.h"
#include "yaml/document.h"

namespace cbc {

/// Finds the tasks and behaviors that a script names, and reports names that there are not.
class NameIndex {
 public:
  /// The names must outlive this object.
  explicit NameIndex(const ScriptNames& names);

  /// `what` is the key that the name belongs to.
  [[nodiscard]] std::optional<std::uint32_t> find_task(const yaml::Node& node,
                                                       std::string_view what, Reporter& reporter);
  [[nodiscard]] std::optional<std::uint32_t> find_behavior(const yaml::Node& node,
                                                           std::string_view what,
                                                           Reporter& reporter);

  [[nodiscard]] const ScriptNames& all() const { return all_; }

 private:
  struct Names {
    explicit Names(const std::vector<std::string_view>& names);
    std::unordered_map<std::string_view, std::uint32_t> places;
    Suggestions suggestions;
  };

  const ScriptNames& all_;
  Names tasks_;
  Names behaviors_;
};

}  // namespace cbc

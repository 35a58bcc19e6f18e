#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "ask/formula.h"
#include "core/catalog/name_place.h"
#include "core/diagnostic/diagnostic.h"
#include "core/script/script.h"
#include "core/support/wording.h"
#include "core/yaml/document.h"
#include "core/yaml/values.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/record.h"

namespace cbc {

// What scripts and property files share: names of a catalog, and what is said of them.

/// Finds the tasks and behaviors that a script names, by their places in the catalog, and reports
/// unknown names.
class NameIndex {
 public:
  /// The catalog must outlive this object, and so must `places`, in which it notes where names of
  /// the catalog stand, unless that is null.
  explicit NameIndex(const CompiledCatalog& catalog, std::vector<NamePlace>* places = nullptr)
      : catalog_(catalog), places_(places) {}

  /// `what` is the key that the name is the value of. `beside`: the list or mapping that the name
  /// stands in, whose other names are not suggested.
  [[nodiscard]] std::optional<std::uint32_t> find_task(const yaml::Node& node,
                                                       std::string_view what, Reporter& reporter,
                                                       const yaml::Node* beside = nullptr);
  using Find = std::optional<std::uint32_t> (NameIndex::*)(const yaml::Node&, std::string_view,
                                                           Reporter&, const yaml::Node*);
  /// The same of a task that is to be started; reports it if nobody may request it.
  [[nodiscard]] std::optional<std::uint32_t> find_requestable(const yaml::Node& node,
                                                              std::string_view what,
                                                              Reporter& reporter,
                                                              const yaml::Node* beside = nullptr);
  [[nodiscard]] std::optional<std::uint32_t> find_behavior(const yaml::Node& node,
                                                           std::string_view what,
                                                           Reporter& reporter,
                                                           const yaml::Node* beside = nullptr);

  /// Of a situation: a behavior, or a variable.
  struct Part {
    bool is_variable = false;
    std::uint32_t place = 0;
  };
  [[nodiscard]] std::optional<Part> find_part(const yaml::Node& node, Reporter& reporter,
                                              const yaml::Node* beside);
  /// For a part whose value is left out: only notes where its name stands.
  void pass_part(const yaml::Node& node);

  [[nodiscard]] const CompiledCatalog& catalog() const { return catalog_; }
  /// Answers what states there may be; all questions share one effort.
  [[nodiscard]] StateAsk& states();

 private:
  void note(NameKind kind, const yaml::Node& node) {
    if (places_ != nullptr) places_->push_back({kind, node.range});
  }
  [[nodiscard]] std::optional<Part> part_called(std::string_view name, const yaml::Node& node);

  const CompiledCatalog& catalog_;
  std::vector<NamePlace>* const places_;
  // Made when the first unknown name is met.
  std::optional<Suggestions> tasks_;
  std::optional<Suggestions> behaviors_;
  std::optional<Suggestions> parts_;
  std::unique_ptr<StateAsk> states_;  ///< made for the first question
};

/// Reads one of the words of an enumeration.
template <typename Enum>
[[nodiscard]] std::optional<Enum> read_word(const yaml::Node& node, std::string_view what,
                                            Reporter& reporter) {
  const auto place = yaml::read_choice(node, what, words_of<Enum>(), reporter);
  return place ? std::optional(static_cast<Enum>(*place)) : std::nullopt;
}

/// Finds names that are listed twice.
class ListedNames {
 public:
  /// Returns whether `place`, which `node` names, is new in the list; reports it if it is not.
  bool add(std::uint32_t place, const yaml::Node& node, Reporter& reporter);

 private:
  std::unordered_map<std::uint32_t, Range> first_;
};

/// Reads a mapping of behaviors to booleans, and of situation variables to their values. Empty,
/// after a finding, unless all of it is understood.
[[nodiscard]] std::optional<Situation> read_situation(const yaml::Node& node, NameIndex& names,
                                                      Reporter& reporter);

/// What a condition says of a situation: the values that a variable may have, or whether a behavior
/// is available.
struct SituationEntry {
  NameIndex::Part part;
  std::vector<std::uint32_t> values;  ///< of a variable: at least one, distinct
  bool available = true;              ///< of a behavior
  Range range;                        ///< of its name
};

/// The same mapping, but a variable may have a list of values.
[[nodiscard]] std::optional<std::vector<SituationEntry>> read_possible_situation(
    const yaml::Node& node, NameIndex& names, Reporter& reporter);

}  // namespace cbc

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic/diagnostic.h"
#include "core/yaml/document.h"

/// Catalogs of the formats that are older than tasks: how they are told from others, and what they
/// are in the present format. There are three:
///
/// - behavior_descriptors with `capabilities` and `incompatible_lists`, beside behavior_lists and
///   capability_descriptors;
/// - behavior_descriptors with a `system` each, beside precedence_constraints and
///   exclusivity_constraints;
/// - basic_behaviors, whose entries are as the descriptors of the others.
///
/// Some files have their descriptors under `behaviors`.
namespace cbc {

/// What shows that a catalog has an older format.
struct OlderFormat {
  const yaml::Node* key = nullptr;
  std::string_view features;  ///< "with capabilities and without tasks"
};
[[nodiscard]] std::optional<OlderFormat> find_older_format(const yaml::Node& root);

/// A part of an older catalog that has no equal in the present format, and what becomes of it.
struct Leftover {
  Range range;
  std::string message;
};

/// An older catalog in the present format.
struct Conversion {
  std::string text;                  ///< empty if there is an obstacle
  std::vector<Leftover> leftovers;   ///< one for each kind, at its first place
  std::optional<Leftover> obstacle;  ///< why it cannot be converted
};

/// Converts an older catalog. Each behavior performs a task of its name, and each capability
/// becomes a behavior with its task, which others require. What cannot be converted is kept under
/// keys that begin with "x-". `text` is that of the document, from which comments are taken.
[[nodiscard]] Conversion convert_older_format(const yaml::Document& document,
                                              std::string_view text);

}  // namespace cbc

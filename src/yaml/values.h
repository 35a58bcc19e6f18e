#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "cbc/units.h"
#include "diagnostic/reporter.h"
#include "yaml/document.h"

/// Values of a document as what they are meant to be. Each function reports what is wrong and
/// returns nothing then; `what` is the name of the key they belong to.
namespace cbc::yaml {

/// What a node is, for messages: "a list", "'80' in quotes".
[[nodiscard]] std::string describe(const Node& node);

/// What one of YAML 1.1's booleans says; empty if the node is none of them.
[[nodiscard]] std::optional<bool> to_boolean(const Node& node);

/// Reports a node that is not what was `expected` ("a list of tasks").
void report_wrong_type(const Node& node, std::string_view what, std::string_view expected,
                       Reporter& reporter);

/// The node itself if it is a list or a mapping.
[[nodiscard]] const Node* read_list(const Node& node, std::string_view what,
                                    std::string_view expected, Reporter& reporter);
[[nodiscard]] const Node* read_mapping(const Node& node, std::string_view what,
                                       std::string_view expected, Reporter& reporter);

/// Any scalar, which may be empty.
[[nodiscard]] std::optional<std::string_view> read_text(const Node& node, std::string_view what,
                                                        std::string_view expected,
                                                        Reporter& reporter);

/// A name: any scalar that is not empty.
[[nodiscard]] std::optional<std::string_view> read_name(const Node& node, std::string_view what,
                                                        std::string_view expected,
                                                        Reporter& reporter);

/// One of YAML 1.1's booleans.
[[nodiscard]] std::optional<bool> read_boolean(const Node& node, std::string_view what,
                                               Reporter& reporter);

/// The other boolean, spelled in the same way ("No" of "Yes"); nothing if the node is none.
[[nodiscard]] std::optional<std::string_view> opposite(const Node& node);

[[nodiscard]] std::optional<Millionths> read_percent(const Node& node, std::string_view what,
                                                     Reporter& reporter);

/// Seconds; over 0 if `positive`.
[[nodiscard]] std::optional<Microseconds> read_seconds(const Node& node, std::string_view what,
                                                       bool positive, Reporter& reporter);

[[nodiscard]] std::optional<std::int32_t> read_integer(const Node& node, std::string_view what,
                                                       std::int32_t lowest, Reporter& reporter);

/// The place of a word among `choices`.
[[nodiscard]] std::optional<std::size_t> read_choice(
    const Node& node, std::string_view what, std::initializer_list<std::string_view> choices,
    Reporter& reporter);

}  // namespace cbc::yaml

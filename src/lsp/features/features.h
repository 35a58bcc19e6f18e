#pragma once

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/catalog/name_place.h"
#include "lsp/protocol/client.h"
#include "lsp/protocol/text.h"
#include "lsp/workspace/workspace.h"

// What the server answers, as the protocol wants it. Nothing here changes a file.

namespace cbc::lsp {

/// A place in a file that a request is about. What is known of the file is of its present text.
struct Cursor {
  const Workspace& workspace;
  const File& file;
  std::size_t offset = 0;
};

/// Why a request cannot be answered, for people.
struct Refusal : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Values of the protocol.

[[nodiscard]] Json to_json(const Place& place);
[[nodiscard]] Json to_json(const PlaceRange& range);
/// The range of some bytes.
[[nodiscard]] Json range_json(const Text& text, std::size_t begin, std::size_t end);
/// {"uri": ..., "range": ...}
[[nodiscard]] Json location_json(const File& file, std::size_t begin, std::size_t end);
[[nodiscard]] Json edits_json(const File& file, std::string_view changed);
[[nodiscard]] Json diagnostics_json(const Workspace& workspace, const File& file);

// What may be written at a place, and what stands there means: of the text alone, with the names
// that the catalog had last.

[[nodiscard]] Json list_completions(const Cursor& cursor, const Client& client);
[[nodiscard]] Json find_hover(const Cursor& cursor);

// Names.

/// A name of a catalog where it stands in a file.
struct NameAt {
  NameKind kind = NameKind::task;
  std::string name;
  std::size_t begin = 0;
  std::size_t end = 0;
};
/// Also where the text does not parse.
[[nodiscard]] std::optional<NameAt> find_name(const Cursor& cursor);

[[nodiscard]] Json find_definition(const Cursor& cursor);
[[nodiscard]] Json find_references(const Cursor& cursor, bool with_definition);
[[nodiscard]] Json find_highlights(const Cursor& cursor);
[[nodiscard]] Json prepare_rename(const Cursor& cursor);
/// A workspace edit. Throws a Refusal.
[[nodiscard]] Json rename(const Cursor& cursor, const std::string& new_name, const Client& client);

// Of a whole file.

[[nodiscard]] Json list_symbols(const File& file, const Client& client);
[[nodiscard]] Json list_folds(const File& file);
/// What can be run on the command line about a file: its mission, the reason for what is expected,
/// the proof of its properties. The command `cbc.run` runs the words of its argument.
[[nodiscard]] Json list_lenses(const File& file);

/// Quick fixes of the findings in a piece of a file.
[[nodiscard]] Json list_fixes(const Workspace& workspace, const File& file, std::size_t begin,
                              std::size_t end, const Client& client);

/// What each event of a mission does, and whether its expectations hold.
[[nodiscard]] Json list_hints(const Workspace& workspace, const File& file, std::size_t begin,
                              std::size_t end);

}  // namespace cbc::lsp

#pragma once

#include <nlohmann/json.hpp>

#include "lsp/protocol/text.h"

namespace cbc::lsp {

using Json = nlohmann::json;

/// A member of a member; null if there is none.
[[nodiscard]] Json find_member(const Json& value, std::initializer_list<const char*> names);

/// What a client can do, of all that the server asks.
struct Client {
  Encoding encoding = Encoding::utf16;  ///< UTF-8 where it is offered
  bool can_watch = false;               ///< tells of changes on the disk if it is asked to
  bool has_snippets = false;
  bool has_symbol_trees = false;
  bool has_versioned_edits = false;  ///< `documentChanges`
  bool can_create_files = false;     ///< as a part of an edit
  bool renews_hints = false;         ///< asks for them again when it is told to
  bool renews_lenses = false;
};

/// From the parameters of `initialize`.
[[nodiscard]] Client client_of(const Json& params);

/// A workspace edit, from its `documentChanges`, as the client takes it. Without versions there can
/// be no other change than that of texts.
[[nodiscard]] Json workspace_edit(const Client& client, Json document_changes);

}  // namespace cbc::lsp

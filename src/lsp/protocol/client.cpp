#include "lsp/protocol/client.h"

#include <algorithm>
#include <utility>

namespace cbc::lsp {
namespace {

bool has_item(const Json& list, const char* item) {
  return list.is_array() && std::find(list.begin(), list.end(), item) != list.end();
}

}  // namespace

Json find_member(const Json& value, std::initializer_list<const char*> names) {
  const Json* at = &value;
  for (const char* const name : names) {
    const auto found = at->is_object() ? at->find(name) : at->end();
    if (found == at->end()) return nullptr;
    at = &*found;
  }
  return *at;
}

Client client_of(const Json& params) {
  const Json document = find_member(params, {"capabilities", "textDocument"});
  const Json workspace = find_member(params, {"capabilities", "workspace"});
  const Json edit = find_member(workspace, {"workspaceEdit"});
  const Json encodings = find_member(params, {"capabilities", "general", "positionEncodings"});
  Client client;
  if (has_item(encodings, "utf-8")) client.encoding = Encoding::utf8;
  client.can_watch =
      find_member(workspace, {"didChangeWatchedFiles", "dynamicRegistration"}) == true;
  client.has_snippets =
      find_member(document, {"completion", "completionItem", "snippetSupport"}) == true;
  client.has_symbol_trees =
      find_member(document, {"documentSymbol", "hierarchicalDocumentSymbolSupport"}) == true;
  client.has_versioned_edits = find_member(edit, {"documentChanges"}) == true;
  client.can_create_files =
      client.has_versioned_edits && has_item(find_member(edit, {"resourceOperations"}), "create");
  client.renews_hints = find_member(workspace, {"inlayHint", "refreshSupport"}) == true;
  client.renews_lenses = find_member(workspace, {"codeLens", "refreshSupport"}) == true;
  return client;
}

Json workspace_edit(const Client& client, Json document_changes) {
  if (client.has_versioned_edits) return {{"documentChanges", std::move(document_changes)}};
  Json changes = Json::object();
  for (Json& change : document_changes) {
    const std::string uri = change.at("textDocument").at("uri");
    changes[uri] = std::move(change.at("edits"));
  }
  return {{"changes", std::move(changes)}};
}

}  // namespace cbc::lsp

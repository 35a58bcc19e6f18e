#include "lsp/server.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <sstream>
#include <thread>
#include <utility>

#include "cbc/version.h"
#include "core/support/wording.h"
#include "lsp/protocol/uri.h"

namespace cbc::lsp {
namespace {

// Error codes of the protocol.
constexpr int parse_error = -32700;
constexpr int invalid_request = -32600;
constexpr int method_not_found = -32601;
constexpr int invalid_params = -32602;
constexpr int not_initialized = -32002;
constexpr int request_cancelled = -32800;
constexpr int request_failed = -32803;

// MessageType of the protocol.
constexpr int error = 1;
constexpr int info = 3;

/// How long nobody types before findings are found.
constexpr auto pause_of_typing = std::chrono::milliseconds(100);
constexpr auto look_around_each = std::chrono::seconds(2);

std::string text_of(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Place place_of(const Json& position) {
  const auto number = [&position](const char* name) {
    const Json& value = position.at(name);
    if (!value.is_number_unsigned())
      throw Json::type_error::create(302, "expected a count", &value);
    return static_cast<std::uint32_t>(
        std::min<std::uint64_t>(value.get<std::uint64_t>(), UINT32_MAX));
  };
  return {number("line"), number("character")};
}

/// With U+FFFD for halves of characters, which a client sends while one is being typed.
std::string without_halves(std::string text) {
  const auto unit_at = [&text](std::size_t at) -> unsigned {
    unsigned unit = 0;
    const bool is_escape = at + 6 <= text.size() && text[at] == '\\' && text[at + 1] == 'u';
    if (is_escape) std::from_chars(text.data() + at + 2, text.data() + at + 6, unit, 16);
    return unit;
  };
  for (std::size_t at = text.find('\\'); at != std::string::npos; at = text.find('\\', at)) {
    const unsigned unit = unit_at(at);
    const bool is_high = unit >= 0xD800 && unit < 0xDC00;
    const unsigned next = is_high ? unit_at(at + 6) : 0;
    if (is_high && next >= 0xDC00 && next < 0xE000) {
      at += 12;
    } else if (unit >= 0xD800 && unit < 0xE000) {
      text.replace(at, 6, "\\ufffd");
      at += 6;
    } else {
      at += 2;
    }
  }
  return text;
}

/// Discarded if it is no JSON. What is nested deeper than any message is left out.
Json parse(const std::string& message) {
  constexpr int deepest = 64;
  const auto is_kept = [](int depth, Json::parse_event_t, Json&) { return depth < deepest; };
  Json parsed = Json::parse(message, is_kept, false);
  return parsed.is_discarded() ? Json::parse(without_halves(message), is_kept, false) : parsed;
}

/// The path of the document that a message is about; empty if that is no file.
std::optional<std::string> path_in(const Json& params) {
  return path_of_uri(params.at("textDocument").at("uri").get_ref<const std::string&>());
}

/// Which message an item of the inbox takes back, or null.
const Json* cancelled_by(const Json& message) {
  if (find_member(message, {"method"}) != "$/cancelRequest") return nullptr;
  const auto params = message.find("params");
  if (params == message.end() || !params->is_object()) return nullptr;
  const auto id = params->find("id");
  return id == params->end() ? nullptr : &*id;
}

}  // namespace

Server::Server(std::FILE* output) : output_(output) {
  add_requests();
  add_notifications();
}

int Server::run(int input) {
  // It may wait for input that never comes, so it is left alone at the end.
  std::thread([inbox = inbox_, input] {
    MessageReader reader(input);
    while (auto message = reader.next()) {
      Json parsed = parse(*message);
      inbox->put(std::move(parsed));
    }
    inbox->put(End{});
  }).detach();
  while (!exit_status_) {
    const bool is_quiet = Clock::now() >= quiet_since_ + pause_of_typing;
    const bool has_news = workspace_ != nullptr && workspace_->has_news();
    const Clock::time_point until = !has_news  ? Clock::now() + look_around_each
                                    : is_quiet ? Clock::now()
                                               : quiet_since_ + pause_of_typing;
    if (auto item = inbox_->take(until)) {
      if (const auto* const message = std::get_if<Json>(&*item)) {
        take(*message);
      } else if (auto* const proved = std::get_if<Proved>(&*item)) {
        take_proofs(std::move(*proved));
      } else if (const auto* const ran = std::get_if<Ran>(&*item)) {
        show(*ran);
      } else {
        exit_status_ = was_shut_down_ ? 0 : 1;
      }
    } else if (!work()) {
      look_around();
    }
  }
  proofs_.reset();
  runs_.reset();
  return *exit_status_;
}

bool Server::is_client_gone() const {
  return client_process_ > 0 && ::kill(static_cast<pid_t>(client_process_), 0) != 0 &&
         errno == ESRCH;
}

void Server::take(const Json& message) {
  if (message.is_discarded()) return refuse(nullptr, parse_error, "expected JSON");
  const Json id = find_member(message, {"id"});
  if (!id.is_null() && !id.is_string() && !id.is_number_integer()) {
    return refuse(nullptr, invalid_request, "expected a number or a text as id");
  }
  const Json method = find_member(message, {"method"});
  if (!method.is_string()) {
    const bool is_response =
        message.is_object() && (message.contains("result") || message.contains("error"));
    if (!is_response) refuse(id, invalid_request, "expected a method");
    return;
  }
  const Json params = find_member(message, {"params"});
  if (!id.is_null()) return answer(id, method.get<std::string>(), params);
  const auto found = notifications_.find(method.get<std::string>());
  const bool is_expected = workspace_ != nullptr || method == "exit";
  if (found == notifications_.end() || !is_expected) return;
  try {
    found->second(params);
  } catch (const Json::exception&) {
    // There is nobody to tell: a notification has no answer.
  }
}

void Server::answer(const Json& id, const std::string& method, const Json& params) {
  if (workspace_ == nullptr && method != "initialize") {
    return refuse(id, not_initialized, "expected 'initialize' first");
  }
  if (was_shut_down_) return refuse(id, invalid_request, "the server was shut down");
  const bool is_cancelled = inbox_->has([&id](const Item& item) {
    const Json* const message = std::get_if<Json>(&item);
    const Json* const cancelled = message == nullptr ? nullptr : cancelled_by(*message);
    return cancelled != nullptr && *cancelled == id;
  });
  if (is_cancelled) return refuse(id, request_cancelled, "cancelled");
  const auto found = requests_.find(method);
  if (found == requests_.end()) return refuse(id, method_not_found, "there is no such method");
  try {
    respond(id, found->second(params));
  } catch (const Json::exception& error) {
    refuse(id, invalid_params, error.what());
  } catch (const Refusal& refusal) {
    refuse(id, request_failed, refusal.what());
  }
}

void Server::respond(const Json& id, Json result) {
  output_.write(text_of({{"jsonrpc", "2.0"}, {"id", id}, {"result", std::move(result)}}));
}

void Server::refuse(const Json& id, int code, const std::string& message) {
  output_.write(
      text_of({{"jsonrpc", "2.0"}, {"id", id}, {"error", {{"code", code}, {"message", message}}}}));
}

void Server::notify(const std::string& method, Json params) {
  output_.write(text_of({{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(params)}}));
}

void Server::request(const std::string& method, Json params) {
  Json message = {
      {"jsonrpc", "2.0"}, {"id", "cbc-" + std::to_string(++requests_made_)}, {"method", method}};
  if (!params.is_null()) message["params"] = std::move(params);
  output_.write(text_of(message));
}

Json Server::initialize(const Json& params) {
  if (workspace_ != nullptr) throw Refusal("it is initialized already");
  client_ = client_of(params);
  workspace_ = std::make_unique<Workspace>(client_.encoding);
  proofs_ = std::make_unique<Proofs>([this](const Proofs::Job& job, CheckedCatalog proved) {
    inbox_->put(Proved{job, std::move(proved)});
  });
  runs_ = std::make_unique<CommandRuns>([this](const CommandRuns::Words& words, Filtered said) {
    inbox_->put(Ran{words, std::move(said)});
  });
  const Json process = find_member(params, {"processId"});
  if (process.is_number_integer()) client_process_ = process.get<long long>();
  const auto add_folder = [this](const Json& uri) {
    const auto path = uri.is_string() ? path_of_uri(uri.get<std::string>()) : std::nullopt;
    if (path) workspace_->add_folder(*path);
  };
  const Json folders = find_member(params, {"workspaceFolders"});
  if (folders.is_array()) {
    for (const Json& folder : folders) add_folder(find_member(folder, {"uri"}));
  } else {
    add_folder(find_member(params, {"rootUri"}));
  }
  Json capabilities = {
      {"positionEncoding", client_.encoding == Encoding::utf8 ? "utf-8" : "utf-16"},
      {"textDocumentSync", {{"openClose", true}, {"change", 2}}},
      {"completionProvider", {{"triggerCharacters", {" ", "{", "[", ","}}}},
      {"hoverProvider", true},
      {"definitionProvider", true},
      {"referencesProvider", true},
      {"documentHighlightProvider", true},
      {"documentSymbolProvider", true},
      {"foldingRangeProvider", true},
      {"codeActionProvider", {{"codeActionKinds", {"quickfix"}}}},
      {"renameProvider", {{"prepareProvider", true}}},
      {"inlayHintProvider", true},
      {"codeLensProvider", Json::object()},
      {"executeCommandProvider", {{"commands", {"cbc.run"}}}},
      {"workspace", {{"workspaceFolders", {{"supported", true}, {"changeNotifications", true}}}}}};
  return {{"capabilities", std::move(capabilities)},
          {"serverInfo", {{"name", "cbc"}, {"version", std::string(version)}}}};
}

const File* Server::file_of(const Json& params) {
  const auto path = path_in(params);
  if (!path || workspace_->find(*path) == nullptr) return nullptr;
  workspace_->check_now(*path);
  const File* const file = workspace_->find(*path);
  return file->text == nullptr ? nullptr : file;
}

const File* Server::text_of_request(const Json& params) {
  const auto path = path_in(params);
  const File* const file = path ? workspace_->find(*path) : nullptr;
  if (file == nullptr || file->text == nullptr) return nullptr;
  return workspace_->known_catalog(*file) == nullptr ? file_of(params) : file;
}

template <typename Use>
Json Server::at_cursor(const Json& params, const File* file, Json otherwise, const Use& use) {
  if (file == nullptr) return otherwise;
  return use(Cursor{*workspace_, *file, file->text->offset_of(place_of(params.at("position")))});
}

void Server::add_requests() {
  requests_["initialize"] = [this](const Json& params) { return initialize(params); };
  // For tests: whether all is found that there is to find.
  requests_["cbc/isIdle"] = [this](const Json&) {
    if (workspace_->has_news()) return Json(false);
    return Json(workspace_->next_to_prove() == nullptr);
  };
  requests_["shutdown"] = [this](const Json&) {
    was_shut_down_ = true;
    return Json();
  };
  requests_["textDocument/completion"] = [this](const Json& params) {
    return at_cursor(params, text_of_request(params), Json::array(),
                     [this](const Cursor& cursor) { return list_completions(cursor, client_); });
  };
  requests_["textDocument/hover"] = [this](const Json& params) {
    return at_cursor(params, text_of_request(params), nullptr, &find_hover);
  };
  requests_["textDocument/definition"] = [this](const Json& params) {
    return at_cursor(params, file_of(params), nullptr, &find_definition);
  };
  requests_["textDocument/references"] = [this](const Json& params) {
    const bool with_definition = find_member(params, {"context", "includeDeclaration"}) == true;
    workspace_->check_all();
    return at_cursor(params, file_of(params), Json::array(), [&](const Cursor& cursor) {
      return find_references(cursor, with_definition);
    });
  };
  requests_["textDocument/documentHighlight"] = [this](const Json& params) {
    return at_cursor(params, file_of(params), Json::array(), &find_highlights);
  };
  requests_["textDocument/prepareRename"] = [this](const Json& params) {
    return at_cursor(params, file_of(params), nullptr, &prepare_rename);
  };
  requests_["textDocument/rename"] = [this](const Json& params) {
    const auto new_name = params.at("newName").get<std::string>();
    workspace_->check_all();
    return at_cursor(params, file_of(params), nullptr, [&](const Cursor& cursor) -> Json {
      return rename(cursor, new_name, client_);
    });
  };
  requests_["textDocument/documentSymbol"] = [this](const Json& params) {
    const File* const file = text_of_request(params);
    return file == nullptr ? Json::array() : list_symbols(*file, client_);
  };
  requests_["textDocument/foldingRange"] = [this](const Json& params) {
    const File* const file = text_of_request(params);
    return file == nullptr ? Json::array() : list_folds(*file);
  };
  requests_["textDocument/codeLens"] = [this](const Json& params) {
    const File* const file = file_of(params);
    return file == nullptr ? Json::array() : list_lenses(*file);
  };
  requests_["workspace/executeCommand"] = [this](const Json& params) {
    run_command(params);
    return Json();
  };
  const auto in_range = [this](const Json& params, const auto& list) {
    const File* const file = file_of(params);
    if (file == nullptr) return Json(Json::array());
    const Json& range = params.at("range");
    return list(*workspace_, *file, file->text->offset_of(place_of(range.at("start"))),
                file->text->offset_of(place_of(range.at("end"))));
  };
  requests_["textDocument/codeAction"] = [this, in_range](const Json& params) -> Json {
    const Json kinds = find_member(params, {"context", "only"});
    const bool wants_fixes =
        !kinds.is_array() || std::any_of(kinds.begin(), kinds.end(), [](const Json& kind) {
          const auto* const name = kind.get_ptr<const std::string*>();
          return name != nullptr && (name->empty() || *name == "quickfix");
        });
    if (!wants_fixes) return Json::array();
    return in_range(params, [this](const Workspace& workspace, const File& file, std::size_t begin,
                                   std::size_t end) {
      return list_fixes(workspace, file, begin, end, client_);
    });
  };
  requests_["textDocument/inlayHint"] = [in_range](const Json& params) {
    return in_range(params, &list_hints);
  };
}

void Server::add_notifications() {
  notifications_["exit"] = [this](const Json&) { exit_status_ = was_shut_down_ ? 0 : 1; };
  notifications_["initialized"] = [this](const Json&) { begin(); };
  notifications_["textDocument/didOpen"] = [this](const Json& params) {
    const Json& document = params.at("textDocument");
    if (const auto path = path_in(params)) {
      workspace_->set_text(*path, document.at("uri").get<std::string>(),
                           document.at("version").get<std::int64_t>(),
                           document.at("text").get<std::string>());
    }
  };
  notifications_["textDocument/didChange"] = [this](const Json& params) { change_text(params); };
  notifications_["textDocument/didClose"] = [this](const Json& params) {
    const auto path = path_in(params);
    const File* const file = path ? workspace_->find(*path) : nullptr;
    if (file == nullptr) return;
    notify("textDocument/publishDiagnostics", {{"uri", file->uri}, {"diagnostics", Json::array()}});
    published_.erase(*path);
    workspace_->close(*path);
  };
  notifications_["workspace/didChangeWatchedFiles"] = [this](const Json& params) {
    for (const Json& change : params.at("changes")) {
      if (const auto path = path_of_uri(change.at("uri").get_ref<const std::string&>())) {
        workspace_->reread(*path);
      }
    }
  };
  notifications_["workspace/didChangeWorkspaceFolders"] = [this](const Json& params) {
    for (const Json& folder : params.at("event").at("removed")) {
      if (const auto path = path_of_uri(folder.at("uri").get_ref<const std::string&>())) {
        workspace_->remove_folder(*path);
      }
    }
    for (const Json& folder : params.at("event").at("added")) {
      if (const auto path = path_of_uri(folder.at("uri").get_ref<const std::string&>())) {
        workspace_->add_folder(*path);
      }
    }
  };
}

void Server::begin() {
  if (!client_.can_watch) return;
  const Json watchers = {{{"globPattern", "**/*.{yaml,yml}"}}};
  request("client/registerCapability", {{"registrations",
                                         {{{"id", "files"},
                                           {"method", "workspace/didChangeWatchedFiles"},
                                           {"registerOptions", {{"watchers", watchers}}}}}}});
}

void Server::change_text(const Json& params) {
  const Json& document = params.at("textDocument");
  const auto path = path_in(params);
  const File* const file = path ? workspace_->find(*path) : nullptr;
  if (file == nullptr || !file->version) return;
  std::string text = file->text->content();
  for (const Json& change : params.at("contentChanges")) {
    if (find_member(change, {"range"}).is_null()) {
      text = change.at("text").get<std::string>();
      continue;
    }
    const Text before(std::move(text), client_.encoding);
    const std::size_t begin = before.offset_of(place_of(change.at("range").at("start")));
    const std::size_t end = before.offset_of(place_of(change.at("range").at("end")));
    text = before.content().substr(0, begin);
    text += change.at("text").get_ref<const std::string&>();
    text += before.content().substr(std::max(begin, end));
  }
  workspace_->set_text(*path, file->uri, document.at("version").get<std::int64_t>(),
                       std::move(text));
  quiet_since_ = Clock::now();
}

/// Runs this program on saved files, beside everything else.
void Server::run_command(const Json& params) {
  auto words = params.at("arguments").at(0).get<std::vector<std::string>>();
  const bool is_known = std::any_of(words.begin(), words.end(), [&](const std::string& word) {
    const File* const file = workspace_->find(word);
    const Json lenses = file == nullptr ? Json::array() : list_lenses(*file);
    return std::any_of(lenses.begin(), lenses.end(), [&words](const Json& lens) {
      return lens.at("command").at("arguments").at(0) == words;
    });
  });
  if (params.at("command") != "cbc.run" || !is_known) throw Refusal("there is no such command");
  runs_->begin(std::move(words));
}

/// All of it in the log, and what it comes to as a message: the line of totals, or else the last
/// one.
void Server::show(const Ran& ran) {
  const std::string& text = ran.said.output.empty() ? ran.said.error_output : ran.said.output;
  std::string message = "cbc " + join(ran.words, " ");
  notify("window/logMessage", {{"type", info}, {"message", message + "\n" + text}});
  bool has_totals = false;
  std::istringstream lines(text);
  for (std::string line; !has_totals && std::getline(lines, line);) {
    has_totals = line.starts_with("expectations: ") || line.starts_with("properties: ");
    if (!line.empty()) message = line;
  }
  notify("window/showMessage", {{"type", ran.said.is_done ? info : error}, {"message", message}});
}

bool Server::work() {
  if (workspace_ == nullptr || !workspace_->has_news()) return false;
  const File& file = workspace_->next_checked();
  const bool is_gone = file.text == nullptr;
  has_old_answers_ = has_old_answers_ || is_gone || file.kind == cli::FileKind::catalog;
  publish(file);
  if (!workspace_->has_news()) {
    prove_next();
    renew_answers();
  }
  return true;
}

/// Hints and lenses of a mission change with its catalog, and a client does not know of that.
void Server::renew_answers() {
  if (!has_old_answers_) return;
  has_old_answers_ = false;
  if (client_.renews_hints) request("workspace/inlayHint/refresh", nullptr);
  if (client_.renews_lenses) request("workspace/codeLens/refresh", nullptr);
}

/// From time to time, while there is nothing to do.
void Server::look_around() {
  if (is_client_gone()) exit_status_ = 1;
  if (workspace_ == nullptr || Clock::now() < looked_at_disk_ + look_around_each) return;
  looked_at_disk_ = Clock::now();
  workspace_->look_at_disk(!client_.can_watch);
}

/// The next proofs, unless they are those that are being made.
void Server::prove_next() {
  const File* const file = workspace_->next_to_prove();
  if (file == nullptr) return proofs_->stop();
  if (proofs_->present() == file->check) return;
  const std::string path = file->path;
  const std::uint64_t check = file->check;
  const auto settings = workspace_->settings_of(path);
  if (settings) proofs_->begin({path, workspace_->find(path)->input, *settings, check});
}

void Server::take_proofs(Proved proved) {
  const File* const file =
      workspace_->add_proofs(proved.job.path, proved.job.check, std::move(proved.catalog));
  if (file != nullptr) publish(*file);
  if (!workspace_->has_news()) prove_next();
}

void Server::publish(const File& file) {
  Json diagnostics = file.is_shown() ? diagnostics_json(*workspace_, file) : Json::array();
  const bool was_published = published_.contains(file.path);
  if (diagnostics.empty() && !was_published && !file.version) return;
  if (diagnostics.empty()) {
    published_.erase(file.path);
  } else {
    published_.insert(file.path);
  }
  Json params = {{"uri", file.uri}, {"diagnostics", std::move(diagnostics)}};
  if (file.version) params["version"] = *file.version;
  notify("textDocument/publishDiagnostics", std::move(params));
}

}  // namespace cbc::lsp

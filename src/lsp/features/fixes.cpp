#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "core/catalog/older_format.h"
#include "core/catalog/renaming.h"
#include "core/check/check.h"
#include "core/check/severity_settings.h"
#include "core/diagnostic/rules.h"
#include "core/yaml/source.h"
#include "lsp/features/features.h"
#include "lsp/protocol/uri.h"

namespace cbc::lsp {
namespace {

class FixList {
 public:
  FixList(const Workspace& workspace, const File& file, std::size_t begin, std::size_t end,
          const Client& client)
      : workspace_(workspace), client_(client), file_(file), text_(file.text->content()) {
    for (const Diagnostic& finding : file.findings) {
      const std::size_t from = file.text->offset_of(finding.range.begin);
      const std::size_t to = file.text->offset_of(finding.range.end);
      if (to < begin || end < from) continue;
      add_fix(finding);
      add_conversion(finding);
      add_suggestion(finding, from, to);
      add_allowance(finding, from);
      add_setting(finding);
    }
  }

  [[nodiscard]] Json release() { return std::move(fixes_); }

 private:
  void add(const std::string& title, const Diagnostic& finding, std::string_view changed,
           bool is_preferred) {
    add_edit(title, finding, Json{{"changes", {{file_.uri, edits_json(file_, changed)}}}},
             is_preferred);
  }

  void add_edit(const std::string& title, const Diagnostic& finding, Json edit, bool is_preferred) {
    Json fix = {{"title", title},
                {"kind", "quickfix"},
                {"isPreferred", is_preferred},
                {"edit", std::move(edit)}};
    fix["diagnostics"] = {{{"range", to_json(file_.text->range_of(finding.range))},
                           {"source", "cbc"},
                           {"code", finding.rule},
                           {"message", finding.message}}};
    fixes_.push_back(std::move(fix));
  }

  /// As `cbc lint --fix` mends this finding.
  void add_fix(const Diagnostic& finding) {
    if (finding.edits.empty()) return;
    const FixedText fixed = apply_fixes(text_, {&finding, 1});
    if (!fixed.mended.empty()) {
      add(fmt::format("Fix: {}", finding.message), finding, fixed.text, true);
    }
  }

  /// A catalog of an older format, as `cbc lint --fix` converts it.
  void add_conversion(const Diagnostic& finding) {
    const bool is_meant = file_.kind == cli::FileKind::catalog && file_.is_parsed &&
                          file_.input->document != nullptr &&
                          finding.rule == rule::older_format.name;
    if (!is_meant || !find_older_format(file_.input->document->root())) return;
    const Conversion conversion = convert_older_format(*file_.input->document, text_);
    if (conversion.obstacle) return;
    add("Convert to the present format", finding, conversion.text, true);
  }

  void add_suggestion(const Diagnostic& finding, std::size_t from, std::size_t to) {
    constexpr std::string_view question = "did you mean '";
    const std::size_t found = finding.message.rfind(question);
    if (found == std::string::npos) return;
    const std::size_t begin = found + question.size();
    const std::size_t end = finding.message.find("'?", begin);
    if (end == std::string::npos) return;
    if (!stands_on_one_line(finding)) return;
    const std::string meant = finding.message.substr(begin, end - begin);
    const bool is_quoted = text_[from] == '"' || text_[from] == '\'';
    std::string changed(text_.substr(0, from));
    changed += is_quoted ? yaml::in_quotes(meant) : spell(meant);
    changed += text_.substr(to);
    add(fmt::format("Change to '{}'", meant), finding, changed, true);
  }

  /// Whether the finding is about a scalar that is written as a whole where the finding is.
  [[nodiscard]] bool stands_on_one_line(const Diagnostic& finding) const {
    if (file_.input->document == nullptr) return false;
    const std::size_t from = file_.text->offset_of(finding.range.begin);
    const std::size_t to = file_.text->offset_of(finding.range.end);
    std::string_view written = text_.substr(from, to - from);
    if (written.size() >= 2 && (written.front() == '"' || written.front() == '\'')) {
      written = written.substr(1, written.size() - 2);
    }
    const auto& nodes = file_.input->document->nodes();
    return std::any_of(nodes.begin(), nodes.end(), [&](const yaml::Node& node) {
      return node.kind == yaml::Kind::scalar && node.range.begin == finding.range.begin &&
             node.text == written;
    });
  }

  /// Whether there can be comments.
  [[nodiscard]] bool is_json() const {
    const std::size_t begin = yaml::find_content(text_, 0);
    return begin < text_.size() && (text_[begin] == '{' || text_[begin] == '[');
  }

  /// A comment at the end of the line, or one more rule in the comment that is there.
  void add_allowance(const Diagnostic& finding, std::size_t from) {
    if (is_fixed(finding) || file_.kind == cli::FileKind::settings || is_json()) return;
    if (finding.rule == rule::unused_allow.name || !stands_on_one_line(finding)) return;
    std::size_t end = yaml::end_of_line(text_, from);
    if (end > from && text_[end - 1] == '\r') --end;
    const std::size_t begin = from == 0 ? 0 : text_.rfind('\n', from - 1) + 1;
    const std::string_view line = text_.substr(begin, end - begin);
    constexpr std::string_view comment = "# cbc: allow ";
    std::string changed(text_.substr(0, end));
    if (const std::size_t place = line.find(comment); place != std::string_view::npos) {
      changed.insert(begin + place + comment.size(), fmt::format("{}, ", finding.rule));
    } else if (line.find('#') == std::string_view::npos) {
      changed += fmt::format("  {}{}", comment, finding.rule);
    } else {
      return;
    }
    changed += text_.substr(end);
    add(fmt::format("Allow {} here, by a comment", finding.rule), finding, changed, false);
  }

  /// One more rule in the settings that apply to the file, or in new ones at the top of its folder.
  void add_setting(const Diagnostic& finding) {
    if (is_fixed(finding) || file_.kind == cli::FileKind::settings) return;
    const std::string title = fmt::format("Allow {} in {}", finding.rule, settings_file_name);
    const std::string rule(finding.rule);
    const std::optional<std::string> path = workspace_.settings_file_of(file_.path);
    const File* const settings = path ? workspace_.find(*path) : nullptr;
    if (settings != nullptr && settings->text != nullptr) {
      if (const auto changed = with_rule(*settings, rule)) {
        add_edit(title, finding,
                 Json{{"changes", {{settings->uri, edits_json(*settings, *changed)}}}}, false);
      }
    } else if (!path && !file_.folder.empty() && client_.can_create_files) {
      const std::string uri =
          uri_of_path((std::filesystem::path(file_.folder) / settings_file_name).string());
      Json edits = {
          {{"range", to_json(PlaceRange{})}, {"newText", fmt::format("allow: [{}]\n", rule)}}};
      Json changes = {
          {{"kind", "create"}, {"uri", uri}, {"options", {{"ignoreIfExists", true}}}},
          {{"textDocument", {{"uri", uri}, {"version", nullptr}}}, {"edits", std::move(edits)}}};
      add_edit(title, finding, Json{{"documentChanges", std::move(changes)}}, false);
    }
  }

  /// Settings that allow one more rule; empty if it is not clear how.
  [[nodiscard]] static std::optional<std::string> with_rule(const File& settings,
                                                            const std::string& rule) {
    if (!settings.is_parsed || settings.input->document == nullptr) return std::nullopt;
    const yaml::Node& root = settings.input->document->root();
    std::string text = settings.text->content();
    if (text.find("\n...") != std::string::npos) return std::nullopt;
    for (const auto& [key, value] : root.entries) {
      if (key->text == "allow" && value->kind == yaml::Kind::null) return std::nullopt;
      for (const yaml::Node* const item : value->items) {
        if (item->text == rule) return std::nullopt;  // the settings say something else of it
      }
    }
    const yaml::Node* const allowed = root.find("allow");
    if (allowed == nullptr) {
      if (root.kind == yaml::Kind::mapping && !text.empty() &&
          text[settings.text->offset_of(root.range.begin)] == '{') {
        return std::nullopt;
      }
      if (!text.empty() && text.back() != '\n') text += '\n';
      return text + fmt::format("allow: [{}]\n", rule);
    }
    if (allowed->kind != yaml::Kind::sequence || allowed->items.empty()) return std::nullopt;
    const std::size_t list = settings.text->offset_of(allowed->range.begin);
    const std::size_t first = settings.text->offset_of(allowed->items.front()->range.begin);
    if (text[list] == '[') {
      text.insert(first, rule + ", ");
      return text;
    }
    if (text[list] != '-') return std::nullopt;
    const std::size_t begin = list == 0 ? 0 : text.rfind('\n', list) + 1;
    text.insert(begin, text.substr(begin, list - begin) + "- " + rule + "\n");
    return text;
  }

  const Workspace& workspace_;
  const Client& client_;
  const File& file_;
  const std::string_view text_;
  Json fixes_ = Json::array();
};

}  // namespace

Json list_fixes(const Workspace& workspace, const File& file, std::size_t begin, std::size_t end,
                const Client& client) {
  if (file.text == nullptr) return Json::array();
  return FixList(workspace, file, begin, end, client).release();
}

}  // namespace cbc::lsp

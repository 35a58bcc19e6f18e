#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/support/wording.h"
#include "lsp/features/features.h"

namespace cbc::lsp {
namespace {

using Words = std::vector<std::string>;

/// Seconds after which what a lens has begun ends.
constexpr const char* longest_proof = "10";

class LensList {
 public:
  explicit LensList(const File& file) : file_(file) {
    const yaml::Node& root = file.input->document->root();
    if (file.kind == cli::FileKind::script) {
      const yaml::Node* const events =
          root.kind == yaml::Kind::sequence ? &root : root.find("events");
      add("run", {"solve"}, {}, root.range);
      if (events != nullptr) add_questions(*events);
    } else if (file.kind == cli::FileKind::properties) {
      add("prove", {"verify"}, {"--time-limit", longest_proof}, root.range);
    }
  }

  [[nodiscard]] Json release() { return std::move(lenses_); }

 private:
  /// The command line is also shown, so that one can copy it.
  void add(const std::string& what, Words words, const Words& options, const Range& range) {
    Words shown = words;
    const bool names_catalog = file_.input->document->root().find("catalog") != nullptr;
    if (!names_catalog && !file_.catalog.empty()) {
      words.push_back(file_.catalog);
      shown.push_back(short_name(file_.catalog));
    }
    words.push_back(file_.path);
    shown.push_back(short_name(file_.path));
    for (const std::string& option : options) {
      words.push_back(option);
      shown.push_back(option);
    }
    const std::string title = what + ": cbc " + join(shown, " ", in_shell);
    lenses_.push_back(
        {{"range", to_json(file_.text->range_of(range))},
         {"command",
          {{"title", title}, {"command", "cbc.run"}, {"arguments", Json::array({Json(words)})}}}});
  }

  /// Why the first thing that is expected is as it is.
  void add_questions(const yaml::Node& events) {
    for (const yaml::Node* const event : events.items) {
      const yaml::Node* const expected = event->find("expect");
      if (expected == nullptr) continue;
      const yaml::Node* const running = expected->find("running");
      const yaml::Node* const active = expected->find("active");
      if (running != nullptr && !running->entries.empty()) {
        add("why", {"solve"}, {"--why", running->entries.front().first->text}, event->range);
      } else if (active != nullptr && !active->items.empty()) {
        add("why", {"solve"}, {"--why", active->items.front()->text}, event->range);
      }
    }
  }

  [[nodiscard]] std::string short_name(const std::string& path) const {
    if (file_.folder.empty()) return path;
    const std::string name = std::filesystem::path(path).lexically_relative(file_.folder).string();
    return name.starts_with('-') ? "./" + name : name;  // it is no option
  }

  const File& file_;
  Json lenses_ = Json::array();
};

}  // namespace

Json list_lenses(const File& file) {
  if (!file.path.starts_with('/')) return Json::array();  // no program could read it
  if (file.input == nullptr || file.input->document == nullptr) return Json::array();
  return LensList(file).release();
}

}  // namespace cbc::lsp

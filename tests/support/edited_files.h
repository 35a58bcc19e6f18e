#pragma once

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/catalog/catalog.h"
#include "core/catalog/reader.h"
#include "core/diagnostic/diagnostic.h"
#include "core/files/recognition.h"
#include "core/yaml/document.h"
#include "lsp/language/context.h"
#include "support/read_file.h"

/// Texts for tests of what an editor is told.
namespace cbc::test {

/// The place of the character '|', which is no part of the text.
[[nodiscard]] inline lsp::Context context_at_mark(std::string text) {
  const std::size_t cursor = text.find('|');
  text.erase(cursor, 1);
  return lsp::context_at(text, cursor);
}

/// A file that people write.
struct EditedFile {
  std::string path;
  std::string text;
  cli::FileKind kind = cli::FileKind::other;
  std::unique_ptr<const yaml::Document> document;
};

/// Those of the project.
[[nodiscard]] inline const std::vector<EditedFile>& edited_files() {
  static const std::vector<EditedFile> files = [] {
    std::vector<EditedFile> found;
    for (const char* const folder : {"/catalogs", "/docs", "/src/init/files"}) {
      for (const auto& entry :
           std::filesystem::recursive_directory_iterator(CBC_SOURCE_DIR + std::string(folder))) {
        if (entry.path().extension() != ".yaml") continue;
        EditedFile file{entry.path(), read_file(entry.path()), cli::FileKind::other, nullptr};
        Diagnostics ignored;
        file.document = yaml::parse(file.text, file.path, ignored);
        file.kind = cli::recognize(file.path, file.text, file.document.get()).kind;
        found.push_back(std::move(file));
      }
    }
    std::sort(found.begin(), found.end(),
              [](const EditedFile& a, const EditedFile& b) { return a.path < b.path; });
    return found;
  }();
  return files;
}

/// A small catalog with all that the language has.
inline constexpr const char* robot_text =
    "behaviors:\n"
    "- {behavior: FLY_FAST, task: FLY, suitability: 90, requires: [{task: SEE, "
    "minimum_performance: "
    "50}],\n"
    "   situation: {LIGHT: [day, dusk], WIND: false}, timeout: 4.5, package: wings}\n"
    "- {behavior: FLY_SLOWLY, task: FLY, suitability: 60}\n"
    "- {behavior: LOOK, task: SEE}\n"
    "- {behavior: 'yes', task: 'a: b'}\n"
    "tasks:\n"
    "- {task: FLY, timeout: 30, minimum_performance: 20, parameters: [{parameter: speed, "
    "allowed_values: [0, 30]},\n"
    "   {parameter: side, allowed_values: [left, right]}, {parameter: hard, allowed_values: "
    "boolean}]}\n"
    "- {task: SEE, start_on_request: false, execution_goal: keep_running}\n"
    "- {task: LAND, reactive_start: true, start_on_request: false}\n"
    "exclusivity_constraints:\n"
    "- {mutually_exclusive: [FLY, LAND]}\n"
    "situation:\n"
    "- {variable: LIGHT, values: [day, dusk, night]}\n"
    "- {variable: WIND}\n";

[[nodiscard]] inline const Catalog& robot() {
  static const Catalog catalog = [] {
    Diagnostics ignored;
    return *read_catalog(robot_text, "robot.yaml", ignored);
  }();
  return catalog;
}

}  // namespace cbc::test

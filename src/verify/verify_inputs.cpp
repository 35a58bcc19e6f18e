#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/core.h>

#include "core/files/input.h"
#include "core/files/output.h"
#include "core/property/property_reader.h"
#include "coverage/engine/goal_proof.h"
#include "runtime/base/text.h"
#include "verify/verify.h"

namespace cbc::cli {

StatedAssumptions goal_assumptions(const VerifyQuestions& questions) {
  if (questions.files.empty()) return {assumptions_of_goals(*questions.catalog), {}};
  return {questions.files.front()->assumptions, questions.files.front()->path};
}

std::string catalog_from(const std::string& folder, const VerifyOptions& options,
                         const VerifyQuestions& questions) {
  const std::string catalog = questions.named_catalog.value_or(options.paths.front());
  if (catalog == "-") return {};
  // Of a folder that does not exist yet, a relative path would stay one.
  std::error_code error;
  const std::filesystem::path path = std::filesystem::proximate(
      std::filesystem::absolute(catalog), std::filesystem::absolute(folder), error);
  return error ? std::string{} : path.generic_string();
}

std::optional<VerifyQuestions> QuestionLoader::load(const std::vector<std::string>& paths,
                                                    const std::optional<std::string>& old_catalog,
                                                    const std::vector<std::string>& beside,
                                                    const std::optional<std::string>& left_out) {
  catalogs_.keep_sources();
  add_first(paths.front());
  for (std::size_t place = 1; place < paths.size(); ++place) add_path(paths[place]);
  if (old_catalog) {
    questions_.old_catalog = catalogs_.load(*old_catalog);
    if (questions_.old_catalog == nullptr) has_failed_ = true;
  }
  files_.print_findings();
  if (has_failed_) return std::nullopt;
  questions_.source = catalogs_.source_of(*questions_.catalog);
  MissionLoader missions;
  std::optional<std::vector<Mission>> loaded =
      missions.load_for(questions_.catalog, beside, left_out);
  if (!loaded) return std::nullopt;
  questions_.beside = std::move(*loaded);
  return std::move(questions_);
}

void QuestionLoader::add_first(const std::string& path) {
  const std::optional<InputFile> first = files_.read(path);
  if (first && first->document != nullptr) {
    if (is_property_file(*first->document)) return add_properties(path, *first->document);
    if (is_script(*first->document)) {
      return refuse(path, "is a script; expected a catalog or a property file here");
    }
  }
  is_given_ = true;
  if (first) questions_.catalog = catalogs_.load(*first);
  has_failed_ = questions_.catalog == nullptr;
}

void QuestionLoader::add_path(const std::string& path) {
  const std::optional<InputFile> file = files_.read(path);
  if (!file) {
    has_failed_ = true;
  } else if (file->document == nullptr || is_catalog(*file->document)) {
    refuse(path, "is a catalog; expected a property file here (a catalog goes first)");
  } else if (is_script(*file->document)) {
    refuse(path, "is a script; expected a property file here");
  } else {
    add_properties(path, *file->document);
  }
}

void QuestionLoader::refuse(const std::string& path, const char* what) {
  complain("{} {}", quote(display_name(path)), what);
  has_failed_ = true;
}

void QuestionLoader::add_properties(const std::string& path, const yaml::Document& document) {
  if (!find_catalog(path, document)) {
    has_failed_ = true;
    return;
  }
  Diagnostics diagnostics;
  std::optional<PropertyFile> file = read_properties(document, *questions_.catalog, diagnostics);
  if (files_.take_findings(path, document, std::move(diagnostics), file.has_value()) && file) {
    questions_.files.push_back(std::make_unique<const PropertyFile>(std::move(*file)));
  } else {
    has_failed_ = true;
  }
}

/// Whether there is a usable catalog for this property file.
bool QuestionLoader::find_catalog(const std::string& path, const yaml::Document& document) {
  if (is_given_) return questions_.catalog != nullptr;
  const std::optional<NamedCatalog> named = catalog_named_by(path, document);
  if (!named) {
    complain(
        "property file {} names no catalog, and none is given; give one on the command line, or "
        "write 'catalog: FILE' into it",
        quote(display_name(path)));
    return false;
  }
  if (!questions_.named_catalog) {
    questions_.named_catalog = named->path;
    questions_.catalog = catalogs_.load(*named);
  } else if (named->path != *questions_.named_catalog &&
             !is_same_file(*questions_.named_catalog, named->path)) {
    complain("{}: this property file is about another catalog, {}, than those before it, {}",
             named->place, quote(named->path), quote(*questions_.named_catalog));
    return false;
  }
  return questions_.catalog != nullptr;
}

}  // namespace cbc::cli

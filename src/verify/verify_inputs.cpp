#include <memory>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "core/files/input.h"
#include "core/files/output.h"
#include "core/property/property_reader.h"
#include "runtime/base/text.h"
#include "verify/verify.h"

namespace cbc::cli {

std::optional<VerifyQuestions> QuestionLoader::load(const std::vector<std::string>& paths,
                                                    const std::optional<std::string>& old_catalog) {
  add_first(paths.front());
  for (std::size_t place = 1; place < paths.size(); ++place) add_path(paths[place]);
  if (old_catalog) {
    questions_.old_catalog = catalogs_.load(*old_catalog);
    if (questions_.old_catalog == nullptr) has_failed_ = true;
  }
  files_.print_findings();
  if (has_failed_) return std::nullopt;
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
  if (!named_catalog_) {
    named_catalog_ = named->path;
    questions_.catalog = catalogs_.load(*named);
  } else if (named->path != *named_catalog_ && !is_same_file(*named_catalog_, named->path)) {
    complain("{}: this property file is about another catalog, {}, than those before it, {}",
             named->place, quote(named->path), quote(*named_catalog_));
    return false;
  }
  return questions_.catalog != nullptr;
}

}  // namespace cbc::cli

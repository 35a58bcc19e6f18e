#include "core/files/question_loader.h"

#include <cstddef>
#include <utility>

#include "core/files/output.h"
#include "core/property/property_reader.h"
#include "core/support/system.h"
#include "runtime/base/text.h"

namespace cbc::cli {

std::optional<CheckedInput> QuestionLoader::load(const std::vector<std::string>& paths,
                                                 const std::optional<std::string>& old_catalog) {
  add_first(paths.front());
  for (std::size_t place = 1; place < paths.size(); ++place) add_path(paths[place]);
  if (old_catalog) {
    if (const auto catalog = files_.load(*old_catalog)) input_.old_catalog = catalog->compiled;
    if (input_.old_catalog == nullptr) has_failed_ = true;
  }
  files_.print_findings();
  if (has_failed_) return std::nullopt;
  return std::move(input_);
}

void QuestionLoader::add_first(const std::string& path) {
  const auto first = files_.read(path);
  if (first && first->is(FileKind::properties)) return add_properties(*first);
  if (first && first->is(FileKind::script)) {
    return refuse(*first, "is a script; expected a catalog or a property file here");
  }
  is_given_ = true;
  if (first) take_catalog(files_.load(*first));
  has_failed_ = input_.catalog == nullptr;
}

void QuestionLoader::add_path(const std::string& path) {
  const auto file = files_.read(path);
  if (!file) {
    has_failed_ = true;
  } else if (file->is(FileKind::catalog) || file->is(FileKind::compiled)) {
    refuse(*file, "is a catalog; expected a property file here (a catalog goes first)");
  } else if (file->is(FileKind::script)) {
    refuse(*file, "is a script; expected a property file here");
  } else {
    add_properties(*file);
  }
}

void QuestionLoader::refuse(const InputFile& file, const char* what) {
  complain("{} {}", quote(file.name), what);
  has_failed_ = true;
}

void QuestionLoader::take_catalog(const std::shared_ptr<const CheckedCatalog>& catalog) {
  if (catalog != nullptr && catalog->compiled != nullptr) input_.catalog = catalog;
}

void QuestionLoader::add_properties(const InputFile& file) {
  std::optional<PropertyFile> properties;
  if (find_catalog(file)) properties = files_.read_properties(file, *input_.catalog->compiled);
  if (properties && lacks_properties(*file.document, *properties)) {
    return refuse(file, "has no property, so there is nothing to prove");
  }
  if (properties) {
    input_.files.push_back(std::make_unique<const PropertyFile>(std::move(*properties)));
  } else {
    has_failed_ = true;
  }
}

/// Whether there is a usable catalog for this property file.
bool QuestionLoader::find_catalog(const InputFile& file) {
  if (is_given_) return input_.catalog != nullptr;
  const std::optional<NamedCatalog> named = FileSet::expect_catalog(file);
  if (!named) return false;
  if (!named_catalog_) {
    named_catalog_ = named->path;
    take_catalog(files_.load(*named));
  } else if (named->path != *named_catalog_ && !is_same_file(*named_catalog_, named->path)) {
    complain("{}: this property file is about another catalog, {}, than those before it, {}",
             named->place, quote(named->path), quote(*named_catalog_));
    return false;
  }
  return input_.catalog != nullptr;
}

}  // namespace cbc::cli

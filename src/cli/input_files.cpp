#include "cli/input_files.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "cli/file_kind.h"
#include "cli/findings.h"
#include "cli/input.h"
#include "lint/controls.h"
#include "text/quote.h"

namespace cbc::cli {

std::optional<InputFile> InputFiles::read(const std::string& path) {
  std::optional<CatalogInput> input = read_catalog_input(path);
  if (!input) return std::nullopt;
  if (input->is_compiled) return InputFile{path, nullptr, std::move(*input)};
  const std::string name = display_name(path);
  const auto entry = texts_.insert_or_assign(name, std::move(input->content)).first;
  Diagnostics diagnostics;
  auto document = yaml::parse(entry->second, name, diagnostics);
  for (Diagnostic& finding : diagnostics.release()) findings_.push_back(std::move(finding));
  if (document == nullptr) return std::nullopt;
  return InputFile{path, std::move(document), {}};
}

std::optional<InputFile> InputFiles::read_catalog(const std::string& path) {
  std::optional<InputFile> file = read(path);
  if (file && file->document != nullptr && is_script(*file->document)) {
    complain(fmt::format("{} is a script; expected a catalog here", quote(display_name(path))));
    return std::nullopt;
  }
  return file;
}

bool InputFiles::take_findings(const std::string& path, const yaml::Document& document,
                               Diagnostics diagnostics) {
  const std::optional<SeveritySettings> settings = settings_.find(path);
  if (!settings) return false;
  // Not all rules are looked at here, so that none of the comments can be called unused.
  const CommentedFile file{document.file(), text_of(document), &document, false};
  bool has_errors = false;
  for (Diagnostic& finding : control_findings(diagnostics.release(), file, *settings)) {
    has_errors |= finding.severity == Severity::error;
    findings_.push_back(std::move(finding));
  }
  return !has_errors;
}

void InputFiles::print_findings() {
  std::stable_sort(findings_.begin(), findings_.end(),
                   [](const Diagnostic& a, const Diagnostic& b) { return a.file < b.file; });
  cli::print_findings(findings_, texts_);
}

}  // namespace cbc::cli

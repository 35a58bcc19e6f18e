#include "cli/linter.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "catalog/same_meaning.h"
#include "cli/file_kind.h"
#include "cli/input.h"
#include "compiled/compile.h"
#include "file/atomic_file.h"
#include "lint/controls.h"
#include "lint/fixes.h"
#include "script/reader.h"
#include "text/line_diff.h"
#include "text/quote.h"

namespace cbc::cli {
namespace {

namespace fs = std::filesystem;

std::size_t count(const LintedFile& file, Severity severity) {
  return static_cast<std::size_t>(std::count_if(
      file.findings.begin(), file.findings.end(),
      [severity](const Diagnostic& finding) { return finding.severity == severity; }));
}

}  // namespace

Linter::Linter(Options options) : options_(std::move(options)), settings_(options_.settings) {}

void Linter::lint_catalog(const std::string& path) {
  std::optional<std::string> text = read_input(path);
  if (!text) {
    has_failed_ = true;
    return;
  }
  lint_catalog_text(path, std::move(*text));
}

void Linter::lint_if_catalog(const std::string& path) {
  std::optional<std::string> text = read_input(path);
  if (!text) {
    has_failed_ = true;
  } else if (looks_like_catalog(*text)) {
    lint_catalog_text(path, std::move(*text));
  }
}

void Linter::lint_catalog_text(const std::string& path, std::string text) {
  const std::optional<SeveritySettings> settings =
      settings_.find(path == "-" ? name_of(path) : path);
  if (!settings) {
    has_failed_ = true;
    return;
  }
  Linted linted = lint_text(name_of(path), std::move(text), *settings);
  if (linted.is_script) {
    lint_script_text(path, std::move(linted.file.text), "");
    return;
  }
  if (options_.is_to_fix && !fix(path, linted, *settings)) has_failed_ = true;
  catalogs_.insert_or_assign(path, linted.compiled);
  add(std::move(linted.file), *settings);
}

Linter::Linted Linter::lint_text(const std::string& name, std::string text,
                                 const SeveritySettings& settings) const {
  Linted linted;
  linted.file.file = name;
  linted.file.text = std::move(text);
  Diagnostics diagnostics;
  CommentedFile commented{name, linted.file.text, nullptr, false};
  const auto document = yaml::parse(linted.file.text, name, diagnostics);
  if (document != nullptr) {
    linted.is_script = is_script(*document);
    LintResult result = cbc::lint_catalog(*document, options_.lint, diagnostics);
    commented.document = document.get();
    commented.is_complete = result.summary.has_value();
    if (result.summary) {
      linted.compiled = std::make_shared<const CompiledCatalog>(compile(result.reading.catalog));
    }
    linted.file.summary = std::move(result.summary);
    linted.catalog = std::move(result.reading.catalog);
  }
  linted.file.findings = control_findings(diagnostics.release(), commented, settings);
  return linted;
}

/// Mends what can be mended. False if the result could not be written.
bool Linter::fix(const std::string& path, Linted& linted, const SeveritySettings& settings) {
  const std::string before = linted.file.text;
  std::size_t mended = 0;
  // What is mended may uncover more; each round makes the text say less twice, so it comes to an
  // end.
  for (;;) {
    FixedText fixed = apply_fixes(linted.file.text, linted.file.findings);
    if (fixed.mended.empty()) break;
    Linted next = lint_text(linted.file.file, std::move(fixed.text), settings);
    if (!same_meaning(linted.catalog, next.catalog) ||
        count(linted.file, Severity::error) != count(next.file, Severity::error)) {
      complain(fmt::format("{}: internal error: a fix would change the meaning; nothing is written",
                           quote(linted.file.file)));
      return false;
    }
    mended += fixed.mended.size();
    linted = std::move(next);
  }
  if (mended == 0) return true;
  if (options_.is_to_show_fixes) {
    diff_ += unified_diff(before, linted.file.text, linted.file.file);
    return true;
  }
  if (const auto error = write_atomically(path, linted.file.text)) {
    complain(fmt::format("cannot write {}: {}", quote(path), *error));
    return false;
  }
  complain(fmt::format("{}: {} {} mended", printable(linted.file.file), mended,
                       mended == 1 ? "finding" : "findings"));
  return true;
}

void Linter::lint_script(const std::string& path, const std::string& catalog) {
  std::optional<std::string> text = read_input(path);
  if (!text) {
    has_failed_ = true;
    return;
  }
  lint_script_text(path, std::move(*text), catalog);
}

void Linter::lint_script_text(const std::string& path, std::string text,
                              const std::string& catalog) {
  LintedFile file;
  file.file = name_of(path);
  file.text = std::move(text);
  const std::optional<SeveritySettings> settings = settings_.find(path == "-" ? file.file : path);
  Diagnostics diagnostics;
  const auto document = yaml::parse(file.text, file.file, diagnostics);
  CommentedFile commented{file.file, file.text, document.get(), false};
  if (document != nullptr) {
    const CatalogPointer compiled = catalog_of(path, *document, catalog);
    if (compiled == nullptr) return;
    const auto script = read_script(*document, names_of(*compiled), Severity::error, diagnostics);
    commented.is_complete = script.has_value();
  }
  if (!settings) {
    has_failed_ = true;
    return;
  }
  file.findings = control_findings(diagnostics.release(), commented, *settings);
  add(std::move(file), *settings);
}

/// The catalog that a script runs on; nullptr if there is none that is good, which is complained
/// of.
Linter::CatalogPointer Linter::catalog_of(const std::string& path, const yaml::Document& script,
                                          const std::string& given) {
  std::string catalog = given;
  if (const auto named = catalog_of_script(script); catalog.empty() && named) {
    catalog = (fs::path(path).parent_path() / *named).lexically_normal().string();
  }
  if (catalog.empty()) {
    complain(
        fmt::format("{} is an event script that names no catalog; give one: "
                    "cbc lint --script SCRIPT CATALOG",
                    quote(script.file())));
    has_failed_ = true;
    return nullptr;
  }
  const bool is_linted = catalogs_.contains(catalog);
  CatalogPointer compiled = catalog_at(catalog);
  if (compiled == nullptr) {
    complain(fmt::format("script {} is not checked, as its catalog {} has errors",
                         quote(script.file()), quote(catalog)));
    // The errors of a catalog that was linted are findings.
    if (!is_linted) has_failed_ = true;
  }
  return compiled;
}

/// The catalog of a script: one that was linted, or else it is read.
Linter::CatalogPointer Linter::catalog_at(const std::string& path) {
  const auto [entry, is_new] = catalogs_.try_emplace(path, nullptr);
  if (!is_new) return entry->second;
  Diagnostics diagnostics;  // of a file that nobody asked about
  const std::optional<std::string> text = read_input(path);
  const auto document = text ? yaml::parse(*text, path, diagnostics) : nullptr;
  if (document == nullptr) return nullptr;
  const CatalogReading reading = understand_catalog(*document, diagnostics);
  if (reading.is_complete && reading.is_acyclic) {
    entry->second = std::make_shared<const CompiledCatalog>(compile(reading.catalog));
  }
  return entry->second;
}

void Linter::add(LintedFile file, const SeveritySettings& settings) {
  has_found_ |= count(file, Severity::error) > 0 ||
                (settings.is_strict() && count(file, Severity::warning) > 0);
  files_.push_back(std::move(file));
}

std::string Linter::name_of(const std::string& path) const {
  return path == "-" && !options_.stdin_filename.empty() ? options_.stdin_filename
                                                         : display_name(path);
}

}  // namespace cbc::cli

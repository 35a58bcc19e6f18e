#include "cli/linter.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "catalog/same_meaning.h"
#include "cli/exit_status.h"
#include "cli/file_kind.h"
#include "cli/input.h"
#include "cli/named_catalog.h"
#include "cli/output.h"
#include "compiled/compile.h"
#include "lint/controls.h"
#include "lint/fixes.h"
#include "script/reader.h"
#include "text/line_diff.h"
#include "text/quote.h"

namespace cbc::cli {
namespace {

void complain_of_catalog(const std::string& name) {
  complain(fmt::format("{} is a catalog; expected an event script", quote(name)));
}

}  // namespace

Linter::Linter(Options options) : options_(std::move(options)), settings_(options_.settings) {}

void Linter::lint_catalog(const std::string& path) {
  std::optional<CatalogInput> input = read_catalog_input(path);
  if (!input) {
    has_failed_ = true;
    catalogs_.insert_or_assign(path, nullptr);
  } else if (input->is_compiled) {
    take_compiled(*input);
  } else {
    lint_catalog_text(path, std::move(input->content));
  }
}

bool Linter::lint_if_catalog(const std::string& path) {
  std::optional<CatalogInput> input = read_catalog_input(path);
  if (!input) {
    has_failed_ = true;
    return false;
  }
  if (input->is_compiled || !looks_like_catalog(input->content)) return false;
  lint_catalog_text(path, std::move(input->content));
  return true;
}

/// A compiled catalog has no text to find mistakes in.
void Linter::take_compiled(const CatalogInput& input) {
  std::optional<CompiledFile> file;
  if (options_.is_to_fix || !(options_.is_to_summarize || options_.has_scripts)) {
    complain(fmt::format("{} is a compiled catalog; expected YAML (--summary takes either)",
                         quote(name_of(input.path))));
  } else {
    file = load(input);
  }
  CatalogPointer& catalog = catalogs_[input.path];
  if (!file) {
    has_failed_ = true;
    return;
  }
  catalog = std::make_shared<const CompiledCatalog>(std::move(file->catalog));
  if (options_.is_to_summarize) {
    files_.push_back({name_of(input.path), {}, {}, summarize(*catalog), false});
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
  if (options_.is_to_fix) fix(path, linted, *settings);
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
    if (linted.is_script) return linted;
    LintResult result = cbc::lint_catalog(*document, options_.lint, diagnostics);
    commented.document = document.get();
    commented.is_complete = result.compiled.has_value();
    if (result.compiled) {
      linted.file.summary = summarize(*result.compiled);
      linted.compiled = std::make_shared<const CompiledCatalog>(std::move(*result.compiled));
    }
    linted.catalog = std::move(result.reading.catalog);
  }
  linted.errors = diagnostics.count(Severity::error);
  linted.file.findings = control_findings(diagnostics.release(), commented, settings);
  return linted;
}

/// Mends what can be mended. If the result cannot be written, all stays as it was.
void Linter::fix(const std::string& path, Linted& linted, const SeveritySettings& settings) {
  Linted fixed;
  fixed.file = linted.file;
  fixed.catalog = linted.catalog;
  std::size_t mended = 0;
  // What is mended may uncover more; each round makes the text say less twice, so it comes to an
  // end.
  for (;;) {
    FixedText text = apply_fixes(fixed.file.text, fixed.file.findings);
    if (text.mended.empty()) break;
    mended += text.mended.size();
    fixed = lint_text(linted.file.file, std::move(text.text), settings);
  }
  if (mended == 0) return;
  if (!same_meaning(linted.catalog, fixed.catalog) || fixed.errors > linted.errors) {
    complain(
        fmt::format("internal error: mending {} would change its meaning, so nothing is "
                    "written; please report it with the file",
                    quote(linted.file.file)));
    has_internal_error_ = true;
    return;
  }
  if (options_.is_to_show_fixes) {
    diff_ += unified_diff(linted.file.text, fixed.file.text, linted.file.file);
  } else if (!write_fixed(path, linted.file.text, fixed.file.text)) {
    has_failed_ = true;
    return;
  } else {
    has_mended_ = true;
    complain(fmt::format("{}: {} {} mended", printable(linted.file.file), mended,
                         mended == 1 ? "finding" : "findings"));
  }
  linted = std::move(fixed);
}

bool Linter::write_fixed(const std::string& path, const std::string& before,
                         const std::string& after) {
  const std::optional<std::string> now = read_input(path);
  if (!now) return false;
  if (*now != before) {
    complain(fmt::format("{} has changed meanwhile; it is left as it is", quote(path)));
    return false;
  }
  return write_output(path, after) == exit_ok;
}

void Linter::lint_script(const std::string& path, const std::string& catalog) {
  std::optional<CatalogInput> input = read_catalog_input(path);
  if (!input) {
    has_failed_ = true;
  } else if (input->is_compiled) {
    complain_of_catalog(name_of(path));
    has_failed_ = true;
  } else {
    lint_script_text(path, std::move(input->content), catalog);
  }
}

void Linter::lint_script_text(const std::string& path, std::string text,
                              const std::string& catalog) {
  LintedFile file;
  file.is_script = true;
  file.file = name_of(path);
  file.text = std::move(text);
  const std::optional<SeveritySettings> settings = settings_.find(path == "-" ? file.file : path);
  Diagnostics diagnostics;
  const auto document = yaml::parse(file.text, file.file, diagnostics);
  CommentedFile commented{file.file, file.text, document.get(), false};
  if (document != nullptr && is_catalog(*document)) {
    complain_of_catalog(file.file);
    has_failed_ = true;
    return;
  }
  if (document != nullptr) {
    const CatalogPointer compiled = catalog_of(*document, catalog);
    if (compiled == nullptr) return;
    const auto script = read_script(*document, *compiled, Severity::error, diagnostics);
    // Findings that may be allowed do not keep a script from being understood.
    commented.is_complete =
        script || std::none_of(diagnostics.all().begin(), diagnostics.all().end(), is_fixed);
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
Linter::CatalogPointer Linter::catalog_of(const yaml::Document& script, const std::string& given) {
  const std::string catalog =
      given.empty() ? path_of_catalog(script.file(), script).value_or("") : given;
  if (catalog.empty()) {
    complain(
        fmt::format("{} is an event script that names no catalog; give one: "
                    "cbc lint --script {} CATALOG",
                    quote(script.file()), printable(script.file())));
    has_failed_ = true;
    return nullptr;
  }
  const bool is_linted = catalogs_.contains(catalog);
  CatalogPointer compiled = catalog_at(catalog);
  if (compiled == nullptr) {
    complain(
        fmt::format("script {} is not checked, as its catalog {} cannot be used; "
                    "'cbc lint' says why",
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
  const std::optional<CatalogInput> input = read_catalog_input(path);
  if (!input) return nullptr;
  if (input->is_compiled) {
    if (std::optional<CompiledFile> file = load(*input)) {
      entry->second = std::make_shared<const CompiledCatalog>(std::move(file->catalog));
    }
    return entry->second;
  }
  Diagnostics diagnostics;  // of a file that nobody asked about
  const auto document = yaml::parse(input->content, path, diagnostics);
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

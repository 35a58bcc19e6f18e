#include <map>
#include <utility>

#include <fmt/core.h>

#include "core/command_line/limits.h"
#include "core/compile/compile.h"
#include "core/files/ordered_work.h"
#include "core/files/output.h"
#include "core/files/replace.h"
#include "core/files/unified_diff.h"
#include "core/property/property_reader.h"
#include "core/script/reader.h"
#include "rename/engine/proof.h"
#include "rename/rename.h"
#include "rename/report/rename_text.h"
#include "runtime/base/text.h"

namespace cbc::cli {
namespace {

/// A file with the new name.
struct ChangedFile {
  const NamedFile* before = nullptr;
  std::string text;
  std::size_t places = 0;
};

/// A new text is understood as the old one was, or a message says why not.
class Recheck {
 public:
  explicit Recheck(const Renaming& renaming) : renaming_(renaming) {}

  /// Catalogs come before the files that are about them. Returns the exit status.
  [[nodiscard]] int check(const ChangedFile& changed) {
    const NamedFile& before = *changed.before;
    Diagnostics diagnostics;
    const auto document = yaml::parse(changed.text, before.file->name, diagnostics);
    std::vector<NamePlace> names;
    const bool is_same =
        document != nullptr && read(before, *document, changed.text, names, diagnostics);
    if (diagnostics.count(Severity::error) > 0) {
      diagnostics.sort();
      print_findings(diagnostics.all(),
                     {{before.file->name, std::make_shared<const std::string>(changed.text)}});
      return complain("with the name {} the file {} would have these errors; nothing is changed",
                      quote(renaming_.new_name), quote(before.file->name));
    }
    // The settings say nothing about where other names stand.
    if (before.kind == NamedFile::Kind::settings) names = before.names;
    if (is_same && differ_only_in_name({*before.file->document, before.names}, {*document, names},
                                       renaming_)) {
      return exit_ok;
    }
    complain(
        "internal error: renaming in {} would change its meaning, so nothing is changed; "
        "please report it with the file",
        quote(before.file->name));
    return exit_internal;
  }

  /// The catalog with the new name, in place of the one with the old name.
  [[nodiscard]] const CompiledCatalog& renamed(const CheckedCatalog& before) const {
    return *compiled_.at(&before);
  }

 private:
  /// Whether the meaning is the same, as far as that is known without comparing all values.
  bool read(const NamedFile& before, const yaml::Document& document, const std::string& text,
            std::vector<NamePlace>& names, Diagnostics& diagnostics) {
    switch (before.kind) {
      case NamedFile::Kind::catalog: {
        CatalogReading reading = understand_catalog(document, diagnostics);
        if (diagnostics.count(Severity::error) > 0) return false;
        names = std::move(reading.names);
        compiled_[before.catalog.get()] =
            std::make_shared<const CompiledCatalog>(compile(reading.catalog));
        return same_meaning(with_new_name(before.catalog->reading.catalog, renaming_),
                            reading.catalog);
      }
      case NamedFile::Kind::script:
        return read_script(document, renamed(*before.catalog), Severity::warning, diagnostics,
                           nullptr, &names)
            .has_value();
      case NamedFile::Kind::properties:
        return read_properties(document, renamed(*before.catalog), diagnostics, &names).has_value();
      case NamedFile::Kind::settings:
        break;
    }
    return read_settings(text, before.file->name, diagnostics).has_value();
  }

  const Renaming& renaming_;
  std::map<const CheckedCatalog*, std::shared_ptr<const CompiledCatalog>> compiled_;
};

class Call {
 public:
  explicit Call(const RenameCommand& command) : command_(command) {
    for (const NameKind kind : {NameKind::task, NameKind::behavior, NameKind::variable}) {
      if (name_of(kind) == command.kind) renaming_.kind = kind;
    }
    renaming_.old_name = command.old_name;
    renaming_.new_name = command.new_name;
  }

  int run() {
    const std::string fault = fault_of_new_name(renaming_);
    if (!fault.empty()) return usage_error("rename", fault);
    const auto files = NamedFiles(renaming_).load(command_.paths);
    if (!files) return exit_unusable;
    if (const int status = change(*files); status != exit_ok) return status;
    if (const int status = prove(*files); status != exit_ok) return status;
    return command_.diff ? show() : write();
  }

 private:
  /// Makes the new texts, and checks them.
  int change(const std::vector<NamedFile>& files) {
    for (const NamedFile& file : files) {
      RenamedText renamed =
          rename_in(*file.file->text, *file.file->document, file.names, renaming_);
      if (renamed.obstacle) {
        return complain("{}: {}",
                        format_place(printable(file.file->name), renamed.obstacle->range.begin),
                        renamed.obstacle->message);
      }
      ChangedFile changed{&file, std::move(renamed.text), renamed.places};
      if (const int status = recheck_.check(changed); status != exit_ok) return status;
      if (changed.places > 0) changed_.push_back(std::move(changed));
    }
    return exit_ok;
  }

  /// Compares each catalog with what it was.
  int prove(const std::vector<NamedFile>& files) {
    Budget budget = StateLimits{}.budget();
    budget.max_states = command_.max_states;
    for (const NamedFile& file : files) {
      if (file.kind != NamedFile::Kind::catalog) continue;
      ReportedProof& proof = proofs_.emplace_back();
      proof.catalog = file.file->name;
      proof.max_states = command_.max_states;
      proof.comparison = compare_renamed(*file.catalog->compiled, recheck_.renamed(*file.catalog),
                                         renaming_, budget, thread_count(std::nullopt));
      if (proof.comparison.result != Verdict::Result::violated) continue;
      complain(
          "internal error: with the new name {} would decide differently, so nothing is "
          "changed; please report it with the file",
          quote(file.file->name));
      return exit_internal;
    }
    return exit_ok;
  }

  int show() const {
    for (const ChangedFile& changed : changed_) {
      const InputFile& file = *changed.before->file;
      const auto diff = unified_diff(*file.text, changed.text, file.name);
      if (!diff) return exit_unusable;
      fmt::print("{}", *diff);
    }
    fmt::print(stderr, "{}", report(false, style_for(stderr)));
    return exit_ok;
  }

  int write() const {
    std::vector<Replacement> replacements;
    for (const ChangedFile& changed : changed_) {
      const InputFile& file = *changed.before->file;
      replacements.push_back({file.path, file.text, changed.text});
    }
    if (const int status = replace_inputs(replacements); status != exit_ok) return status;
    fmt::print("{}", report(true, style_for(stdout)));
    return exit_ok;
  }

  [[nodiscard]] std::string report(bool is_done, const Style& style) const {
    std::vector<RenamedFile> files;
    for (const ChangedFile& changed : changed_) {
      files.push_back({changed.before->file->name, changed.places});
    }
    std::string text = renamed_files_text(renaming_, files, is_done);
    for (const ReportedProof& proof : proofs_) text += proof_text(proof, style);
    return text;
  }

  const RenameCommand& command_;
  Renaming renaming_;
  Recheck recheck_{renaming_};
  std::vector<ChangedFile> changed_;
  std::vector<ReportedProof> proofs_;
};

}  // namespace

int rename(const RenameCommand& command) { return Call(command).run(); }

}  // namespace cbc::cli

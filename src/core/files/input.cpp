#include "core/files/input.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <poll.h>
#include <set>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "cbc/event.h"
#include "core/catalog/draft.h"
#include "core/catalog/reader.h"
#include "core/check/check.h"
#include "core/check/controls.h"
#include "core/compile/compile.h"
#include "core/diagnostic/diagnostic.h"
#include "core/diagnostic/rules.h"
#include "core/files/output.h"
#include "core/files/read_files.h"
#include "core/script/event_lines.h"
#include "core/script/reader.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"
#include "runtime/compiled/compiled_file.h"
#include "runtime/coordinator/record.h"

namespace cbc::cli {
namespace {

template <typename Keys>
bool has_any(const yaml::Node& node, const Keys& keys) {
  return std::any_of(keys.begin(), keys.end(),
                     [&node](std::string_view key) { return node.find(key) != nullptr; });
}

/// Whether lines of a text that is not valid YAML begin with the keys of a catalog.
bool has_lines_of_catalog(std::string_view text) {
  constexpr std::string_view main_key = "behaviors";
  constexpr std::string_view other_keys[] = {"tasks", "exclusivity_constraints", "default_values"};
  const auto begins_with = [](std::string_view line, std::string_view key) {
    return line.starts_with(key) && line.substr(key.size()).starts_with(':');
  };
  text = utf8::without_byte_order_mark(text);
  std::set<std::string_view> found;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::string_view line = text.substr(begin, text.find('\n', begin) - begin);
    if (begins_with(line, main_key)) return true;
    for (const std::string_view key : other_keys) {
      if (begins_with(line, key)) found.insert(key);
    }
    begin += line.size() + 1;
  }
  return found.size() > 1;
}

}  // namespace

bool is_catalog(const yaml::Document& document) { return cbc::is_catalog(document.root()); }

bool is_script(const yaml::Document& document) {
  constexpr std::array<std::string_view, 4> keys = {"events", "catalog", "reactive_delay",
                                                    "timeouts"};
  constexpr std::array<std::string_view, 2> other_event_keys = {"expect", "at"};
  const yaml::Node& root = document.root();
  if (root.kind != yaml::Kind::sequence) {
    // In a catalog it is a list.
    const yaml::Node* const situation = root.find("situation");
    const bool has_situation = situation != nullptr && situation->kind == yaml::Kind::mapping;
    return !is_catalog(document) && !is_property_file(document) &&
           (has_any(root, keys) || has_situation);
  }
  // Another list is more likely a catalog that lacks a key.
  return root.items.empty() ||
         std::any_of(root.items.begin(), root.items.end(), [&](const yaml::Node* item) {
           return has_any(*item, words_of<Verb>()) || has_any(*item, other_event_keys);
         });
}

bool is_property_file(const yaml::Document& document) {
  const auto& entries = document.root().entries;
  return !is_catalog(document) &&
         std::any_of(entries.begin(), entries.end(), [](const auto& entry) {
           return entry.first->text == "properties" || entry.first->text == "assume";
         });
}

bool looks_like_script(const yaml::Document& document) {
  if (is_script(document)) return true;
  const auto& entries = document.root().entries;
  return !is_catalog(document) && !is_property_file(document) &&
         std::any_of(entries.begin(), entries.end(), [](const auto& entry) {
           return nearest(entry.first->text, std::array<std::string_view, 1>{"events"}).has_value();
         });
}

namespace {

/// A list of events, of which at least one has a known verb.
bool has_events(const yaml::Node& node) {
  return node.kind == yaml::Kind::sequence &&
         std::any_of(node.items.begin(), node.items.end(), [](const yaml::Node* item) {
           return has_any(*item, words_of<Verb>()) || item->find("expect") != nullptr;
         });
}

/// Other YAML files may begin like a script.
bool is_script_surely(const yaml::Node& root) {
  const bool names_both = root.find("catalog") != nullptr && root.find("events") != nullptr;
  return names_both || has_events(root) ||
         std::any_of(root.entries.begin(), root.entries.end(),
                     [](const auto& entry) { return has_events(*entry.second); });
}

/// Other YAML files, such as JSON schemas, have a mapping under this key.
bool has_properties(const yaml::Node& root) {
  const yaml::Node* const properties = root.find("properties");
  return properties == nullptr || properties->kind == yaml::Kind::sequence;
}

/// Whether lines of a text that is not valid YAML begin with the keys of a script.
bool has_lines_of_script(std::string_view text) {
  text = utf8::without_byte_order_mark(text);
  bool has_verb = false;
  bool has_key = false;
  for (std::size_t begin = 0; begin < text.size();) {
    std::string_view line = text.substr(begin, text.find('\n', begin) - begin);
    begin += line.size() + 1;
    has_key |= line.starts_with("events:");
    line.remove_prefix(std::min(line.find_first_not_of(" -{"), line.size()));
    const std::string_view word = line.substr(0, line.find(':'));
    has_verb |=
        word.size() < line.size() && (word == "expect" || find_word<Verb>(word).has_value());
  }
  return has_key && has_verb;
}

}  // namespace

FoundFile recognize(std::string_view text) {
  Diagnostics ignored;
  const auto document = yaml::parse(text, {}, ignored);
  if (document == nullptr) {
    if (has_lines_of_catalog(text)) return FoundFile::catalog;
    return has_lines_of_script(text) ? FoundFile::script : FoundFile::other;
  }
  const yaml::Node& root = document->root();
  const bool is_of_properties = is_property_file(*document);
  if (!is_of_properties && !looks_like_script(*document)) {
    return resembles_catalog(root) ? FoundFile::catalog : FoundFile::other;
  }
  if (!(is_of_properties ? has_properties(root) : is_script_surely(root))) return FoundFile::other;
  return catalog_of_script(*document) != nullptr ? FoundFile::script
                                                 : FoundFile::script_without_catalog;
}

namespace {

/// Prints findings to standard error: all errors, and the first few warnings of each rule in each
/// file, but no notes. Older names of keys, of which a file usually has many, are only counted.
/// `texts` has the files they are about, by their names in messages.
void print_findings(const std::vector<Diagnostic>& findings,
                    const std::map<std::string, std::string>& texts) {
  constexpr std::size_t most_warnings = 3;
  SourceTexts sources;
  for (const auto& [file, text] : texts) sources.add(file, text);
  const Style style = style_for(stderr);
  std::map<std::pair<std::string_view, std::string_view>, std::size_t> warnings;
  for (const Diagnostic& finding : findings) {
    if (finding.severity == Severity::note) continue;
    if (finding.severity == Severity::error ||
        (++warnings[{finding.file, finding.rule}] <= most_warnings &&
         finding.rule != rule::deprecated_key.name)) {
      fmt::print(stderr, "{}", render(finding, sources, style));
    }
  }
  for (const auto& [kind, count] : warnings) {
    if (kind.second == rule::deprecated_key.name) {
      fmt::print(stderr, "{}: {}: {} {}; see 'cbc lint', or 'cbc lint --fix' [{}]\n",
                 printable(kind.first), style.paint(style.warning, "warning"),
                 quantity(count, "key"), count == 1 ? "has an older name" : "have older names",
                 kind.second);
      continue;
    }
    if (count <= most_warnings) continue;
    fmt::print(stderr, "{}: {} more like these [{}]\n", printable(kind.first),
               count - most_warnings, kind.second);
  }
}

namespace fs = std::filesystem;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

std::optional<std::string> fail(const std::string& path, const std::string& reason) {
  complain("cannot read {}: {}", quote(display_name(path)), reason);
  return std::nullopt;
}

/// Larger texts are refused, so that no input can exhaust the memory of the machine. Compiled
/// catalogs have a limit of their own.
constexpr std::size_t largest_file = std::size_t{256} << 20;

std::optional<std::string> read_stream(std::FILE* stream, const std::string& path) {
  std::string text;
  std::array<char, 1 << 16> block{};
  errno = 0;
  for (;;) {
    const std::size_t count = std::fread(block.data(), 1, block.size(), stream);
    text.append(block.data(), count);
    const std::size_t largest = is_compiled(text) ? largest_compiled_file : largest_file;
    if (text.size() > largest) {
      return fail(path, fmt::format("it is larger than {} MiB", largest >> 20));
    }
    if (count == 0) break;
  }
  if (std::ferror(stream) != 0) return fail(path, std::strerror(errno));
  return text;
}

}  // namespace

std::optional<std::string> read_input(const std::string& path) {
  note_read(path);
  if (path == "-") return read_stream(stdin, path);
  if (const auto refusal = find_refusal(path)) return fail(path, *refusal);
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rbe"));
  if (file == nullptr) return fail(path, std::strerror(errno));
  return read_stream(file.get(), path);
}

std::optional<std::string> read_result(const std::string& path) {
  // Enough for a catalog of 300,000 behaviors. Larger results are refused, because parsed JSON
  // takes many times the memory of its text.
  constexpr std::size_t largest = std::size_t{64} << 20U;
  std::optional<std::string> text = read_input(path);
  if (!text || text->size() <= largest) return text;
  complain("cannot merge {}: it is larger than {} MiB", quote(display_name(path)), largest >> 20U);
  return std::nullopt;
}

std::string display_name(const std::string& path) { return path == "-" ? "<stdin>" : path; }

std::vector<std::string> list_folder(const std::string& path,
                                     std::initializer_list<std::string_view> suffixes,
                                     bool& has_failed) {
  std::vector<std::string> files;
  std::vector<fs::path> folders{path};
  while (!folders.empty()) {
    const fs::path folder = std::move(folders.back());
    folders.pop_back();
    std::error_code error;
    std::error_code ignored;
    if (const auto refusal = find_refusal(folder.string())) {
      (void)fail(folder.string(), *refusal);
      has_failed = true;
      continue;
    }
    fs::directory_iterator entry(folder, error);
    for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
      if (entry->path().filename().string().starts_with('.')) continue;
      if (entry->is_directory(ignored) && !entry->is_symlink(ignored)) {
        folders.push_back(entry->path());
      } else if (std::find(suffixes.begin(), suffixes.end(), entry->path().extension()) !=
                     suffixes.end() &&
                 (entry->is_regular_file(ignored) || find_refusal(entry->path().string()))) {
        files.push_back(entry->path().string());
      }
    }
    if (error) {
      (void)fail(folder.string(), error.message());
      has_failed = true;
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

bool is_folder(const std::string& path) {
  std::error_code ignored;
  return path != "-" && fs::is_directory(path, ignored);
}

namespace {

/// Whether it is a pipe, a device or a socket, from which something may never come.
bool is_special(const std::string& path) {
  std::error_code ignored;
  return !find_refusal(path) && fs::is_other(path, ignored);
}

/// Whether a file is a catalog or another file of cbc, at least by its keys.
bool is_known_kind(std::string_view text, const yaml::Document* document) {
  if (document == nullptr) return has_lines_of_catalog(text);
  return resembles_catalog(document->root()) || is_script(*document) || is_property_file(*document);
}

}  // namespace

void complain_of_log(const std::string& name) {
  complain("{} is the log of a stream; 'cbc solve --replay' reads it", quote(name));
}

std::optional<InputFile> InputFiles::read(const std::string& path, NamedBy named_by) {
  if (named_by != NamedBy::command_line && is_special(path)) {
    (void)fail(path, "it is no regular file");
    return std::nullopt;
  }
  std::optional<CatalogInput> input = read_catalog_input(path);
  if (!input) return std::nullopt;
  if (input->is_compiled) return InputFile{path, nullptr, std::move(*input)};
  const std::string name = display_name(path);
  const auto entry = texts_.insert_or_assign(name, std::move(input->content)).first;
  Diagnostics diagnostics;
  auto document = yaml::parse(entry->second, name, diagnostics);
  if (named_by == NamedBy::file && !is_known_kind(entry->second, document.get())) {
    complain("{} is not a catalog", quote(name));
    return std::nullopt;
  }
  if (named_by == NamedBy::link && document == nullptr) {
    complain("{} is a link to a file elsewhere that is not valid YAML", quote(name));
    return std::nullopt;
  }
  if (is_log(entry->second)) {
    complain_of_log(name);
    return std::nullopt;
  }
  if (keeps_findings_) {
    for (Diagnostic& finding : diagnostics.release()) findings_.push_back(std::move(finding));
  }
  if (document == nullptr) {
    ++faulty_;
    return std::nullopt;
  }
  return InputFile{path, std::move(document), {}};
}

std::optional<InputFile> InputFiles::read_catalog(const std::string& path, NamedBy named_by) {
  std::optional<InputFile> file = read(path, named_by);
  if (!file || file->document == nullptr) return file;
  const bool is_of_properties = is_property_file(*file->document);
  if (!is_of_properties && !is_script(*file->document)) return file;
  complain("{} is a {}; expected a catalog here", quote(display_name(path)),
           is_of_properties ? "property file" : "script");
  return std::nullopt;
}

bool InputFiles::take_findings(const std::string& path, const yaml::Document& document,
                               Diagnostics diagnostics, bool is_complete) {
  const std::optional<SeveritySettings> settings = settings_.find(path);
  if (!settings) return false;
  const CommentedFile file{document.file(), text_of(document), &document, is_complete};
  return keep(control_findings(diagnostics.release(), file, *settings), *settings);
}

InputFiles::CheckedFile InputFiles::check_catalog(const std::string& path,
                                                  const yaml::Document& document, Purpose purpose) {
  const std::optional<SeveritySettings> settings = settings_.find(path);
  if (!settings) return {};
  CheckedFile checked = check_by_rules(path, document, purpose, *settings);
  const bool are_settings_good = check_settings(*settings, checked.reading.catalog);
  if (purpose != Purpose::drawing) checked.is_usable &= are_settings_good;
  return checked;
}

InputFiles::CheckedFile InputFiles::check_by_rules(const std::string& path,
                                                   const yaml::Document& document, Purpose purpose,
                                                   const SeveritySettings& settings) {
  if (purpose == Purpose::drawing ||
      (purpose == Purpose::use && (!keeps_findings_ || !settings.add_failures()))) {
    Diagnostics diagnostics;
    CatalogReading reading = understand_catalog(document, diagnostics);
    return {std::move(reading), take_findings(path, document, std::move(diagnostics), false)};
  }
  LintOptions options;
  options.searches = settings.need_search();
  CheckedCatalog checked =
      cbc::check_catalog(document, text_of(document), settings, options, Diagnostics());
  const bool is_usable = keep(std::move(checked.findings), settings);
  return {std::move(checked.reading), is_usable};
}

/// Adds the errors about names of tasks in the settings, each once. Returns whether there are none.
/// A name that resembles no other may be that of a task of another catalog; only lint, which may
/// see all of them, warns of it.
bool InputFiles::check_settings(const SeveritySettings& settings, const Catalog& catalog) {
  if (settings.never_together().empty() || catalog.tasks.empty()) return true;
  std::vector<std::string_view> tasks;
  for (const Task& task : catalog.tasks) tasks.emplace_back(task.name);
  Diagnostics diagnostics;
  check_never_together_names(settings.never_together(), tasks, diagnostics);
  diagnostics.sort();
  std::vector<Diagnostic> errors = diagnostics.release();
  std::erase_if(errors,
                [](const Diagnostic& finding) { return finding.severity != Severity::error; });
  if (errors.empty()) return true;
  const std::string& file = settings.never_together().front().file;
  if (!texts_.contains(file)) texts_.emplace(file, read_input(file).value_or(""));
  std::set<Range> known;
  for (const Diagnostic& finding : findings_) {
    if (finding.file == file) known.insert(finding.range);
  }
  std::erase_if(errors,
                [&known](const Diagnostic& finding) { return known.contains(finding.range); });
  (void)keep(std::move(errors), settings);
  return false;
}

/// Returns whether there are no errors. Warnings that are dropped are none, however strict the
/// settings.
bool InputFiles::keep(std::vector<Diagnostic> findings, const SeveritySettings& settings) {
  bool has_errors = false;
  for (Diagnostic& finding : findings) {
    const bool is_warning = finding.severity != Severity::error;
    if (!is_warning || (keeps_findings_ && settings.is_failure(finding.severity))) {
      if (is_warning) ++strict_[settings.strict_file()];
      finding.severity = Severity::error;
      has_errors = true;
    }
    if (keeps_findings_) findings_.push_back(std::move(finding));
  }
  if (has_errors) ++faulty_;
  return !has_errors;
}

void InputFiles::print_findings() {
  std::stable_sort(findings_.begin(), findings_.end(),
                   [](const Diagnostic& a, const Diagnostic& b) { return a.file < b.file; });
  cli::print_findings(findings_, texts_);
  for (const auto& [file, count] : strict_) {
    complain("{} above would be {} without 'strict: true' in {}", quantity(count, "error"),
             count == 1 ? "a warning" : "warnings", quote(file));
  }
}

std::shared_ptr<const CompiledCatalog> CatalogLoader::load(const InputFile& file) {
  if (file.document == nullptr) {
    std::optional<CompiledFile> compiled = cli::load(file.compiled);
    if (!compiled) return nullptr;
    return std::make_shared<const CompiledCatalog>(std::move(compiled->catalog));
  }
  std::optional<Catalog> catalog = understand(file.path, *file.document, InputFiles::Purpose::use);
  if (!catalog) return nullptr;
  auto compiled = std::make_shared<const CompiledCatalog>(compile(*catalog));
  if (keeps_sources_) {
    sources_.emplace(compiled.get(), std::make_shared<const CatalogSource>(CatalogSource{
                                         std::move(*catalog), files_.text_of(*file.document)}));
  }
  return compiled;
}

std::string CatalogLoader::key_of(const std::string& path) {
  return fs::path(path).lexically_normal().string();
}

std::shared_ptr<const CompiledCatalog> CatalogLoader::load(const std::string& path,
                                                           NamedBy named_by) {
  const auto [entry, is_new] = known_.try_emplace(key_of(path));
  Known& known = entry->second;
  if (is_new) {
    const std::size_t faulty = files_.faulty();
    if (const std::optional<InputFile> file = files_.read_catalog(path, named_by)) {
      known.catalog = load(*file);
    }
    known.fault = files_.faulty() > faulty ? Fault::in_findings : Fault::printed;
  }
  return known.catalog;
}

std::shared_ptr<const CompiledCatalog> CatalogLoader::load(const NamedCatalog& named) {
  auto catalog = load(named.path, NamedBy::file);
  if (catalog == nullptr && fault_of(named.path) == Fault::printed) {
    complain("{}: the catalog {} cannot be used", named.place, quote(named.path));
  }
  return catalog;
}

std::optional<Catalog> CatalogLoader::understand(const std::string& path,
                                                 const yaml::Document& document,
                                                 InputFiles::Purpose purpose) {
  InputFiles::CheckedFile file = files_.check_catalog(path, document, purpose);
  if (!file.is_usable) return std::nullopt;
  return std::move(file.reading.catalog);
}

std::shared_ptr<const CompiledCatalog> load_catalog(const std::string& path) {
  InputFiles files;
  auto catalog = CatalogLoader(files).load(path);
  files.print_findings();
  return catalog;
}

namespace {

/// Whether a regular file has a compiled catalog. Other files cannot be read twice.
bool can_be_mapped(const std::string& path) {
  std::error_code ignored;
  if (path == "-" || find_refusal(path)) return false;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  std::array<char, 8> begin{};
  std::ifstream file(path, std::ios::binary);
  file.read(begin.data(), begin.size());
  return is_compiled({begin.data(), static_cast<std::size_t>(file.gcount())});
}

}  // namespace

std::optional<CatalogInput> read_catalog_input(const std::string& path) {
  if (can_be_mapped(path)) {
    note_read(path);
    return CatalogInput{path, {}, true};
  }
  std::optional<std::string> content = read_input(path);
  if (!content) return std::nullopt;
  const bool has_catalog = is_compiled(*content);
  return CatalogInput{path, std::move(*content), has_catalog};
}

std::optional<CompiledFile> load(const CatalogInput& input) {
  CompiledFileResult result =
      input.content.empty() ? load_compiled(input.path) : read_compiled(input.content);
  if (!result.file) {
    complain("cannot read {}: {}", quote(display_name(input.path)), result.error);
  }
  return std::move(result.file);
}

std::optional<NamedCatalog> catalog_named_by(const std::string& path,
                                             const yaml::Document& document) {
  const yaml::Node* const named = catalog_of_script(document);
  if (named == nullptr) return std::nullopt;
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::string found = (folder / named->text).lexically_normal().string();
  // In a file this is a name as any other: standard input is only what the command line names.
  if (found == "-") found = "./-";
  return NamedCatalog{std::move(found),
                      format_place(printable(document.file()), named->range.begin)};
}

namespace {

std::string folder_of(const std::string& file) {
  const fs::path folder = fs::path(file).parent_path();
  return folder.empty() ? "." : folder.string();
}

}  // namespace

SettingsFinder::SettingsFinder(SeveritySettings command_line)
    : command_line_(std::move(command_line)) {}

std::optional<SeveritySettings> SettingsFinder::find(const std::string& path) {
  const std::optional<std::string> file = find_settings_file(path);
  // One above the folder of --confine belongs to others.
  if (!file || find_refusal(folder_of(*file))) return command_line_;
  const auto [entry, is_new] = known_.try_emplace(*file);
  if (!is_new) return entry->second;
  if (const std::optional<std::string> text = read_input(*file)) {
    Diagnostics diagnostics;
    entry->second = read_settings(*text, *file, diagnostics);
    diagnostics.sort();
    if (!entry->second && leads_out_of(folder_of(*file), *file)) {
      complain("{} is a link to a file elsewhere that has no valid settings", quote(*file));
    } else {
      print_findings(diagnostics.all(), {{*file, *text}});
    }
  }
  if (entry->second) entry->second->override_with(command_line_);
  return entry->second;
}

LineInput::Status LineInput::next(int longest_wait) {
  for (;;) {
    const std::size_t end = buffer_.find('\n', scanned_);
    const bool is_last = end == std::string::npos && has_ended_;
    if (is_last && begin_ == buffer_.size() && !skips_) return Status::end;
    if (end != std::string::npos || is_last) {
      line_ = std::string_view(buffer_).substr(begin_, std::min(end, buffer_.size()) - begin_);
      begin_ = scanned_ = is_last ? buffer_.size() : end + 1;
      ++number_;
      const bool is_too_long = skips_ || line_.size() > longest_line_;
      skips_ = false;
      return is_too_long ? Status::too_long : Status::line;
    }
    scanned_ = buffer_.size();
    if (skips_ || scanned_ - begin_ > longest_line_) {
      skips_ = true;
      begin_ = scanned_;
    }
    if (const Status status = fill(longest_wait); status != Status::line) return status;
  }
}

/// Reads more input. Returns `line` if there may be one now.
LineInput::Status LineInput::fill(int longest_wait) {
  before_reading_();
  buffer_.erase(0, begin_);
  scanned_ -= begin_;
  begin_ = 0;
  constexpr std::size_t block_size = std::size_t{1} << 16;
  for (;;) {
    std::array<pollfd, 2> waiting{{{descriptor_, POLLIN, 0}, {stop_, POLLIN, 0}}};
    const int ready = ::poll(waiting.data(), waiting.size(), longest_wait);
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0) return Status::waiting;
    if (waiting[1].revents != 0) return Status::stopped;
    const std::size_t size = buffer_.size();
    buffer_.resize(size + block_size);
    const ssize_t count = ::read(descriptor_, buffer_.data() + size, block_size);
    buffer_.resize(size + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    if (count > 0) return Status::line;
    if (count == 0) {
      has_ended_ = true;
      return Status::line;
    }
    if (errno == EINTR || errno == EAGAIN) continue;
    error_ = std::strerror(errno);
    return Status::failed;
  }
}

}  // namespace cbc::cli

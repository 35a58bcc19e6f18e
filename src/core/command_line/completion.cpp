#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "core/command_line/parsed_line.h"
#include "core/files/file_set.h"
#include "runtime/base/text.h"

namespace cbc::cli {
namespace {

/// Larger files would take longer to read than somebody who presses a key waits.
constexpr std::uintmax_t largest_completed = std::uintmax_t{2} << 20U;
constexpr std::uintmax_t largest_compiled = std::uintmax_t{64} << 20U;

std::string expand_home(const std::string& path) {
  const char* const home = std::getenv("HOME");
  return home != nullptr && path.starts_with("~/") ? home + path.substr(1) : path;
}

/// Only regular files with a size are read: pipes and files of the kernel might never end.
bool is_readable_file(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  return !error && size > 0 &&
         size <= (path.ends_with(".cbc") ? largest_compiled : largest_completed);
}

std::shared_ptr<const InputFile> read_if_readable(FileSet& files, const std::string& path) {
  return is_readable_file(path) ? files.read(path) : nullptr;
}

/// The catalog at the path, or the one that the script or property file there names.
std::shared_ptr<const InputFile> read_catalog_of(FileSet& files, const std::string& path) {
  auto file = read_if_readable(files, path);
  if (!file || (!file->is(FileKind::script) && !file->is(FileKind::properties))) return file;
  const std::optional<NamedCatalog> named = catalog_named_by(*file);
  return named ? read_if_readable(files, named->path) : nullptr;
}

/// The tasks, and on request the behaviors, of the catalog in a file, or of the catalog that the
/// script in it names. A catalog with errors is used as far as it is understood. Messages go to
/// standard error.
std::vector<NameWithHelp> names_of_file(const std::string& path, bool with_behaviors) {
  FileSet files;
  const auto catalog = read_catalog_of(files, expand_home(path));
  if (!catalog) return {};
  std::vector<NameWithHelp> names;
  std::set<std::string> known;
  const auto add = [&](std::string_view name, const char* what) {
    if (known.emplace(name).second) names.push_back({std::string(name), what});
  };
  if (catalog->is(FileKind::compiled)) {
    const std::optional<CompiledFile> compiled = load_compiled(*catalog);
    if (!compiled) return {};
    for (const std::string_view name : compiled->catalog.task_names) add(name, "task");
    if (!with_behaviors) return names;
    for (const std::string_view name : compiled->catalog.behavior_names) add(name, "behavior");
    return names;
  }
  const CatalogReading reading = files.check(*catalog, FileSet::Purpose::drawing).catalog.reading;
  for (const Task& task : reading.catalog.tasks) add(task.name, "task");
  for (const UndefinedTask& task : reading.undefined_tasks) add(task.name, "task");
  if (!with_behaviors) return names;
  for (const Behavior& behavior : reading.catalog.behaviors) add(behavior.name, "behavior");
  return names;
}

/// The words that fit where a word of a command line is being typed.
struct Completion {
  std::vector<NameWithHelp> candidates;    ///< without `prefix`
  bool is_file = false;                    ///< the shell offers files
  std::vector<std::string_view> suffixes;  ///< of the files, without dots; empty: all files
  std::string prefix;                      ///< of the last word, before the value: "--format="
};

/// The first few words of the help of an option or a command.
std::string first_words(std::string text) {
  std::size_t end = text.size();
  for (const char* const stop : {". ", "; ", ": ", " ("}) end = std::min(end, text.find(stop));
  text.resize(end);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

void offer_commands(const Program& program, Completion& completion) {
  for (const Command& command : program.commands()) {
    completion.candidates.push_back({command.name(), first_words(command.description())});
  }
}

void offer_options(const Command& command, Completion& completion) {
  for (const Option& option : command.options()) {
    if (option.is_argument) continue;
    const std::vector<std::string>& choices = option.values.choices;
    const std::string help = choices.empty() ? first_words(option.meaning()) : join(choices, ", ");
    for (auto name = option.names.rbegin(); name != option.names.rend(); ++name) {
      completion.candidates.push_back({*name, help});
    }
  }
}

void offer_names(std::vector<NameWithHelp> names, Completion& completion) {
  std::move(names.begin(), names.end(), std::back_inserter(completion.candidates));
}

void offer_files(std::vector<std::string_view> suffixes, Completion& completion) {
  completion.is_file = true;
  completion.suffixes = std::move(suffixes);
}

/// Offers names of the catalog on the line, or of the one that a script on the line names.
void offer_names_of(const ParsedLine& line, bool with_behaviors, Completion& completion) {
  std::vector<std::string> paths = line.arguments;
  for (const auto& [option, values] : line.given) {
    if (option->values.kind == ValueKind::script) {
      paths.insert(paths.end(), values.begin(), values.end());
    }
  }
  if (!paths.empty()) offer_names(names_of_file(paths.front(), with_behaviors), completion);
}

void offer_kind(ValueKind kind, const ParsedLine& line, Completion& completion) {
  switch (kind) {
    case ValueKind::text:
      return;
    case ValueKind::catalog:
      return offer_files({"yaml", "yml", "cbc"}, completion);
    case ValueKind::script:
      return offer_files({"yaml", "yml", "json"}, completion);
    case ValueKind::catalog_or_script:
      return offer_files({"yaml", "yml", "json", "cbc"}, completion);
    case ValueKind::file:
      return offer_files({}, completion);
    case ValueKind::task:
      return offer_names_of(line, false, completion);
    case ValueKind::task_or_behavior:
      return offer_names_of(line, true, completion);
  }
}

void offer_values(const Option& option, const ParsedLine& line, const std::string& typed,
                  Completion& completion) {
  if (option.separator != '\0') {
    completion.prefix += typed.substr(0, typed.rfind(option.separator) + 1);
  }
  for (const std::string& choice : option.values.choices) {
    completion.candidates.push_back({choice, ""});
  }
  if (option.values.names) offer_names(option.values.names(), completion);
  offer_kind(option.values.kind, line, completion);
}

/// Follows from the declarations of the command line. `words` follow the name of the program; the
/// word at `place`, which may be empty, is being typed. Where names of a catalog fit, the catalog
/// is read.
Completion complete(const Program& program, const std::vector<std::string>& words,
                    std::size_t place) {
  Completion completion;
  const std::string& last = words[place];
  const ParsedLine before =
      parse(program, {words.begin(), words.begin() + static_cast<std::ptrdiff_t>(place)});
  const ParsedLine whole = parse(program, words);
  if (before.has_unknown_command) return completion;
  const bool is_dash = last.starts_with('-') && !before.has_separator;
  if (before.command == nullptr) {
    is_dash ? offer_options(program.itself(), completion) : offer_commands(program, completion);
    return completion;
  }
  if (is_value_of(before.pending, last)) {
    offer_values(*before.pending, whole, last, completion);
    return completion;
  }
  const std::size_t equals = last.find('=');
  if (is_dash && equals != std::string::npos) {
    if (!last.starts_with("--")) return completion;  // short options take no '='
    const Option* const option = before.command->find(last.substr(0, equals));
    if (option == nullptr || option->is_flag) return completion;
    completion.prefix = last.substr(0, equals + 1);
    offer_values(*option, whole, last.substr(equals + 1), completion);
    return completion;
  }
  const Option* const positional = next_argument(*before.command, before.arguments.size());
  if (is_dash || (positional == nullptr && last.empty() && !before.has_separator)) {
    offer_options(*before.command, completion);
  } else if (positional != nullptr) {
    offer_values(*positional, whole, last, completion);
  }
  return completion;
}

/// Removes the quotes of a word, which may be unfinished, as a shell does; expands nothing.
std::string unquote(std::string_view word) {
  std::string plain;
  char quote_mark = '\0';
  for (std::size_t i = 0; i < word.size(); ++i) {
    const char character = word[i];
    if (quote_mark == '\0' && (character == '\'' || character == '"')) {
      quote_mark = character;
    } else if (character == quote_mark) {
      quote_mark = '\0';
    } else if (character == '\\' && quote_mark != '\'') {
      if (i + 1 == word.size()) break;
      const bool is_literal =
          quote_mark == '"' && std::string_view("$`\"\\").find(word[i + 1]) == std::string::npos;
      if (is_literal) plain += character;
      plain += word[++i];
    } else {
      plain += character;
    }
  }
  return plain;
}

bool is_harmless(char character) {
  return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z') ||
         (character >= '0' && character <= '9') ||
         std::string_view("_-./+,@%:=").find(character) != std::string_view::npos ||
         static_cast<unsigned char>(character) >= 0x80;
}

/// A text as it has to stand in bash after an opening quote, or without one. Empty if it cannot be
/// quoted in this way.
std::optional<std::string> quote_for_bash(std::string_view text, char quote_mark) {
  std::string quoted;
  for (const char character : text) {
    if (quote_mark == '\'') {
      quoted += character == '\'' ? R"('\'')" : std::string(1, character);
    } else if (quote_mark == '"') {
      if (character == '!') return std::nullopt;  // bash would expand the history
      if (std::string_view("$`\"\\").find(character) != std::string_view::npos) quoted += '\\';
      quoted += character;
    } else {
      if (!is_harmless(character)) quoted += '\\';
      quoted += character;
    }
  }
  return quoted;
}

/// A word that is being typed.
struct TypedWord {
  std::string plain;       ///< the whole word without quotes
  std::string kept;        ///< the part that the shell does not replace, without quotes
  char quote_mark = '\0';  ///< that opens the part that it replaces
};

TypedWord typed_word(const std::string& word, const std::string& kept) {
  TypedWord typed{unquote(word), unquote(kept), '\0'};
  if (word.size() > kept.size() && (word[kept.size()] == '"' || word[kept.size()] == '\'')) {
    typed.quote_mark = word[kept.size()];
  }
  return typed;
}

char to_lower(char character) {
  return character >= 'A' && character <= 'Z' ? static_cast<char>(character - 'A' + 'a')
                                              : character;
}

/// Whether a candidate has all typed letters, in this order and in any case. Such a candidate is
/// accepted by fish if it is the only one; fish itself would look for the letters in the help, too.
bool has_letters_of(std::string_view candidate, std::string_view typed) {
  for (const char character : candidate) {
    if (!typed.empty() && to_lower(character) == to_lower(typed.front())) typed.remove_prefix(1);
  }
  return typed.empty();
}

void print_words(const Completion& completion, const TypedWord& typed, std::string_view shell) {
  fmt::print("words\n");
  for (const auto& [text, help] : completion.candidates) {
    const std::string whole = completion.prefix + text;
    if (text.empty() || printable(whole) != whole) continue;
    if (shell == "bash") {
      if (!whole.starts_with(typed.plain) || !whole.starts_with(typed.kept)) continue;
      const auto quoted = quote_for_bash(whole.substr(typed.kept.size()), typed.quote_mark);
      if (quoted) fmt::print("{}\n", *quoted);
    } else if (shell == "zsh" || has_letters_of(whole, typed.plain)) {
      fmt::print("{}\t{}\n", whole, printable(help));
    }
  }
}

void print_files(const Completion& completion, const TypedWord& typed) {
  fmt::print("files");
  for (const std::string_view suffix : completion.suffixes) fmt::print(" {}", suffix);
  const std::size_t skipped = completion.prefix.size();
  const std::string kept = typed.kept.size() > skipped ? typed.kept.substr(skipped) : "";
  fmt::print("\n{}\n{}\n", printable(typed.plain.substr(skipped)), printable(kept));
}

/// 0 if the text is not a number.
std::size_t parse_place(std::string_view text) {
  std::size_t place = 0;
  std::from_chars(text.data(), text.data() + text.size(), place);
  return place;
}

}  // namespace

void reply_to_shell(const Program& program, const std::vector<std::string>& arguments) {
  constexpr std::size_t first_word = 3;
  if (arguments.size() <= first_word) return;
  const std::size_t place = parse_place(arguments[2]);
  if (place == 0 || place > arguments.size() - first_word) return;
  const std::string& shell = arguments[0];
  std::vector<std::string> words(arguments.begin() + first_word, arguments.end());
  const TypedWord typed = typed_word(words[place - 1], arguments[1]);
  if (shell == "bash") {
    for (std::string& word : words) word = unquote(word);
  }
  words[place - 1] = typed.plain;
  const Completion completion = complete(program, words, place - 1);
  completion.is_file ? print_files(completion, typed) : print_words(completion, typed, shell);
}

}  // namespace cbc::cli

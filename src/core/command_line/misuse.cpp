#include <algorithm>
#include <string>
#include <vector>

#include <fmt/core.h>

#include "core/command_line/parsed_line.h"
#include "core/files/output.h"
#include "core/support/system.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

// What is wrong with a command line whose words are all known.
namespace cbc::cli {
namespace {

/// A file that an option names.
struct NamedFile {
  const Option* option = nullptr;
  std::string path;
};

/// About files that are read or written; empty if all go together.
std::string find_bad_file(const std::vector<NamedFile>& inputs,
                          const std::vector<NamedFile>& outputs) {
  const auto is_standard = [](const NamedFile& file) { return file.path == "-"; };
  if (std::count_if(inputs.begin(), inputs.end(), is_standard) > 1) {
    return "standard input can be read only once, but is given several times";
  }
  for (auto output = outputs.begin(); output != outputs.end(); ++output) {
    const auto is_lost = [&](const NamedFile& input) {
      const bool may_be =
          !is_standard(input) && input.option->values.replaced_by == output->option->name();
      return !may_be && is_same_file(input.path, output->path);
    };
    if (std::any_of(inputs.begin(), inputs.end(), is_lost)) {
      return fmt::format("the output {} is also an input", quote(output->path));
    }
    const auto is_again = [&](const NamedFile& other) {
      return other.path == output->path ||
             (!is_standard(other) && !is_standard(*output) &&
              target_of(other.path) == target_of(output->path)) ||
             is_same_file(other.path, output->path);
    };
    if (std::any_of(outputs.begin(), output, is_again)) {
      return fmt::format("{} would be written twice", quote(output->path));
    }
  }
  return {};
}

/// About the values that were given; empty if all are right.
std::string find_bad_value(const Command& command, const ParsedLine& line) {
  std::vector<NamedFile> inputs;
  std::vector<NamedFile> outputs;
  for (const Option& option : command.options()) {
    const auto found = line.given.find(&option);
    if (found == line.given.end()) continue;
    const std::vector<std::string>& values = found->second;
    if (values.size() > 1 && !option.is_repeatable && !option.is_flag) {
      return option.name() + " is given more than once";
    }
    for (const std::string& value : values) {
      const std::string fault = option.values.check ? option.values.check(value) : std::string();
      if (!fault.empty()) return fmt::format("{}: {}", option.name(), fault);
      if (option.values.is_input) inputs.push_back({&option, value});
      if (option.values.is_output) outputs.push_back({&option, value});
    }
  }
  return find_bad_file(inputs, outputs);
}

/// About an option that does not go with the others; empty if it does.
std::string find_clash(const Option& option, const Command& command, const ParsedLine& line) {
  const auto is_there = [&](const std::string& other) { return line.has(command, other); };
  for (const auto& [others, reason] : option.exclusions) {
    const auto other = std::find_if(others.begin(), others.end(), is_there);
    if (other == others.end()) continue;
    if (reason.empty())
      return fmt::format("{} and {} cannot be used together", option.name(),
                         quote_if_split(*other));
    return fmt::format("{} cannot be used with {}: {}", option.name(), quote_if_split(*other),
                       reason);
  }
  for (const std::vector<std::string>& others : option.requirements) {
    if (std::any_of(others.begin(), others.end(), is_there)) continue;
    return fmt::format("{} can only be used with {}", option.name(), join_with_or(others));
  }
  for (const auto& [other, accepted] : option.accepted_values) {
    const auto found = line.given.find(command.find(other));
    if (found == line.given.end()) continue;
    const std::string& value = found->second.front();
    if (std::find(accepted.begin(), accepted.end(), value) != accepted.end()) continue;
    return fmt::format("{} can only be used with {} {}, not {}", option.name(), other,
                       join_with_or(accepted), value);
  }
  return {};
}

}  // namespace

std::string find_misuse(const Command& command, const ParsedLine& line) {
  if (std::string fault = find_bad_value(command, line); !fault.empty()) return fault;
  for (const Option& option : command.options()) {
    if (line.given.contains(&option)) {
      if (std::string clash = find_clash(option, command, line); !clash.empty()) return clash;
    } else if (option.is_required) {
      return "expected " + option.values.expected;
    }
  }
  return {};
}

}  // namespace cbc::cli

#include "cli/help_format.h"

#include <cstddef>
#include <memory>
#include <string_view>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace cbc::cli {
namespace {

constexpr std::size_t line_width = 80;
constexpr std::size_t column = 26;  ///< where the descriptions of options and commands begin

/// Breaks a text between words into lines that fit. All but the first begin with `indent` blanks;
/// the first one follows on as many characters.
std::string wrap(std::string_view text, std::size_t indent) {
  std::string wrapped;
  std::size_t used = indent;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::string_view word = text.substr(begin, text.find(' ', begin) - begin);
    if (begin > 0 && used + 1 + word.size() > line_width) {
      wrapped += '\n' + std::string(indent, ' ');
      used = indent;
    } else if (begin > 0) {
      wrapped += ' ';
      ++used;
    }
    wrapped += word;
    used += word.size();
    begin += word.size() + 1;
  }
  return wrapped;
}

std::string wrap_lines(std::string_view text) {
  std::string wrapped;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::string_view line = text.substr(begin, text.find('\n', begin) - begin);
    wrapped += (line.starts_with(' ') ? std::string(line) : wrap(line, 0)) + '\n';
    begin += line.size() + 1;
  }
  return wrapped;
}

std::string entry(const std::string& name, const std::string& text) {
  std::string line = "  " + name;
  line += line.size() + 2 <= column ? std::string(column - line.size(), ' ')
                                    : '\n' + std::string(column, ' ');
  return line + wrap(text, column) + '\n';
}

class HelpFormat : public CLI::Formatter {
 public:
  HelpFormat(std::vector<std::string> usages, std::string examples)
      : usages_(std::move(usages)), examples_(std::move(examples)) {}

  std::string make_description(const CLI::App* app) const override {
    return wrap(app->get_description(), 0) + "\n\n";
  }

  std::string make_usage(const CLI::App* /*app*/, std::string name) const override {
    std::string text;
    for (const std::string& usage : usages_) {
      text += fmt::format("{}{} {}\n", text.empty() ? "Usage: " : "       ", name, usage);
    }
    return text + "\nExamples:\n" + examples_;
  }

  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    // It writes two empty lines between groups.
    return CLI::detail::find_and_replace(CLI::Formatter::make_help(app, std::move(name), mode),
                                         "\n\n\n", "\n\n");
  }

  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    return entry(make_option_name(option, is_positional) + make_option_opts(option),
                 make_option_desc(option));
  }

  std::string make_subcommand(const CLI::App* command) const override {
    return entry(command->get_name(), command->get_description());
  }

  std::string make_footer(const CLI::App* app) const override {
    return wrap_lines(app->get_footer());
  }

 private:
  std::vector<std::string> usages_;
  std::string examples_;
};

}  // namespace

void set_help(CLI::App& command, HelpText text) {
  command.formatter(std::make_shared<HelpFormat>(std::move(text.usages), std::move(text.examples)));
  command.footer(std::move(text.footer));
}

}  // namespace cbc::cli

#include "cli/help_format.h"

#include <memory>
#include <utility>

#include <CLI/CLI.hpp>

namespace cbc::cli {
namespace {

class HelpFormat : public CLI::Formatter {
 public:
  explicit HelpFormat(std::string examples) : examples_(std::move(examples)) {}

  std::string make_usage(const CLI::App* app, std::string name) const override {
    return CLI::Formatter::make_usage(app, std::move(name)) + "\nExamples:\n" + examples_;
  }

 private:
  std::string examples_;
};

}  // namespace

void set_help(CLI::App& command, const std::string& examples, const std::string& footer) {
  command.formatter(std::make_shared<HelpFormat>(examples));
  command.footer(footer);
}

}  // namespace cbc::cli

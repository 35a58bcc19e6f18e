#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace cbc::cli {

/// What --help shows of a command beside its options.
struct HelpText {
  std::vector<std::string> usages;  ///< what follows the name of the command, a line each
  std::string examples;             ///< the most common ones: whole lines, indented
  std::string
      footer;  ///< paragraphs, which are wrapped; lines that begin with a blank are left alone
};

void set_help(CLI::App& command, HelpText text);

}  // namespace cbc::cli

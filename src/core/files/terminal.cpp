#include "core/files/terminal.h"

#include <cstdlib>
#include <string_view>
#include <sys/ioctl.h>
#include <unistd.h>

namespace cbc::cli {

bool is_terminal(std::FILE* stream) {
  const char* const terminal = std::getenv("TERM");
  if (terminal == nullptr || std::string_view(terminal) == "dumb") return false;
  return isatty(fileno(stream)) != 0;
}

std::size_t columns_of(std::FILE* stream) {
  winsize size{};
  return ::ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::size_t columns_for(std::FILE* stream) { return is_terminal(stream) ? columns_of(stream) : 0; }

Style style_for(std::FILE* stream) {
  const char* const no_color = std::getenv("NO_COLOR");
  const bool is_wanted = (no_color == nullptr || *no_color == '\0') && is_terminal(stream);
  return is_wanted ? color_style() : plain_style();
}

std::size_t columns_for(const std::string& output) {
  return output == "-" ? columns_for(stdout) : 0;
}

Style style_for(const std::string& output) {
  return output == "-" ? style_for(stdout) : plain_style();
}

}  // namespace cbc::cli

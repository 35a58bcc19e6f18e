#include "cli/graphviz.h"

#include <cstddef>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "cli/input.h"
#include "file/filter.h"
#include "text/quote.h"

namespace cbc::cli {
namespace {

std::string first_line(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.empty() ? "it does not say why" : line;
}

/// Takes the time of the run out of a PDF file, so that the same catalog gives the same bytes. The
/// length stays, because the file has a table of the places in it.
void remove_date(std::string& pdf) {
  constexpr std::string_view begin = "/CreationDate (D:";
  constexpr std::string_view date = "19700101000000";
  const std::size_t place = pdf.find(begin);
  if (place == std::string::npos || pdf.size() < place + begin.size() + date.size()) return;
  pdf.replace(place + begin.size(), date.size(), date);
}

}  // namespace

std::optional<std::string> run_graphviz(const std::string& dot, const std::string& format) {
  Filtered picture = run_filter({"dot", "-T" + format}, dot);
  if (!picture.is_found) {
    complain(fmt::format("{} needs Graphviz (Debian: apt install graphviz): cannot run 'dot': {}",
                         format, picture.error_output));
    return std::nullopt;
  }
  if (!picture.is_done || picture.output.empty()) {
    complain(fmt::format("Graphviz cannot draw it as {}: {}", format,
                         printable(first_line(picture.error_output))));
    return std::nullopt;
  }
  if (format == "pdf") remove_date(picture.output);
  return std::move(picture.output);
}

}  // namespace cbc::cli

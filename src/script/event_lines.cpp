#include "script/event_lines.h"

#include <memory>

#include "diagnostic/reporter.h"
#include "yaml/document.h"

namespace cbc {

EventLines::Reading EventLines::read(std::string_view line, std::uint32_t number) {
  Reading reading;
  if (line.ends_with('\r')) line.remove_suffix(1);  // Windows ends lines so
  const std::size_t begin = line.find_first_not_of(" \t");
  if (begin == std::string_view::npos || line[begin] == '#') return reading;

  Diagnostics diagnostics;
  std::unique_ptr<const yaml::Document> document;
  const yaml::Node* node = json_.read(line, number);
  if (node == nullptr) {
    document = yaml::parse(line, {}, diagnostics);
    if (document != nullptr) node = &document->root();
  }
  if (node != nullptr) {
    Reporter reporter({}, diagnostics);
    reading.step = reader_.read(*node, reporter);
    reading.step->range = {{number, 1}, {number, 1}};
  }
  for (const Diagnostic& finding : diagnostics.all()) {
    if (finding.severity == Severity::error) {
      reading.error += (reading.error.empty() ? "" : "; ") + finding.message;
    } else {
      reading.warnings.push_back(finding.message);
    }
  }
  if (!reading.error.empty()) reading.step.reset();
  return reading;
}

}  // namespace cbc

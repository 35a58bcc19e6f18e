#include "draw/labels.h"

#include <utility>

#include "draw/names.h"
#include "text/decimal.h"

namespace cbc::draw {

std::string with_sign(Mark mark, std::string label) {
  std::string_view sign;
  if (mark == Mark::added || mark == Mark::started) sign = "+";
  if (mark == Mark::removed || mark == Mark::stopped) sign = "−";
  if (mark == Mark::changed) sign = "~";
  if (sign.empty()) return label;
  return std::string(sign) + (label.empty() ? "" : " ") + std::move(label);
}

std::vector<std::string> caption_of(const Moment& moment) {
  const std::string script = label_of(std::string_view(moment.script));
  if (moment.index == 0) return {script + ", before the first event"};
  return {script + ", after event " + std::to_string(moment.index) + " at " +
              format_decimal(moment.time, 6) + " s",
          moment.event};
}

std::string label_of(const CatalogGraph::Performance& performance) {
  const Millionths suitability = performance.suitability;
  if (performance.before) {
    return format_decimal(*performance.before, 4) + " → " + format_percent(suitability);
  }
  return with_sign(performance.mark,
                   suitability == one_million ? std::string() : format_percent(suitability));
}

std::string label_of(const CatalogGraph::Requirement& requirement) {
  const Millionths minimum = requirement.minimum_performance;
  const std::string label = minimum > 0 ? at_least(minimum) : std::string();
  if (!requirement.before) return with_sign(requirement.mark, label);
  const std::string before = *requirement.before > 0 ? at_least(*requirement.before) : "no minimum";
  return before + " → " + (minimum > 0 ? label : "no minimum");
}

}  // namespace cbc::draw

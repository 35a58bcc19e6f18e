#include "core/script/event_lines.h"

#include <cstddef>
#include <cstdint>
#include <memory>

#include "cbc/event.h"
#include "core/diagnostic/diagnostic.h"
#include "core/diagnostic/rules.h"
#include "core/script/reader.h"
#include "core/yaml/document.h"
#include "core/yaml/values.h"
#include "runtime/base/text.h"
#include "runtime/compiled/compiled_file.h"
#include "runtime/coordinator/record.h"

namespace cbc {

std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

EventLines::Reading EventLines::read(std::string_view line, std::uint32_t number) {
  Reading reading;
  if (line.ends_with('\r')) line.remove_suffix(1);  // a line end of Windows
  const std::size_t begin = line.find_first_not_of(" \t");
  if (begin == std::string_view::npos || line[begin] == '#') return reading;

  Diagnostics diagnostics;
  std::unique_ptr<const yaml::Document> document;
  const yaml::Node* node = json_.read(line, number);
  if (node == nullptr || json_.has_merge_key()) {
    node = nullptr;
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

namespace {

using yaml::Node;

/// Reports a missing key.
const Node* require(const Node& object, std::string_view key, Reporter& reporter) {
  const Node* const value = object.find(key);
  if (value == nullptr) {
    reporter.report(rule::missing_key, object.range, "missing key " + quote(key));
  }
  return value;
}

std::string text_of(const Node& object, std::string_view key, Reporter& reporter) {
  const Node* const node = require(object, key, reporter);
  if (node == nullptr) return {};
  return std::string(yaml::read_text(*node, key, "a text", reporter).value_or(""));
}

/// Whether a line (an event or the last one) has what --stats adds.
bool has_times(const Node& line) {
  const Node* const search = line.find("search");
  return line.find("totals") != nullptr ||
         (search != nullptr && search->find("elapsed_us") != nullptr);
}

}  // namespace

bool is_log(std::string_view text) {
  return utf8::without_byte_order_mark(text).starts_with(
      concat(R"({"schema":")", events_schema, "\""));
}

std::optional<EventLog::Header> EventLog::read_header(std::string_view line) {
  Diagnostics diagnostics;
  Reporter reporter({}, diagnostics);
  Header header;
  if (const Node* const root = read_object(line, 1, reporter)) {
    const std::string found = text_of(*root, "schema", reporter);
    if (reporter.errors() == 0 && found != events_schema) {
      error_ = "its schema is " + quote(found) + ", expected " + quote(events_schema);
      return std::nullopt;
    }
    const std::string digest = text_of(*root, "digest", reporter);
    const std::string expected = to_hex(identity_of(catalog_));
    if (reporter.errors() == 0 && !is_foreign_ && digest != expected) {
      error_ = "it was made with another catalog, with the digest " + quote(digest) + "; that of " +
               quote(catalog_.file) + " is " + expected +
               "; --replay LOG CATALOG compares what both decide";
      return std::nullopt;
    }
    header.catalog = text_of(*root, "catalog", reporter);
    if (const Node* const delay = require(*root, "reactive_delay", reporter)) {
      header.reactive_delay =
          yaml::read_seconds(*delay, "reactive_delay", true, reporter).value_or(1);
    }
    if (const Node* const timeouts = root->find("timeouts")) {
      header.timeouts = yaml::read_boolean(*timeouts, "timeouts", reporter).value_or(true);
    }
    if (const Node* const situation = require(*root, "situation", reporter)) {
      header.situation = reader_.read_situation(known_part(*situation), reporter);
    }
  }
  if (!is_good(reporter, diagnostics)) return std::nullopt;
  return header;
}

std::optional<EventLog::Entry> EventLog::read_entry(std::string_view line, std::uint32_t number) {
  Diagnostics diagnostics;
  Reporter reporter({}, diagnostics);
  Entry entry;
  if (const Node* const root = read_object(line, number, reporter)) {
    if (has_times(*root)) {
      error_ = "it was made with --stats, and the times in it cannot be repeated";
      return std::nullopt;
    }
    if (root->find("error") == nullptr) entry = read_event(*root, reporter);
  }
  if (!is_good(reporter, diagnostics)) return std::nullopt;
  return entry;
}

const Node* EventLog::read_object(std::string_view line, std::uint32_t number, Reporter& reporter) {
  line_ = number;
  const Node* const root = json_.read(line, number);
  if (root != nullptr && root->kind == yaml::Kind::mapping) return root;
  reporter.report(rule::wrong_type, {},
                  root == nullptr ? json_.fault() : "it is not a JSON object");
  return nullptr;
}

EventLog::Entry EventLog::read_event(const Node& event, Reporter& reporter) {
  Entry entry;
  entry.is_event = true;
  if (const Node* const time = require(event, "time", reporter)) {
    entry.time = yaml::read_seconds(*time, "time", false, reporter).value_or(0);
  }
  if (const Node* const index = require(event, "index", reporter)) {
    const auto number = yaml::read_integer(*index, "index", 0, reporter);
    entry.index = static_cast<std::uint64_t>(number.value_or(0));
  }
  const std::string word = text_of(event, "verb", reporter);
  const std::optional<Verb> verb = find_word<Verb>(word);
  if (!verb) {
    reporter.report(rule::invalid_value, event.range, "there is no verb " + quote(word));
    return entry;
  }
  const VerbForm& form = form_of(*verb);
  entry.is_from_outside = text_of(event, "origin", reporter) == name_of(cbc::Origin::script);
  if (is_foreign_) {
    const Node* const name = event.find("name");
    entry.what = name == nullptr ? word : concat(word, " ", printable(name->text));
    if (form.is_decided && entry.is_from_outside) {
      entry.outcome = find_word<Outcome>(text_of(event, "outcome", reporter));
    }
    if (const Node* const running = event.find("running")) {
      for (const auto& [task, behavior] : running->entries) {
        entry.running.emplace_back(task->text, behavior->text);
      }
    }
    if (const std::string unknown = find_unknown(event, form);
        entry.is_from_outside && !unknown.empty()) {
      leave_out(concat(quote(catalog_.file), " has no ", unknown));
      return entry;
    }
  }
  if (entry.is_from_outside) {
    entry.step = read_step(event, *verb, reporter);
    entry.step->range = event.range;
    entry.step->time = entry.time;
  }
  return entry;
}

/// The task or behavior of the event that the catalog does not have, or nothing.
std::string EventLog::find_unknown(const Node& event, const VerbForm& form) const {
  using SubjectKind = VerbForm::SubjectKind;
  const Node* const task = event.find(form.subject == SubjectKind::task ? "name" : "task");
  if (task != nullptr && !catalog_.find_task(task->text)) return "task " + quote(task->text);
  const Node* const behavior = form.subject == SubjectKind::behavior ? event.find("name") : nullptr;
  if (behavior == nullptr || catalog_.find_behavior(behavior->text)) return {};
  return "behavior " + quote(behavior->text);
}

bool EventLog::is_known(const std::string& key, const Node& value) const {
  const auto variable = catalog_.find_variable(key);
  if (!variable) return catalog_.find_behavior(key).has_value();
  return catalog_.find_value(*variable, value.text).has_value();
}

/// A situation of a log without what the catalog lacks.
Node EventLog::known_part(const Node& situation) {
  Node known = situation;
  if (!is_foreign_) return known;
  std::erase_if(known.entries, [&](const auto& entry) {
    const auto& [key, value] = entry;
    if (is_known(key->text, *value)) return false;
    const std::string shown = value->plain ? value->text : concat('"', value->text, '"');
    leave_out(concat(quote(catalog_.file), " has no situation ", printable(key->text), ": ",
                     printable(shown)));
    return true;
  });
  return known;
}

void EventLog::leave_out(const std::string& what) {
  left_out_.push_back(concat("line ", line_, ": ", what));
}

Step EventLog::read_step(const Node& event, Verb verb, Reporter& reporter) {
  Step step;
  const VerbForm& form = form_of(verb);
  EventParts parts;
  parts.verb = verb;
  if (form.subject != VerbForm::SubjectKind::nothing) {
    const bool is_name = form.subject != VerbForm::SubjectKind::situation;
    parts.subject_key = is_name ? "name" : "situation";
    parts.task = event.find("task");
    if (parts.task == nullptr) parts.subject = require(event, parts.subject_key, reporter);
  }
  Node situation;
  if (form.subject == VerbForm::SubjectKind::situation && parts.subject != nullptr) {
    situation = known_part(*parts.subject);
    parts.subject = &situation;
  }
  if (form.has_priority) parts.priority = require(event, "priority", reporter);
  if (form.has_parameters) parts.parameters = event.find("parameters");
  if (form.has_cause) parts.cause = require(event, "cause", reporter);
  reader_.read_parts(parts, step, reporter);
  return step;
}

/// Keeps the first error.
bool EventLog::is_good(const Reporter& reporter, const Diagnostics& diagnostics) {
  if (reporter.errors() == 0) return true;
  for (const Diagnostic& finding : diagnostics.all()) {
    if (finding.severity != Severity::error) continue;
    error_ = finding.message;
    break;
  }
  return false;
}

}  // namespace cbc

#include "yaml/fields.h"

#include <algorithm>
#include <utility>

#include "cbc/rules.h"
#include "text/nearest.h"
#include "text/quote.h"
#include "text/utf8.h"

namespace cbc::yaml {
namespace {

// The place of a text without its quotes, if another one may be written there: it stands in one
// place of the tree only, and as it is, without escapes and on one line.
std::optional<Range> replaceable(const Node& node) {
  if (node.kind != Kind::scalar || node.shared) return std::nullopt;
  Range range = node.range;
  if (!node.plain) {
    ++range.begin.column;
    --range.end.column;
  }
  const bool as_it_is = range.begin.line == range.end.line &&
                        range.begin.column + utf8::count_characters(node.text) == range.end.column;
  return as_it_is ? std::optional(range) : std::nullopt;
}

// Writes an older key and its value in the present way; no edit where that is not possible.
std::vector<Edit> modernize(const Key& key, const Node& name, const Node& value) {
  const std::optional<Range> name_range = replaceable(name);
  if (!name_range) return {};
  std::vector<Edit> edits{{Edit::Kind::replace, *name_range, std::string(key.replaced_by)}};
  if (key.translate == nullptr || value.kind == Kind::null) return edits;
  const std::optional<std::string_view> translated = key.translate(value);
  const std::optional<Range> value_range = replaceable(value);
  if (!translated || !value_range) return {};
  edits.push_back({Edit::Kind::replace, *value_range, std::string(*translated)});
  return edits;
}

}  // namespace

bool Shape::has(std::string_view key) const {
  return std::any_of(keys.begin(), keys.end(),
                     [key](const Key& known) { return known.name == key; });
}

Fields::Fields(std::span<const Node* const> mappings, const Shape& shape, Reporter& reporter)
    : shape_(shape), reporter_(reporter), what_(shape.what), fields_(shape.keys.size()) {
  for (const Node* mapping : mappings) {
    for (const auto& [key, value] : mapping->entries) add(*key, *value);
  }
  report_older_names();
}

Fields::Fields(const Node& mapping, const Shape& shape, Reporter& reporter)
    : shape_(shape), reporter_(reporter), what_(shape.what), fields_(shape.keys.size()) {
  for (const auto& [key, value] : mapping.entries) add(*key, *value);
  report_older_names();
}

std::size_t Fields::place_of(std::string_view key) const {
  const auto found = std::find_if(shape_.keys.begin(), shape_.keys.end(),
                                  [key](const Key& known) { return known.name == key; });
  return static_cast<std::size_t>(found - shape_.keys.begin());
}

void Fields::add(const Node& key, const Node& value) {
  if (key.text.starts_with("x-")) {
    has_own_ = true;
    return;
  }
  const std::size_t place = place_of(key.text);
  if (place == fields_.size()) {
    unknown_.push_back({&key, &value, false});
    return;
  }
  Field& field = fields_[place];
  if (field.key == nullptr) {
    field = {&key, &value, false};
  } else {
    field.is_repeated = true;
    reporter_.report(rule::duplicate_key, key.range, quote(key.text) + " is given twice",
                     {reporter_.note(field.key->range, "first given here")});
  }
}

// An older name and the present one at once are one key given twice.
void Fields::report_older_names() {
  for (std::size_t place = 0; place < fields_.size(); ++place) {
    const Key& key = shape_.keys[place];
    Field& older = fields_[place];
    if (key.replaced_by.empty() || older.key == nullptr) continue;
    const Field& present = fields_[place_of(key.replaced_by)];
    const bool both = older.value->kind != Kind::null && present.value != nullptr &&
                      present.value->kind != Kind::null;
    if (!both) {
      // Beside the present name, even one without a value, or itself again, it cannot be renamed.
      std::vector<Edit> edits;
      if (present.key == nullptr && !older.is_repeated)
        edits = modernize(key, *older.key, *older.value);
      std::string written(key.replaced_by);
      if (key.translate != nullptr) {
        // Renamed only, it would say something else.
        if (const auto value = key.translate(*older.value)) written += ": " + std::string(*value);
      }
      reporter_.report(rule::deprecated_key, older.key->range,
                       quote(key.name) + " is an older name: write " + quote(written), {},
                       std::move(edits));
      continue;
    }
    const bool older_first = older.key->range.begin < present.key->range.begin;
    const Range& first = older_first ? older.key->range : present.key->range;
    const Range& second = older_first ? present.key->range : older.key->range;
    reporter_.report(
        rule::duplicate_key, second,
        quote(key.name) + ", an older name, and " + quote(key.replaced_by) + " are both given",
        {reporter_.note(first, "first given here")});
    older = {};
  }
}

const Node* Fields::find(std::string_view key) const {
  const Node* value = fields_[place_of(key)].value;
  return value == nullptr || value->kind == Kind::null ? nullptr : value;
}

bool Fields::has(std::string_view key) const { return fields_[place_of(key)].key != nullptr; }

const Range& Fields::range_of(std::string_view key) const {
  return fields_[place_of(key)].key->range;
}

const Node* Fields::require(std::string_view key, const Range& range) {
  if (const Node* value = find(key)) return value;
  if (const Node* value = adopt(key)) return value;
  const Field& field = fields_[place_of(key)];
  if (field.key != nullptr) {
    reporter_.report(rule::missing_key, field.key->range, quote(key) + " has no value");
  } else {
    reporter_.report(rule::missing_key, range, "missing key " + quote(key) + " in " + what_);
  }
  return nullptr;
}

const Node* Fields::adopt(std::string_view key) {
  for (auto field = unknown_.begin(); field != unknown_.end(); ++field) {
    if (field->value->kind == Kind::null || suggestion_for(field->key->text) != key) continue;
    reporter_.report(rule::missing_key, field->key->range,
                     "missing key " + quote(key) + " in " + what_ + ": " + quote(field->key->text) +
                         " is unknown" + did_you_mean(key));
    fields_[place_of(key)] = *field;
    unknown_.erase(field);
    return find(key);
  }
  return nullptr;
}

std::string_view Fields::suggestion_for(std::string_view key) const {
  std::vector<std::string_view> names;
  for (const Key& known : shape_.keys) names.push_back(known.name);
  const std::optional<std::string_view> name = nearest(key, names);
  if (!name) return {};
  const Key& known = shape_.keys[place_of(*name)];
  return known.replaced_by.empty() ? known.name : known.replaced_by;
}

void Fields::report_unknown(Severity severity) {
  for (const Field& field : unknown_) {
    const std::string& key = field.key->text;
    std::string message = "unknown key " + quote(key) + " in " + what_;
    const auto inner = std::find_if(shape_.inner.begin(), shape_.inner.end(),
                                    [&key](const Shape* shape) { return shape->has(key); });
    const std::string_view suggestion = suggestion_for(key);
    // A list under the name of what it lists ('task:' for 'tasks:') is at the right level.
    const bool is_singular = field.value->kind == Kind::sequence && suggestion == key + "s";
    if (inner != shape_.inner.end() && !is_singular) {
      message += ": it belongs to " + std::string((*inner)->what) + ", one level down";
    } else if (shape_.outer != nullptr && shape_.outer->has(key)) {
      message += ": it belongs to " + std::string(shape_.outer->what) + ", one level up";
    } else if (field.value->kind == Kind::null && key.find(':') != std::string::npos) {
      message += ": is a space missing after ':'?";
    } else if (!suggestion.empty()) {
      message += did_you_mean(suggestion);
    }
    reporter_.report_as(severity, rule::unknown_key, field.key->range, std::move(message));
  }
}

}  // namespace cbc::yaml

#include "core/yaml/values.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/diagnostic/rules.h"
#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc::yaml {

void report_duplicate_keys(const Node& mapping, Reporter& reporter) {
  if (mapping.entries.size() < 2) return;
  std::unordered_map<std::string_view, const Node*> known;
  for (const auto& entry : mapping.entries) {
    const Node& key = *entry.first;
    const auto [first, is_new] = known.try_emplace(key.text, &key);
    if (is_new) continue;
    reporter.report(rule::duplicate_key, key.range, quote(key.text) + " is given twice",
                    {reporter.note(first->second->range, "first given here")});
  }
}

bool stands_in(const Node& node, std::string_view text) {
  return std::any_of(node.items.begin(), node.items.end(),
                     [text](const Node* item) { return item->text == text; }) ||
         std::any_of(node.entries.begin(), node.entries.end(),
                     [text](const auto& entry) { return entry.first->text == text; });
}

namespace {

std::string must_be(std::string_view what, std::string_view expected) {
  return quote(what) + " must be " + std::string(expected);
}

// Reports why a number in a plain scalar could not be read.
void report_number(const Node& node, std::string_view what, std::string_view expected,
                   std::string_view precision, DecimalError error, Reporter& reporter) {
  switch (error) {
    case DecimalError::no_error:
      break;
    case DecimalError::not_a_number:
      report_wrong_type(node, what, expected, reporter);
      break;
    case DecimalError::out_of_range:
      reporter.report(rule::invalid_value, node.range,
                      must_be(what, expected) + ", found " + describe(node));
      break;
    case DecimalError::too_precise:
      reporter.report(
          rule::invalid_value, node.range,
          quote(what) + " may have " + std::string(precision) + ", found " + describe(node));
      break;
  }
}

// The two booleans in one spelling.
struct Boolean {
  std::string_view yes;
  std::string_view no;
};
constexpr Boolean booleans[] = {
    {"true", "false"}, {"True", "False"}, {"TRUE", "FALSE"}, {"yes", "no"},
    {"Yes", "No"},     {"YES", "NO"},     {"on", "off"},     {"On", "Off"},
    {"ON", "OFF"},     {"y", "n"},        {"Y", "N"},
};

// The booleans in the spelling of a node, or nullptr if the node is no boolean.
const Boolean* find_boolean(const Node& node) {
  if (node.kind != Kind::scalar || !node.plain) return nullptr;
  const auto* const found =
      std::find_if(std::begin(booleans), std::end(booleans), [&node](const Boolean& boolean) {
        return node.text == boolean.yes || node.text == boolean.no;
      });
  return found == std::end(booleans) ? nullptr : found;
}

}  // namespace

std::string describe(const Node& node) {
  switch (node.kind) {
    case Kind::null:
      return "nothing";
    case Kind::sequence:
      return node.items.empty() ? "an empty list" : "a list";
    case Kind::mapping:
      return node.entries.empty() ? "an empty mapping" : "a mapping";
    case Kind::scalar:
      break;
  }
  if (node.text.empty()) return "an empty text";
  return node.plain ? quote(node.text) : quote(node.text) + " in quotes";
}

std::optional<bool> to_boolean(const Node& node) {
  const Boolean* boolean = find_boolean(node);
  if (boolean == nullptr) return std::nullopt;
  return node.text == boolean->yes;
}

std::optional<std::string_view> opposite(const Node& node) {
  const Boolean* boolean = find_boolean(node);
  if (boolean == nullptr) return std::nullopt;
  return node.text == boolean->yes ? boolean->no : boolean->yes;
}

void report_wrong_type(const Node& node, std::string_view what, std::string_view expected,
                       Reporter& reporter) {
  reporter.report(rule::wrong_type, node.range,
                  must_be(what, expected) + ", found " + describe(node));
}

const Node* read_list(const Node& node, std::string_view what, std::string_view expected,
                      Reporter& reporter) {
  if (node.kind == Kind::sequence) return &node;
  report_wrong_type(node, what, expected, reporter);
  return nullptr;
}

const Node* read_mapping(const Node& node, std::string_view what, std::string_view expected,
                         Reporter& reporter) {
  if (node.kind == Kind::mapping) return &node;
  report_wrong_type(node, what, expected, reporter);
  return nullptr;
}

std::optional<std::string_view> read_text(const Node& node, std::string_view what,
                                          std::string_view expected, Reporter& reporter) {
  if (node.kind == Kind::scalar) return node.text;
  report_wrong_type(node, what, expected, reporter);
  return std::nullopt;
}

std::optional<std::string_view> read_name(const Node& node, std::string_view what,
                                          std::string_view expected, Reporter& reporter) {
  const std::optional<std::string_view> text = read_text(node, what, expected, reporter);
  if (text && text->empty()) {
    reporter.report(rule::invalid_value, node.range,
                    must_be(what, expected) + ", found " + describe(node));
    return std::nullopt;
  }
  return text;
}

std::optional<bool> read_boolean(const Node& node, std::string_view what, Reporter& reporter) {
  const std::optional<bool> value = to_boolean(node);
  if (!value) report_wrong_type(node, what, "true or false", reporter);
  return value;
}

std::optional<Millionths> read_percent(const Node& node, std::string_view what,
                                       Reporter& reporter) {
  constexpr std::string_view expected = "a number from 0 to 100 (percent)";
  if (node.kind != Kind::scalar || !node.plain) {
    report_wrong_type(node, what, expected, reporter);
    return std::nullopt;
  }
  const Decimal decimal = parse_percent(node.text);
  report_number(node, what, expected, "at most 4 decimals", decimal.error, reporter);
  if (decimal.error != DecimalError::no_error) return std::nullopt;
  return static_cast<Millionths>(decimal.value);
}

std::optional<Microseconds> read_seconds(const Node& node, std::string_view what, bool positive,
                                         Reporter& reporter) {
  const auto expected = [positive] {
    return concat("a number of seconds ", positive ? "above 0, up to " : "from 0 to ",
                  longest_time / second);
  };
  if (node.kind != Kind::scalar || !node.plain) {
    report_wrong_type(node, what, expected(), reporter);
    return std::nullopt;
  }
  Decimal decimal = parse_seconds(node.text);
  if (positive && decimal.error == DecimalError::no_error && decimal.value == 0) {
    decimal.error = DecimalError::out_of_range;
  }
  if (decimal.error == DecimalError::no_error) return decimal.value;
  report_number(node, what, expected(), "at most 6 decimals", decimal.error, reporter);
  return std::nullopt;
}

std::optional<std::int32_t> read_integer(const Node& node, std::string_view what,
                                         std::int32_t lowest, Reporter& reporter) {
  constexpr std::int32_t highest = std::numeric_limits<std::int32_t>::max();
  const auto expected = [=] { return concat("an integer from ", lowest, " to ", highest); };
  if (node.kind != Kind::scalar || !node.plain) {
    report_wrong_type(node, what, expected(), reporter);
    return std::nullopt;
  }
  const Decimal decimal = parse_integer(node.text, lowest, highest);
  if (decimal.error == DecimalError::no_error) return static_cast<std::int32_t>(decimal.value);
  report_number(node, what, expected(), {}, decimal.error, reporter);
  return std::nullopt;
}

std::optional<std::size_t> read_choice(const Node& node, std::string_view what,
                                       std::span<const std::string_view> choices,
                                       Reporter& reporter) {
  if (node.kind == Kind::scalar) {
    const auto found = std::find(choices.begin(), choices.end(), node.text);
    if (found != choices.end()) return static_cast<std::size_t>(found - choices.begin());
  }
  std::string expected;
  std::size_t place = 0;
  for (const std::string_view choice : choices) {
    if (place > 0) expected += place + 1 == choices.size() ? " or " : ", ";
    expected += choice;
    ++place;
  }
  const std::optional<std::string_view> text = read_text(node, what, expected, reporter);
  if (!text) return std::nullopt;
  std::string message = must_be(what, expected) + ", found " + describe(node);
  message += did_you_mean(nearest(*text, choices));
  reporter.report(rule::invalid_value, node.range, std::move(message));
  return std::nullopt;
}

namespace {

// The place of a text without its quotes, if another text may be written there: it has one place in
// the tree only, and stands there literally, without escapes and on one line.
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

// Edits that write an older key and its value in the present way; none if that is not possible.
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

/// The name of a key today.
std::string_view present_name(const Key& key) {
  return key.replaced_by.empty() ? key.name : key.replaced_by;
}

}  // namespace

bool Shape::has(std::string_view key) const {
  return std::any_of(keys.begin(), keys.end(),
                     [key](const Key& known) { return known.name == key; });
}

Fields::Fields(std::span<const Node* const> mappings, const Shape& shape, Reporter& reporter)
    : shape_(shape), reporter_(reporter), what_(shape.what) {
  for (const Node* mapping : mappings) add_all(*mapping);
  report_older_names();
}

Fields::Fields(const Node& mapping, const Shape& shape, Reporter& reporter)
    : shape_(shape), reporter_(reporter), what_(shape.what) {
  add_all(mapping);
  report_older_names();
}

void Fields::add_all(const Node& mapping) {
  // A mapping in braces begins with the brace.
  is_block_ =
      !mapping.entries.empty() && mapping.entries.front().first->range.begin == mapping.range.begin;
  for (const auto& [key, value] : mapping.entries) {
    // What follows is about another entry, so more findings about it would be consequences.
    if (begins_entry(mapping, *key)) break;
    add(*key, *value);
  }
}

/// Reports a key that begins another entry of a list, but for its '-': the one that the mapping
/// begins with, for the second time.
bool Fields::begins_entry(const Node& mapping, const Node& key) {
  const Node& first = *mapping.entries.front().first;
  if (!shape_.is_entry || !is_block_ || &key == &first || key.text != first.text) return false;
  reporter_.report(rule::duplicate_key, key.range,
                   quote(key.text) + " is given twice: is '-' missing before it? '- " + key.text +
                       ":' begins another entry",
                   {reporter_.note(first.range, "first given here")});
  return true;
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
  if (place == shape_.keys.size()) {
    unknown_.push_back({place, &key, &value, false});
    return;
  }
  const auto known = std::find_if(fields_.begin(), fields_.end(),
                                  [place](const Field& field) { return field.place == place; });
  if (known == fields_.end()) {
    fields_.push_back({place, &key, &value, false});
  } else {
    known->is_repeated = true;
    reporter_.report(rule::duplicate_key, key.range, quote(key.text) + " is given twice",
                     {reporter_.note(known->key->range, "first given here")});
  }
}

// An older name and the present one at once are one key given twice.
void Fields::report_older_names() {
  for (const Key& key : shape_.keys) {
    if (key.replaced_by.empty()) continue;
    const Field* const older = find_field(key.name);
    if (older == nullptr) continue;
    const Field* const present = find_field(key.replaced_by);
    const bool both = older->value->kind != Kind::null && present != nullptr &&
                      present->value->kind != Kind::null;
    if (!both) {
      // It cannot be renamed if the present name is there, even without a value, or if it is
      // repeated.
      std::vector<Edit> edits;
      if (present == nullptr && !older->is_repeated)
        edits = modernize(key, *older->key, *older->value);
      std::string written(key.replaced_by);
      if (key.translate != nullptr) {
        // A new name alone would change the meaning.
        if (const auto value = key.translate(*older->value)) written += ": " + std::string(*value);
      }
      reporter_.report(rule::deprecated_key, older->key->range,
                       quote(key.name) + " is an older name: write " + quote(written), {},
                       std::move(edits));
      continue;
    }
    const bool older_first = older->key->range.begin < present->key->range.begin;
    const Range& first = older_first ? older->key->range : present->key->range;
    const Range& second = older_first ? present->key->range : older->key->range;
    reporter_.report(
        rule::duplicate_key, second,
        quote(key.name) + ", an older name, and " + quote(key.replaced_by) + " are both given",
        {reporter_.note(first, "first given here")});
    fields_.erase(fields_.begin() + (older - fields_.data()));
  }
}

const Fields::Field* Fields::find_field(std::string_view key) const {
  for (const Field& field : fields_) {
    if (shape_.keys[field.place].name == key) return &field;
  }
  return nullptr;
}

const Node* Fields::find(std::string_view key) const {
  const Field* const field = find_field(key);
  return field == nullptr || field->value->kind == Kind::null ? nullptr : field->value;
}

bool Fields::has(std::string_view key) const { return find_field(key) != nullptr; }

const Range& Fields::range_of(std::string_view key) const { return find_field(key)->key->range; }

const Node* Fields::require(std::string_view key, const Range& range) {
  if (const Node* value = find(key)) return value;
  if (const Node* value = adopt(key)) return value;
  if (const Field* const field = find_field(key)) {
    reporter_.report(rule::missing_key, field->key->range, quote(key) + " has no value");
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
    std::erase_if(fields_,
                  [place = place_of(key)](const Field& one) { return one.place == place; });
    fields_.push_back({place_of(key), field->key, field->value, false});
    unknown_.erase(field);
    return find(key);
  }
  return nullptr;
}

std::string_view Fields::suggestion_for(std::string_view key) const {
  std::vector<std::string_view> names;
  for (const Key& known : shape_.keys) names.push_back(known.name);
  const std::optional<std::string_view> name =
      nearest(key, names, [this](std::string_view known) { return is_given(known); });
  return name ? present_name(shape_.keys[place_of(*name)]) : std::string_view();
}

bool Fields::is_given(std::string_view key) const {
  const std::string_view present = present_name(shape_.keys[place_of(key)]);
  return std::any_of(fields_.begin(), fields_.end(), [&](const Field& field) {
    return present_name(shape_.keys[field.place]) == present;
  });
}

void Fields::report_unknown(UnknownKeys treatment) {
  for (const Field& field : unknown_) {
    const std::string& key = field.key->text;
    std::string message = "unknown key " + quote(key) + " in " + what_;
    Standing standing{rule::unknown_key.severity};
    const auto inner = std::find_if(shape_.inner.begin(), shape_.inner.end(),
                                    [&key](const Shape* shape) { return shape->has(key); });
    const auto hint = std::find_if(shape_.hints.begin(), shape_.hints.end(),
                                   [&key](const Hint& known) { return known.key == key; });
    const std::string_view suggestion = suggestion_for(key);
    // A list under the name of what it lists ('task:' for 'tasks:') is at the right level.
    const bool is_singular = field.value->kind == Kind::sequence && suggestion == key + "s";
    if (hint != shape_.hints.end()) {
      message += ": " + std::string(hint->advice);
      if (hint->is_constraint) standing.severity = Severity::error;
    } else if (inner != shape_.inner.end() && !is_singular) {
      message += ": it belongs to " + std::string((*inner)->what) + ", one level down";
    } else if (shape_.outer != nullptr && shape_.outer->has(key)) {
      message += ": it belongs to " + std::string(shape_.outer->what) + ", one level up";
    } else if (field.value->kind == Kind::null && key.find(':') != std::string::npos) {
      message += ": is a space missing after ':'?";
      const std::string_view before = std::string_view(key).substr(0, key.find(':'));
      if (shape_.has(before) || !suggestion_for(before).empty())
        standing.severity = Severity::error;
    } else if (!suggestion.empty()) {
      message += did_you_mean(suggestion);
      standing.severity = Severity::error;
    } else if (shape_.tells_keys) {
      message += "; there are " + list_keys(shape_);
    }
    if (treatment == UnknownKeys::refused) standing = {Severity::error, true};
    reporter_.report_as(standing, rule::unknown_key, field.key->range, std::move(message));
  }
}

std::string list_keys(const Shape& shape) {
  std::vector<std::string> keys;
  for (const Key& key : shape.keys) {
    if (key.replaced_by.empty()) keys.push_back(quote(key.name));
  }
  return list_with_and(keys);
}

ChosenKey choose_key(const Fields& fields, std::span<const std::string_view> keys,
                     std::string_view what, Reporter& reporter) {
  // The first two in the order of the text.
  std::string_view first;
  std::string_view second;
  std::string_view without_value;
  for (std::string_view key : keys) {
    if (!fields.has(key)) continue;
    if (fields.find(key) == nullptr) {
      without_value = key;
      continue;
    }
    const auto is_before = [&](std::string_view other) {
      return other.empty() || fields.range_of(key) < fields.range_of(other);
    };
    if (is_before(first)) std::swap(first, key);
    if (!key.empty() && is_before(second)) second = key;
  }
  if (second.empty()) return {first, false, first.empty() ? without_value : std::string_view()};
  const std::string advice = fields.is_block()
                                 ? concat("begin another entry with '- ", second, ":'")
                                 : "each needs an entry of its own";
  reporter.report(rule::invalid_value, fields.range_of(second),
                  concat(what, ", found ", quote(first), " and ", quote(second), "; ", advice),
                  {reporter.note(fields.range_of(first), "the first one is here")});
  return {{}, true, {}};
}

}  // namespace cbc::yaml

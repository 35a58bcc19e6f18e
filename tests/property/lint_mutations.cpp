#include "lint_mutations.h"

#include <algorithm>

namespace cbc::mutation {
namespace {

/// Number of letters to insert, delete, replace or swap with their neighbors.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> rows(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        rows[i][j] = i + j;
        continue;
      }
      const std::size_t replaced = rows[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      rows[i][j] = std::min({rows[i - 1][j] + 1, rows[i][j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        rows[i][j] = std::min(rows[i][j], rows[i - 2][j - 2] + 1);
      }
    }
  }
  return rows[a.size()][b.size()];
}

/// Whether two names of one length differ in one letter of a word of at most two letters: that
/// makes another word.
bool differ_in_a_short_word(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  std::size_t place = 0;
  while (place < a.size() && a[place] == b[place]) ++place;
  if (a.substr(std::min(place + 1, a.size())) != b.substr(std::min(place + 1, b.size()))) {
    return false;
  }
  const std::string_view separators = "_-. ";
  const std::size_t before = a.substr(0, place).find_last_of(separators);
  const std::size_t begin = before == std::string_view::npos ? 0 : before + 1;
  const std::size_t end = std::min(a.find_first_of(separators, place), a.size());
  return end - begin <= 2;
}

bool is_letter(char byte) { return (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z'); }

}  // namespace

std::string spaces(std::size_t count) { return std::string(count, ' '); }

std::string in_quotes(std::string_view name) { return "'" + std::string(name) + "'"; }

Expected at(const Lines& lines, std::string_view rule, std::size_t line, std::size_t column,
            std::string says) {
  return {rule, {line}, lines.shown_column(line, column), std::move(says)};
}

std::size_t add_field(Lines& lines, const Item& mapping, const std::string& content) {
  lines.insert_after(mapping.last_line, spaces(mapping.column) + content);
  return mapping.last_line + 1;
}

std::size_t remove_field(Lines& lines, const Item& mapping, const Field& field) {
  std::size_t first = mapping.line;
  if (&field == &mapping.fields.front()) {
    // The dash goes to the next field.
    const Field& next = mapping.fields[1];
    lines.set(next.line, lines[field.line].substr(0, mapping.column) +
                             lines[next.line].substr(mapping.column));
    first = next.line - (field.last_line - field.line + 1);
  }
  lines.erase(field.line, field.last_line);
  return first;
}

void set_value(Lines& lines, const Field& field, std::string_view now) {
  const std::string& line = lines[field.value.line];
  const std::size_t begin = field.value.column;
  const bool has_quotes = line[begin] == '"' || line[begin] == '\'';
  lines.replace(field.value.line, begin, field.value.text.size() + (has_quotes ? 2 : 0), now);
}

std::vector<std::string> copy_entry(const Lines& lines, const Item& list, const Item& entry) {
  std::vector<std::string> copy;
  for (std::size_t line = entry.line; line <= entry.last_line; ++line) copy.push_back(lines[line]);
  // The first entry of a list within a list shares its line with another dash.
  copy.front().replace(0, list.column, spaces(list.column));
  return copy;
}

std::string misspell(const std::string& word, Random& random) {
  std::string result = word;
  const std::size_t place = random.below(word.size());
  if (!is_letter(word[place])) return word;
  switch (random.below(4)) {
    case 0:
      result.erase(place, 1);
      break;
    case 1:
      result.insert(place, 1, word[place]);
      break;
    case 2:
      result[place] = word[place] >= 'a' ? 'q' : 'Q';
      break;
    default:
      if (place == 0 || !is_letter(word[place - 1])) return word;
      std::swap(result[place], result[place - 1]);
  }
  return result;
}

bool is_clear_misspelling(std::string_view name, std::string_view meant,
                          const std::vector<std::string_view>& words) {
  if (edit_distance(name, meant) != 1 || differ_in_a_short_word(name, meant)) return false;
  return std::all_of(words.begin(), words.end(), [&](std::string_view word) {
    return word == meant || edit_distance(name, word) > 1;
  });
}

std::vector<PlacedField> all_fields(const CatalogOutline& catalog) {
  std::vector<PlacedField> fields;
  for (const Mapping& mapping : catalog.mappings()) {
    for (const Field& field : mapping.item->fields) {
      fields.push_back({mapping.shape, mapping.item, &field});
    }
  }
  return fields;
}

}  // namespace cbc::mutation

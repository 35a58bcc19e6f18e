#include "core/check/allow_comments.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <unordered_map>
#include <utility>

#include "core/diagnostic/rules.h"
#include "core/support/wording.h"
#include "core/yaml/source.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

constexpr std::string_view comment_mark = "cbc:";
constexpr std::string_view allow_verb = "allow";
constexpr std::string_view reason_mark = "--";

/// Lines, counted from 1, the last one included.
struct Lines {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// One rule in a comment.
struct Allow {
  const Rule* rule = nullptr;
  Range range;  ///< of its name
  Lines lines;  ///< on which findings are allowed
  bool is_used = false;
};

/// Tells which lines the comments of a text are about.
class Scopes {
 public:
  explicit Scopes(const std::vector<yaml::SourceLine>& lines)
      : lines_(lines), last_content_(lines.size() + 1), entries_(lines.size() + 1) {
    for (std::size_t number = 1; number <= lines.size(); ++number) {
      last_content_[number] = lines[number - 1].has_content ? number : last_content_[number - 1];
    }
    find_entries();
  }

  /// Those that the comment of a line is about. Any two results are disjoint, or one contains the
  /// other.
  [[nodiscard]] Lines of_comment(std::size_t number) const {
    if (lines_[number - 1].has_content) return {number, number};
    // Comments above are about the same entry, and this one can allow findings about them.
    return {last_content_[number] + 1, std::max(number, entries_[number])};
  }

 private:
  /// An entry ends before the next one that is not deeper.
  void find_entries() {
    struct Entry {
      std::size_t depth = 0;
      std::size_t number = 0;
    };
    std::vector<Entry> below;  // the entries that end the ones above, the nearest last
    std::size_t last_line = 0;
    for (std::size_t number = lines_.size(); number > 0; --number) {
      entries_[number] = last_line;
      const std::optional<std::size_t> depth = lines_[number - 1].depth;
      if (!depth) continue;
      while (!below.empty() && below.back().depth > *depth) below.pop_back();
      last_line = last_content_[below.empty() ? lines_.size() : below.back().number - 1];
      below.push_back({*depth, number});
    }
  }

  const std::vector<yaml::SourceLine>& lines_;
  // By line, which count from 1:
  std::vector<std::size_t> last_content_;  ///< the last line up to this one with content, or 0
  std::vector<std::size_t> entries_;       ///< the last line of the entry that begins below, or 0
};

/// Reads the comments of a file that are for this program, in order.
class CommentReader {
 public:
  CommentReader(std::string_view text, Reporter& reporter)
      : text_(text), positions_(text), reporter_(reporter) {}

  std::vector<Allow> read(const yaml::Document* document) {
    // Most files have no such comment, and need no closer look.
    if (text_.find(comment_mark) == std::string_view::npos) return {};
    const std::vector<yaml::SourceLine> lines = yaml::split_lines(text_, document);
    const Scopes scopes(lines);
    for (std::size_t number = 1; number <= lines.size(); ++number) {
      const yaml::SourceLine& line = lines[number - 1];
      if (line.comment) read_comment(*line.comment, line.end, scopes.of_comment(number));
    }
    return std::move(allows_);
  }

 private:
  void read_comment(std::size_t begin, std::size_t end, const Lines& lines) {
    next_ = begin + 1;
    end_ = end;
    skip_blanks();
    if (!rest().starts_with(comment_mark)) return;
    next_ += comment_mark.size();
    skip_blanks();
    const std::string_view word = next_word();
    if (word != allow_verb) {
      report_other_word(word, begin);
    } else if (!read_rules(lines)) {
      report(range_of(text_.substr(begin, end - begin)),
             "the comment names no rule: expected 'cbc: allow RULE'");
    }
  }

  /// Returns whether there were any names.
  bool read_rules(const Lines& lines) {
    for (bool is_first = true;; is_first = false) {
      while (next_ < end_ && (is_blank(text_[next_]) || text_[next_] == ',')) ++next_;
      if (is_at_end()) return !is_first;
      const std::string_view name = next_word();
      const Rule* rule = find_rule(name);
      if (rule == nullptr) {
        report(range_of(name), names_.describe_unknown(name));
      } else {
        allows_.push_back({rule, range_of(name), lines});
      }
      skip_blanks();
      if (is_at_end()) return true;
      if (text_[next_] == ',') continue;
      // After an unknown name, one finding is enough.
      const std::string_view other = next_word();
      if (rule != nullptr) {
        report(range_of(other),
               "expected ',' and another rule, or '-- ' and a reason, found " + quote(other));
      }
      return true;
    }
  }

  void report_other_word(std::string_view word, std::size_t begin) {
    if (word.empty()) {
      report(range_of(text_.substr(begin, end_ - begin)),
             "the comment is empty: expected 'cbc: allow RULE'");
      return;
    }
    const std::string_view known[] = {allow_verb};
    std::string message = "expected 'allow' after 'cbc:', found " + quote(word);
    if (nearest(word, known)) message += "; did you mean 'allow'?";
    report(range_of(word), std::move(message));
  }

  void report(const Range& range, std::string message) {
    reporter_.report(rule::unknown_rule, range, std::move(message));
  }

  static bool is_blank(char byte) { return byte == ' ' || byte == '\t'; }

  [[nodiscard]] std::string_view rest() const { return text_.substr(next_, end_ - next_); }

  [[nodiscard]] bool is_at_end() const { return next_ == end_ || rest().starts_with(reason_mark); }

  void skip_blanks() {
    while (next_ < end_ && is_blank(text_[next_])) ++next_;
  }

  /// The word that begins here, up to a blank or a comma; empty if there is none.
  std::string_view next_word() {
    const std::size_t begin = next_;
    while (next_ < end_ && !is_blank(text_[next_]) && text_[next_] != ',') ++next_;
    return text_.substr(begin, next_ - begin);
  }

  [[nodiscard]] Range range_of(std::string_view piece) const {
    const auto begin = static_cast<std::size_t>(piece.data() - text_.data());
    return {positions_.at(begin), positions_.at(begin + piece.size())};
  }

  std::string_view text_;
  PositionMap positions_;
  Reporter& reporter_;
  RuleNames names_;
  std::vector<Allow> allows_;
  std::size_t next_ = 0;  // in the comment that is being read
  std::size_t end_ = 0;
};

/// Moves the findings that no comment allows from one collection to another.
void filter(Diagnostics& findings, std::vector<Allow>& allows, Diagnostics& kept) {
  findings.sort();
  std::unordered_map<const Rule*, std::vector<Allow*>> open;  // by rule, the innermost last
  auto next = allows.begin();
  for (Diagnostic& finding : findings.release()) {
    const std::size_t line = finding.range.begin.line;
    for (; next != allows.end() && next->lines.first <= line; ++next) {
      open[next->rule].push_back(&*next);
    }
    const Rule* rule = find_rule(finding.rule);
    std::vector<Allow*>& candidates = open[rule];
    while (!candidates.empty() && candidates.back()->lines.last < line) candidates.pop_back();
    if (candidates.empty() || is_fixed(finding)) {
      kept.add(std::move(finding));
    } else {
      candidates.back()->is_used = true;
    }
  }
}

}  // namespace

std::vector<Diagnostic> apply_allow_comments(std::vector<Diagnostic> findings,
                                             const CommentedFile& file) {
  Diagnostics found;
  for (Diagnostic& finding : findings) found.add(std::move(finding));
  Diagnostics kept;
  Reporter reporter(file.file, kept);
  CommentReader reader(utf8::without_byte_order_mark(file.text), reporter);
  std::vector<Allow> allows = reader.read(file.document);
  filter(found, allows, kept);
  for (const Allow& allow : allows) {
    if (allow.rule->is_fixed) {
      reporter.report(rule::unused_allow, allow.range, describe_fixed(*allow.rule));
    } else if (!allow.is_used && file.is_complete) {
      reporter.report(rule::unused_allow, allow.range,
                      "no finding of rule " + quote(allow.rule->name) + " needs this comment");
    }
  }
  kept.sort();
  return kept.release();
}

std::vector<Diagnostic> control_findings(std::vector<Diagnostic> findings, CommentedFile file,
                                         const SeveritySettings& settings) {
  // Past the node limit, the finding that a comment allows may just not have been found.
  file.is_complete = file.is_complete &&
                     std::none_of(findings.begin(), findings.end(), [](const Diagnostic& finding) {
                       return finding.rule == rule::undecided;
                     });
  std::vector<Diagnostic> reported;
  for (Diagnostic& finding : apply_allow_comments(std::move(findings), file)) {
    const std::optional<Severity> severity = settings.severity_of(finding);
    if (!severity) continue;
    finding.severity = *severity;
    reported.push_back(std::move(finding));
  }
  return reported;
}

}  // namespace cbc

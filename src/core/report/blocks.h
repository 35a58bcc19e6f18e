#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/diagnostic/diagnostic.h"
#include "core/report/table.h"
#include "core/words/layout.h"

// A command says once what it found out, as blocks; each way to render them is written once, too.

namespace cbc {

/// A report as it grows, block by block. Text is for terminals, TablePage (page/table_page.h) is
/// HTML.
class Blocks {
 public:
  /// `columns`: of the terminal; 0: no limit.
  explicit Blocks(const Style& style, std::size_t columns = 0) : style_(style), columns_(columns) {}
  virtual ~Blocks() = default;

  /// Adds a line; an empty one stands between blocks.
  void line(std::string_view line) { add_line({}, line); }
  template <typename... Args>
  void line(fmt::format_string<Args...> form, Args&&... args) {
    line(std::string_view(fmt::format(form, std::forward<Args>(args)...)));
  }
  /// The same in a color.
  void painted(std::string_view color, std::string_view line) { add_line(color, line); }
  template <typename... Args>
  void painted(std::string_view color, fmt::format_string<Args...> form, Args&&... args) {
    painted(color, std::string_view(fmt::format(form, std::forward<Args>(args)...)));
  }
  /// The first ones of some lines, and how many more there are.
  void list(const std::vector<std::string>& lines, std::size_t most, std::string_view indent = "  ",
            std::string_view color = {});
  /// What the report, or a large part of it, is about: "robot.yaml, 3 missions".
  virtual void heading(std::string_view heading) = 0;
  /// An empty line, and a title.
  virtual void title(std::string_view title) = 0;
  /// Sentences, as wide as tables at most.
  virtual void paragraph(std::string_view sentences) = 0;
  /// `kind`: how a page names the table in its style.
  virtual void table(const Table& table, std::string_view kind = {}) = 0;

  [[nodiscard]] const Style& style() const { return style_; }
  [[nodiscard]] std::size_t columns() const { return columns_; }

 private:
  virtual void add_line(std::string_view color, std::string_view line) = 0;

  Style style_;
  std::size_t columns_;
};

/// A report for people, in a terminal or a file.
class Text final : public Blocks {
 public:
  using Blocks::Blocks;

  void heading(std::string_view heading) override;
  void title(std::string_view title) override;
  void paragraph(std::string_view sentences) override;
  void table(const Table& table, std::string_view kind = {}) override;
  /// Adds whole lines, as they are.
  void add(std::string_view lines) { text_ += lines; }

  [[nodiscard]] bool is_empty() const { return text_.empty(); }
  /// The text so far, which then begins anew.
  [[nodiscard]] std::string take() { return std::exchange(text_, {}); }

 private:
  /// Where the line has to be broken, the rest stands two columns further to the right than its
  /// beginning.
  void add_line(std::string_view color, std::string_view line) override;

  std::string text_;
};

/// A way to write what a command found out.
template <typename Result>
struct ReportFormat {
  std::string_view name;
  std::string (*write)(const Result& result, const Style& style, std::size_t columns);
};

/// Blocks as text. `add`: adds those of a result.
template <auto add>
constexpr auto as_text = [](const auto& result, const Style& style, std::size_t columns) {
  Text text(style, columns);
  add(result, text);
  return text.take();
};

/// What looks the same everywhere.
template <auto to_text>
constexpr auto for_programs = [](const auto& result, const Style& /*style*/,
                                 std::size_t /*columns*/) { return to_text(result); };

}  // namespace cbc

#pragma once

#include <string>
#include <string_view>

#include "core/report/blocks.h"

namespace cbc {

/// A self-contained HTML page of headings, paragraphs and tables, without script: what `body` has,
/// which is HTML, below its title, which is text.
[[nodiscard]] std::string table_page(std::string_view title, std::string_view body);

/// A report as such a page.
class TablePage final : public Blocks {
 public:
  TablePage() : Blocks(plain_style()) {}

  void heading(std::string_view heading) override { add_element("h2", heading); }
  void title(std::string_view title) override { add_element("h3", title); }
  void paragraph(std::string_view sentences) override { add_element("p", sentences); }
  void table(const Table& table, std::string_view kind) override { body_ += table.html(kind); }
  /// Adds HTML, as it is.
  void add(std::string_view html) { body_ += html; }

  [[nodiscard]] std::string page(std::string_view title) const { return table_page(title, body_); }

 private:
  void add_element(std::string_view element, std::string_view text);
  void add_line(std::string_view /*color*/, std::string_view line) override {
    if (!line.empty()) add_element("p", line);
  }

  std::string body_;
};

}  // namespace cbc

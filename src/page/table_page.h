#pragma once

#include <string>
#include <string_view>

namespace cbc {

/// A self-contained HTML page of headings, paragraphs and tables, without script: what `body` has,
/// which is HTML, below its title, which is text.
[[nodiscard]] std::string table_page(std::string_view title, std::string_view body);

}  // namespace cbc

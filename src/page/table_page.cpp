#include "page/table_page.h"

#include <fmt/format.h>

#include "core/support/wording.h"
#include "page_files.h"

namespace cbc {

std::string table_page(std::string_view title, std::string_view body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src {0}; "
      "base-uri 'none'; form-action 'none'\">\n"
      "<title>{1}</title>\n<style>{2}</style>\n</head>\n<body>\n<main>\n<h1>{1}</h1>\n{3}"
      "</main>\n</body>\n</html>\n",
      tables_style_hash, xml_text(title), tables_style, body);
}

void TablePage::add_element(std::string_view element, std::string_view text) {
  body_ += fmt::format("<{0}>{1}</{0}>\n", element, xml_text(without_indentation(text)));
}

}  // namespace cbc

#pragma once

#include <set>
#include <string>
#include <string_view>

namespace cbc::manual {

/// The source of a page of man/.
[[nodiscard]] std::string read_page(const std::string& name);
void write_page(const std::string& name, const std::string& text);

/// The part of a page between two lines; fails the test and is empty if one is not there.
[[nodiscard]] std::string_view between(std::string_view page, std::string_view first,
                                       std::string_view last);

/// The part of a page under a heading of a subsection (".Ss"), up to the next heading.
[[nodiscard]] std::string_view subsection(std::string_view page, std::string_view title);

/// The first words of the items of lists that are marked up with a macro: ".It Cm WORD ...".
[[nodiscard]] std::set<std::string> items(std::string_view part, std::string_view macro);

}  // namespace cbc::manual

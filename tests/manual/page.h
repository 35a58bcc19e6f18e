#pragma once

#include <set>
#include <string>
#include <string_view>

namespace cbc::manual {

/// The source of a page of man/.
[[nodiscard]] std::string read_page(const std::string& name);

/// The part of a page between two lines; fails the test and is empty if one is not there.
[[nodiscard]] std::string_view between(std::string_view page, std::string_view first,
                                       std::string_view last);

/// A part of a page, between two such lines, is as expected. With CBC_UPDATE_GOLDEN=1 it is written
/// anew instead.
void expect_part(const std::string& name, std::string_view first, std::string_view last,
                 const std::string& expected);

/// A text as groff has to have it to print it as it is.
[[nodiscard]] std::string escape(std::string_view text);
/// A paragraph, each sentence of it on lines of its own.
[[nodiscard]] std::string prose(std::string_view paragraph);
/// Removes the beginning of a text, up to a separator, which goes, too; returns it.
std::string_view take_until(std::string_view separator, std::string_view& rest);

/// The part of a page under a heading of a subsection (".Ss"), up to the next heading.
[[nodiscard]] std::string_view subsection(std::string_view page, std::string_view title);

/// The first words of the items of lists that are marked up with a macro: ".It Cm WORD ...".
[[nodiscard]] std::set<std::string> items(std::string_view part, std::string_view macro);

}  // namespace cbc::manual

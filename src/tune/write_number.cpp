#include "tune/write_number.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "core/compile/compile.h"
#include "core/files/output.h"
#include "core/files/read.h"
#include "core/files/replace.h"
#include "core/yaml/document.h"
#include "core/yaml/edits.h"
#include "runtime/base/text.h"

namespace cbc::cli {

int write_number(const CheckedCatalog& source, const TunableNumber& number, Millionths value,
                 const Missions& missions) {
  const std::string& path = source.reading.catalog.file;
  if (path == display_name("-")) {
    return complain(
        "--write: standard input cannot be changed in place; give the name of the file");
  }
  if (!number.range) {
    return complain("--write: the default suitability stands nowhere in {}; write it out there",
                    quote(path));
  }
  const std::string place = format_place(printable(path), number.range->begin);
  const std::string_view body = utf8::without_byte_order_mark(*source.text);
  const std::size_t mark = source.text->size() - body.size();
  Diagnostics diagnostics;
  const auto before = yaml::parse(*source.text, path, diagnostics);
  const auto& nodes = before->nodes();
  const auto node = std::find_if(nodes.begin(), nodes.end(), [&](const yaml::Node& one) {
    return one.kind == yaml::Kind::scalar && one.range == *number.range;
  });
  if (node->shared) {
    return complain(
        "{}: this number cannot be changed: aliases give it another meaning, too; write it out "
        "there",
        place);
  }
  const PositionMap positions(body);
  const yaml::Span span{mark + positions.offset(node->range.begin),
                        mark + positions.offset(node->range.end)};
  if (source.text->substr(span.begin, span.end - span.begin) != node->text) {
    return complain("{}: this number cannot be changed: expected nothing but digits there", place);
  }
  const std::string digits = format_decimal(value, 4);
  const std::array edits = {yaml::TextEdit{span, digits}};
  const std::string text = yaml::apply_edits(*source.text, edits);
  const auto after = yaml::parse(text, path, diagnostics);
  const auto changed = after == nullptr ? std::nullopt : read_catalog(*after, diagnostics);
  if (!changed || !record(compile(*changed), missions, Until::end).holds()) {
    complain(
        "internal error: with {} in {} expectations would fail, so nothing is changed; please "
        "report it with the files",
        digits, place);
    return exit_internal;
  }
  const std::array replacements = {Replacement{path, source.text, text}};
  return replace_inputs(replacements);
}

}  // namespace cbc::cli

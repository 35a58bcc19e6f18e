#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/report/words.h"
#include "page/html_report.h"
#include "runtime/base/text.h"
#include "verify/report/verify_report.h"

namespace cbc {

std::string verify_to_html(const VerifyResult& result) {
  const CompiledCatalog& catalog = *result.catalog;
  HtmlReport page;
  std::vector<PropertyOfPage> properties;
  for (const VerifyPart& part : result.parts) {
    for (const ReportedAnswer& reported : part.answers) {
      const Answer& answer = *reported.answer;
      const Property& property = *answer.property;
      PropertyOfPage& item = properties.emplace_back();
      item.title =
          fmt::format("{}:{}: {}", part.file->path, property.line, title_of(catalog, property));
      item.statement = describe_property(catalog, property);
      item.result = name_of(answer.verdict.result);
      item.description = describe_answer(result, part, answer);
      item.has_run = reported.replay.has_value();
      if (!item.has_run) continue;
      const Script& script = answer.witness->script;
      page.begin_run(catalog, script);
      page.end_run(run_script(catalog, script, {}, page), {});
    }
  }
  page.list_properties(properties);
  page.end();
  return page.page();
}

}  // namespace cbc

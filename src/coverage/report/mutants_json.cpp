#include <cstddef>
#include <string>

#include "core/report/assumptions_json.h"
#include "core/support/json.h"
#include "coverage/report/mutants_report.h"

namespace cbc {
namespace {

/// The members that say which mutant it is.
void write_identity(JsonWriter& json, const Catalog& catalog, const Mutant& mutant) {
  const bool is_suitability = mutant.kind == Mutant::Kind::suitability_lowered;
  json.write("kind", name_of(mutant.kind));
  if (mutant.behavior != Mutant::none) {
    json.write("behavior", catalog.behaviors[mutant.behavior].name);
  }
  if (mutant.task != Mutant::none) json.write("task", catalog.tasks[mutant.task].name);
  if (is_suitability) {
    json.write("below", catalog.behaviors[mutant.other].name);
    json.write("suitability", in_percent(mutant.suitability));
  } else if (mutant.other != Mutant::none) {
    json.write("other_task", catalog.tasks[mutant.other].name);
  }
  if (mutant.variable != Mutant::none) {
    json.write("variable", catalog.variables[mutant.variable].name);
  }
  json.write_list("lines", mutant.lines);
  json.write("change", describe(catalog, mutant));
}

void write_notice(JsonWriter& json, const MutantsResult& result, const Notice& notice) {
  json.open("noticed_by", '{');
  json.write("mission", result.missions[notice.mission]);
  json.write("how", name_of(notice.how));
  if (notice.line > 0) json.write("line", notice.line);
  json.write("message", notice.message);
  json.close('}');
}

}  // namespace

std::string mutants_to_json(const MutantsResult& result) {
  const MutantCount count = result.count();
  return json_line([&](JsonWriter& json) {
    json.write_members({{"schema", "cbc.mutants/1"}, {"catalog", result.catalog->file}});
    json.on_new_line().write_list("missions", result.missions);
    json.on_new_line().key("assumptions");
    write_assumptions(json, *result.compiled, result.assumptions);
    json.on_new_line().write_members({{"noticed", count.noticed},
                                      {"survived", count.survived},
                                      {"equivalent", count.equivalent},
                                      {"undecided", count.undecided},
                                      {"unjudged", count.unjudged}});
    if (count.is_score_known()) {
      json.write("percent", static_cast<double>(count.score().tenths()) / 10);
    }
    json.on_new_line().open("mutants", '[');
    for (std::size_t place = 0; place < result.mutants.size(); ++place) {
      const MutantVerdict& verdict = result.verdicts[place];
      json.on_new_line().open('{');
      write_identity(json, *result.catalog, result.mutants[place]);
      json.write("result", name_of(verdict.result));
      if (verdict.result == MutantVerdict::Result::undecided) {
        json.write("reason", name_of(verdict.doubt));
      }
      if (verdict.notice) write_notice(json, result, *verdict.notice);
      if (verdict.script) json.write("script", *verdict.script);
      json.close('}');
    }
    json.close(']');
  });
}

}  // namespace cbc

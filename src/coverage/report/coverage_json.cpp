#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>

#include "core/report/assumptions_json.h"
#include "core/support/json.h"
#include "core/yaml/document.h"
#include "core/yaml/json_value.h"
#include "coverage/report/coverage_report.h"
#include "runtime/base/text.h"

namespace cbc {
namespace {

/// The members that say which goal it is.
void write_identity(JsonWriter& json, const CompiledCatalog& catalog, const Goal& goal) {
  json.write("kind", name_of(goal.kind));
  if (goal.behavior != none) json.write("behavior", catalog.name_of_behavior(goal.behavior));
  if (goal.task != none) json.write("task", catalog.name_of_task(goal.task));
  if (goal.other_task != none) json.write("other_task", catalog.name_of_task(goal.other_task));
  if (goal.variable == none) return;
  json.write("variable", catalog.name_of_variable(goal.variable));
  json.write("value", catalog.name_of_value({goal.variable, goal.value}));
}

void write_count(JsonWriter& json, const GoalCount& count) {
  json.write_members({{"goals", count.goals},
                      {"met", count.met},
                      {"unreachable", count.unreachable},
                      {"percent", static_cast<double>(count.tenths()) / 10}});
}

void write_catalog(JsonWriter& json, const CatalogCoverage& coverage) {
  json.on_new_line().open('{');
  json.write_members({{"catalog", coverage.catalog().file}, {"digest", coverage.digest()}});
  json.on_new_line().write_list("missions", coverage.missions());
  if (coverage.assumptions()) {
    json.on_new_line().key("assumptions");
    write_assumptions(json, coverage.catalog(), *coverage.assumptions());
  }
  json.on_new_line().open("total", '{');
  write_count(json, coverage.total());
  json.close('}');
  json.on_new_line().open("sections", '[');
  const auto sections = coverage.by_section();
  for (std::size_t section = 0; section < goal_sections; ++section) {
    if (sections.at(section).goals + sections.at(section).unreachable == 0) continue;
    json.on_new_line().open('{');
    json.write("section", name_of(static_cast<GoalSection>(section)));
    write_count(json, sections.at(section));
    json.close('}');
  }
  json.close(']');
  json.on_new_line().open("goals", '[');
  for (std::size_t goal = 0; goal < coverage.goals().size(); ++goal) {
    json.on_new_line().open('{');
    write_identity(json, coverage.catalog(), coverage.goals()[goal]);
    json.write_list("lines", coverage.goals()[goal].lines);
    if (coverage.is_unreachable(goal)) {
      json.write("unreachable", true);
      json.write("reason", coverage.reason_of(goal));
    }
    json.write_list("met_by", coverage.missions_of(goal),
                    [&](std::uint32_t mission) { json.write(coverage.missions()[mission]); });
    json.close('}');
  }
  json.close(']');
  json.close('}');
}

using yaml::JsonFault;
using yaml::JsonValue;

/// Reads a report on a catalog. Throws a JsonFault.
class CoverageReader {
 public:
  explicit CoverageReader(CatalogCoverage& coverage) : coverage_(coverage) {
    for (std::size_t goal = 0; goal < coverage.goals().size(); ++goal) {
      goals_.emplace(identity_of(coverage.goals()[goal]), goal);
    }
  }

  void read(const JsonValue& root) {
    if (root["schema"].text() != "cbc.coverage/1") {
      throw JsonFault("its schema is not 'cbc.coverage/1'");
    }
    const std::vector<JsonValue> catalogs = root["catalogs"].items();
    const auto find = [&](const char* member, std::string_view text) {
      return std::find_if(catalogs.begin(), catalogs.end(),
                          [&](const JsonValue& catalog) { return catalog[member].text() == text; });
    };
    // Another machine may have it elsewhere.
    if (const auto found = find("digest", coverage_.digest()); found != catalogs.end()) {
      return read_catalog(*found);
    }
    const std::string_view file = coverage_.catalog().file;
    throw JsonFault(find("catalog", file) == catalogs.end()
                        ? fmt::format("it has nothing about {}", quote(file))
                        : fmt::format("it is about another version of {}", quote(file)));
  }

 private:
  /// The same text for goals that are the same.
  [[nodiscard]] std::string identity_of(const Goal& goal) const {
    return json_line([&](JsonWriter& json) { write_identity(json, coverage_.catalog(), goal); });
  }

  static std::string identity_of(const JsonValue& goal) {
    return json_line([&](JsonWriter& json) {
      for (const char* const name :
           {"kind", "behavior", "task", "other_task", "variable", "value"}) {
        if (const auto value = goal.find(name)) json.write(name, value->text());
      }
    });
  }

  void read_catalog(const JsonValue& catalog) {
    std::vector<std::string> missions;
    std::unordered_map<std::string, std::size_t> places;
    for (const JsonValue& mission : catalog["missions"].items()) {
      places.emplace(mission.text(), missions.size());
      missions.push_back(mission.text());
    }
    std::vector<std::vector<std::uint8_t>> met(
        missions.size(), std::vector<std::uint8_t>(coverage_.goals().size(), 0));
    for (const JsonValue& goal : catalog["goals"].items()) {
      const auto known = goals_.find(identity_of(goal));
      if (known == goals_.end()) {
        throw JsonFault("it has a goal that this version of cbc does not know");
      }
      for (const JsonValue& mission : goal["met_by"].items()) {
        const auto place = places.find(mission.text());
        if (place == places.end()) {
          throw JsonFault(fmt::format("'missions' does not have {}", quote(mission.text())));
        }
        met[place->second][known->second] = 1;
      }
    }
    for (std::size_t place = 0; place < missions.size(); ++place) {
      coverage_.add(missions[place], met[place]);
    }
  }

  CatalogCoverage& coverage_;
  std::unordered_map<std::string, std::size_t> goals_;  ///< by identity
};

}  // namespace

std::string coverage_to_json(const Coverage& coverage) {
  return json_line([&](JsonWriter& json) {
    json.write("schema", "cbc.coverage/1");
    write_count(json, coverage.total());
    json.on_new_line().open("catalogs", '[');
    for (const CatalogCoverage& catalog : coverage.catalogs) write_catalog(json, catalog);
    json.close(']');
  });
}

std::string add_coverage_json(std::string_view text, CatalogCoverage& coverage) {
  yaml::JsonReader reader;
  const yaml::Node* const root = reader.read(text);
  if (root == nullptr) {
    return reader.fault() + "; --merge reads what '--format json' writes";
  }
  try {
    CoverageReader(coverage).read(JsonValue(*root));
  } catch (const JsonFault& fault) {
    return fault.what();
  }
  return {};
}

}  // namespace cbc

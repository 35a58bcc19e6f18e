#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/support/json.h"
#include "verify/report/verify_report.h"

namespace cbc {
namespace {

class VerifyWriter {
 public:
  VerifyWriter(JsonWriter& json, const VerifyResult& result)
      : json_(json), result_(result), catalog_(*result.catalog) {}

  void write() {
    json_.write_members({{"schema", "cbc.verify/1"}, {"catalog", catalog_.file}});
    json_.open("groups", '[');
    for (const VerifyPart& part : result_.parts) {
      for (const Exploration& exploration : part.verification.explorations) {
        // A property may be about variables alone that no behavior names.
        if (!exploration.groups.empty()) write_exploration(part, exploration);
      }
    }
    json_.close(']');
    json_.open("properties", '[');
    for (const VerifyPart& part : result_.parts) {
      for (const ReportedAnswer& answer : part.answers) write_answer(part, answer);
    }
    json_.close(']');
    write_comparison();
    write_cut_sets();
  }

 private:
  using Depths = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

  void write_depths(std::string_view name, const Depths& depths, const Texts& names) {
    json_.open(name, '{');
    for (const auto& [place, depth] : depths) json_.write(names[place], depth);
    json_.close('}');
  }

  void write_exploration(const VerifyPart& part, const Exploration& exploration) {
    json_.on_new_line().open('{');
    if (result_.parts.size() > 1) json_.write("file", part.file->path);
    json_.write("group", exploration.groups.front());
    if (exploration.groups.size() > 1) json_.write_list("groups", exploration.groups);
    json_.open("tasks", '[');
    for (const TaskId task : catalog_.task_ids) {
      if (explores(exploration, task)) json_.write(catalog_.name_of_task(task));
    }
    json_.close(']');
    if (exploration.reduced) json_.write("reduced", true);
    json_.write_members({{"complete", exploration.complete},
                         {"states", exploration.states},
                         {"transitions", exploration.transitions},
                         {"depth", exploration.depth}});
    if (!exploration.complete) json_.write_list("states_at_depth", exploration.states_at_depth);
    write_depths("runs", exploration.runs, catalog_.task_names);
    write_depths("active", exploration.active, catalog_.behavior_names);
    write_depths("start_refused", exploration.start_refused, catalog_.task_names);
    json_.write_list("together", exploration.together, [&](const Exploration::Together& pair) {
      json_.open('[');
      json_.write(catalog_.task_names[pair.a]);
      json_.write(catalog_.task_names[pair.b]);
      json_.write(pair.depth);
      json_.close(']');
    });
    json_.close('}');
  }

  void write_answer(const VerifyPart& part, const ReportedAnswer& reported) {
    const Answer& answer = *reported.answer;
    const Property& property = *answer.property;
    json_.on_new_line().open('{');
    json_.write_members(
        {{"file", part.file->path}, {"line", property.line}, {"kind", name_of(property.kind)}});
    json_.write("name", property.name.empty() ? std::nullopt : std::optional(property.name));
    json_.write("result", name_of(answer.verdict.result));
    if (answer.witness) {
      json_.write("length", answer.verdict.script.size());
      json_.write("script", reported.script_path.value_or(answer.witness->text));
    } else {
      json_.write_members({{"length", nullptr}, {"script", nullptr}});
    }
    const bool is_refused = property.kind == Property::Kind::can_start && reported.replay;
    json_.write_json("conflict", is_refused ? reported.replay->conflict : "[]");
    json_.close('}');
  }

  void write_comparison() {
    if (!result_.same_as) {
      json_.write("same_as", nullptr);
      return;
    }
    const ReportedComparison& reported = *result_.same_as;
    const CatalogComparison& comparison = reported.comparison;
    json_.open("same_as", '{');
    json_.write_members({{"old", reported.old_catalog->file},
                         {"result", name_of(comparison.result)},
                         {"states", comparison.states}});
    if (comparison.witness) {
      json_.write("length", comparison.moves.size());
      json_.write("script", reported.script_path.value_or(comparison.witness->text));
    } else {
      json_.write_members({{"length", nullptr}, {"script", nullptr}});
    }
    json_.write_list("only_old", comparison.names.only_old);
    json_.write_list("only_new", comparison.names.only_new);
    json_.close('}');
  }

  void write_cut_sets() {
    if (!result_.wants_cut_sets) {
      json_.write("cut_sets", nullptr);
      return;
    }
    json_.write_list("cut_sets", result_.cut_sets, [&](const TaskCutSets& of_task) {
      json_.on_new_line().open('{');
      json_.write_members(
          {{"task", catalog_.name_of_task(of_task.task)}, {"order", of_task.order}});
      const std::uint32_t incomplete = of_task.found.incomplete_size;
      if (!of_task.found.complete) {
        json_.write("complete_order",
                    incomplete > 0 ? std::optional(incomplete - 1) : std::nullopt);
      }
      json_.write_list("sets", of_task.found.sets, [&](const std::vector<BehaviorId>& set) {
        json_.open('[');
        for (const BehaviorId behavior : set) json_.write(catalog_.name_of_behavior(behavior));
        json_.close(']');
      });
      json_.close('}');
    });
  }

  [[nodiscard]] bool explores(const Exploration& exploration, TaskId task) const {
    return std::find(exploration.groups.begin(), exploration.groups.end(),
                     catalog_.tasks[task].group) != exploration.groups.end();
  }

  JsonWriter& json_;
  const VerifyResult& result_;
  const CompiledCatalog& catalog_;
};

}  // namespace

std::string verify_to_json(const VerifyResult& result) {
  return json_line([&](JsonWriter& json) { VerifyWriter(json, result).write(); });
}

}  // namespace cbc

#include "graph/samples.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/catalog/reader.h"
#include "core/catalog/situation.h"
#include "core/compile/compile.h"
#include "core/script/runner.h"
#include "core/yaml/document.h"
#include "graph/engine/catalog_graph.h"
#include "graph/engine/diagram.h"
#include "graph/engine/state_recorder.h"
#include "graph/hostile_catalog.h"
#include "graph/report/graph_report.h"
#include "support/read_file.h"
#include "support/sessions.h"
#include "support/shared_folder.h"
#include "versions/difference/catalog_diff.h"

namespace cbc::graph_test {
namespace {

namespace fs = std::filesystem;
using draw::Clustering;
using draw::ExclusivityStyle;
using draw::View;

struct Variant {
  const char* name;
  draw::ViewOptions options;
  bool has_legend = false;
};

// The first has every task and every behavior, and nothing else.
const std::vector<Variant>& variants() {
  static const std::vector<Variant> all = {
      {"pairs", {View::full, ExclusivityStyle::pairs, {}, false}, false},
      {"hubs", {View::full, ExclusivityStyle::hubs, Clustering::packages, false}, true},
      {"full", {View::full, {}, Clustering::groups, false}, true},
      {"tasks", {View::tasks, {}, {}, false}, false},
      {"tasks, reduced", {View::tasks, ExclusivityStyle::pairs, {}, true}, true},
      {"constraints", {View::constraints, {}, {}, false}, true},
      {"behaviors", {View::behaviors, ExclusivityStyle::pairs, Clustering::packages, false}, true},
  };
  return all;
}

struct Source {
  std::unique_ptr<const yaml::Document> document;
  CatalogReading reading;
  CompiledCatalog compiled;
  draw::CatalogGraph graph;
};

// Null if there is nothing to draw.
std::unique_ptr<Source> understand(const std::string& text, const std::string& name) {
  auto source = std::make_unique<Source>();
  Diagnostics diagnostics;
  source->document = yaml::parse(text, name, diagnostics);
  if (source->document == nullptr) return nullptr;
  source->reading = understand_catalog(*source->document, diagnostics);
  if (diagnostics.has_errors()) {
    source->graph = draw::to_graph(source->reading, diagnostics.all());
  } else {
    source->compiled = compile(source->reading.catalog);
    source->graph = draw::to_graph(source->compiled);
  }
  const bool is_empty = source->graph.tasks.empty() && source->graph.behaviors.empty();
  return is_empty ? nullptr : std::move(source);
}

Sample draw(const draw::CatalogGraph& graph, const std::optional<draw::Moment>& moment,
            const Variant& variant, const std::string& name) {
  draw::Diagram diagram = make_diagram(graph, whole(graph), variant.options);
  diagram.moment = moment;
  if (variant.has_legend) add_legend(diagram);
  std::string caption;
  if (moment) {
    for (const std::string& line : caption_of(*moment)) caption += line;
  }
  const std::size_t nodes = diagram.nodes.size() + (diagram.legend.empty() ? 0 : 1);
  return {name + ", " + variant.name, graph_dot(diagram),
          graph_mermaid(diagram),     nodes,
          diagram.edges.size(),       {},
          std::move(caption)};
}

// Starts one task after the other, while behaviors fail.
Script script_of(const CompiledCatalog& catalog, const std::string& name) {
  const auto behaviors = static_cast<std::uint32_t>(catalog.behavior_ids.size());
  Script script;
  script.file = name;
  for (std::uint32_t task = 0; task < catalog.tasks.size() && task < 5; ++task) {
    for (const Verb verb : {Verb::start, Verb::fault, Verb::finish}) {
      Step& step = script.steps.emplace_back();
      step.verb = verb;
      step.subject = task;
      step.priority = 1;
      step.cause = FinishCause::process_failure;
      if (verb == Verb::fault) step.subject = (task + 1) % behaviors;
      if (verb == Verb::finish) step.subject = task % behaviors;
    }
  }
  return script;
}

std::vector<Sample> draw_state(const Source& source, const std::string& name) {
  draw::CatalogGraph graph = source.graph;
  const Script script = script_of(source.compiled, name);
  StateRecorder recorder(source.compiled, script, {});
  static_cast<void>(run_script(source.compiled, script, {}, recorder));
  draw::mark_state(graph, recorder.state());
  std::vector<Sample> samples;
  for (const Variant& variant : {variants().front(), variants().back()}) {
    samples.push_back(draw(graph, recorder.moment(), variant, name + ", state"));
  }
  return samples;
}

// The same with something added, removed and changed. Names go where texts are shown.
std::string changed(const std::string& catalog) {
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(catalog);
  auto& task = json["tasks"].front();
  task["timeout"] = 5;
  task["parameters"] = {{{"parameter", task["task"]}, {"allowed_values", {task["task"], "x"}}}};
  auto& behavior = json["behaviors"].front();
  behavior["suitability"] = 49;
  behavior["package"] = behavior["behavior"];
  json["behaviors"].push_back(
      {{"behavior", "new " + behavior["behavior"].get<std::string>()}, {"task", task["task"]}});
  if (json["behaviors"].size() > 2) json["behaviors"].erase(1);
  if (!json["exclusivity_constraints"].empty()) json["exclusivity_constraints"].erase(0);
  return json.dump();
}

std::vector<Sample> draw_diff(const Source& before, const Source& after, const std::string& name) {
  const CatalogDiff diff = compare_catalogs(before.compiled, after.compiled);
  const draw::CatalogGraph graph = draw::to_graph(before.compiled, after.compiled, diff);
  std::vector<Sample> samples;
  for (const Variant& variant : variants()) {
    samples.push_back(draw(graph, {}, variant, name + ", diff"));
  }
  return samples;
}

std::vector<Sample> draw_all(const Source& source, const std::string& name) {
  std::vector<Sample> samples;
  for (const Variant& variant : variants()) {
    samples.push_back(draw(source.graph, {}, variant, name));
  }
  if (source.compiled.behavior_ids.empty()) return samples;
  std::vector<Sample> states = draw_state(source, name);
  std::move(states.begin(), states.end(), std::back_inserter(samples));
  return samples;
}

void collect(const fs::path& folder, std::vector<fs::path>& files) {
  if (!fs::is_directory(folder)) return;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().extension() == ".yaml") {
      files.push_back(entry.path());
    }
  }
}

std::vector<std::string> labels_of(const Catalog& catalog) {
  std::vector<std::string> labels;
  for (const Task& task : catalog.tasks) {
    labels.push_back(draw::label_of(task.name));
    if (task.minimum_performance > 0) labels.back() += draw::at_least(task.minimum_performance);
  }
  for (const Behavior& behavior : catalog.behaviors) {
    labels.push_back(draw::label_of(behavior.name));
    for (const NamedCondition& condition : conditions_of(catalog, behavior)) {
      labels.back() += describe(condition);
    }
  }
  std::sort(labels.begin(), labels.end());
  return labels;
}

}  // namespace

std::vector<Sample> samples_of_files() {
  const fs::path root(CBC_SOURCE_DIR);
  std::vector<fs::path> files;
  collect(root / "catalogs", files);
  collect(root / "tests" / "golden" / "shared", files);
  collect(test::shared_catalogs(), files);
  std::sort(files.begin(), files.end());
  std::vector<std::pair<std::string, std::string>> texts;  // name and content
  for (const fs::path& file : files) texts.emplace_back(file.string(), test::read_file(file));
  for (const test::Case& one : test::read_cases()) {
    for (const test::CaseFile& file : one.files) {
      if (file.path.ends_with(".yaml"))
        texts.emplace_back(one.name + "/" + file.path, file.content);
    }
  }
  std::set<std::string> known;
  std::vector<Sample> samples;
  for (const auto& [name, text] : texts) {
    if (!known.insert(text).second) continue;
    const auto source = understand(text, name);
    if (source == nullptr) continue;
    std::vector<Sample> drawn = draw_all(*source, name);
    // A bad catalog has nodes beside those.
    if (!source->compiled.tasks.empty()) drawn.front().labels = labels_of(source->reading.catalog);
    std::move(drawn.begin(), drawn.end(), std::back_inserter(samples));
  }
  return samples;
}

std::vector<Sample> random_diff_samples(std::uint64_t seed) {
  const std::string name = "seed " + std::to_string(seed);
  const std::string text = hostile_catalog(seed).text;
  const auto before = understand(text, name);
  if (before == nullptr || before->compiled.tasks.empty()) return {};  // it has errors
  const auto after = understand(changed(text), name + ", changed");
  if (after == nullptr || after->compiled.tasks.empty()) {
    throw std::logic_error("not a good catalog: " + changed(text));
  }
  std::vector<Sample> samples = draw_diff(*before, *after, name);
  std::vector<Sample> back = draw_diff(*after, *before, name + ", back");
  std::move(back.begin(), back.end(), std::back_inserter(samples));
  return samples;
}

std::vector<Sample> random_samples(std::uint64_t seed) {
  HostileCatalog catalog = hostile_catalog(seed);
  const std::string name = "seed " + std::to_string(seed);
  const auto source = understand(catalog.text, name);
  if (source == nullptr) throw std::logic_error("nothing drawn of " + catalog.text);
  std::vector<Sample> samples = draw_all(*source, name);
  std::sort(catalog.labels.begin(), catalog.labels.end());
  samples.front().edges = catalog.edges;
  samples.front().nodes = catalog.labels.size();
  samples.front().labels = std::move(catalog.labels);
  return samples;
}

}  // namespace cbc::graph_test

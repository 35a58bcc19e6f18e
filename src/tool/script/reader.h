#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "catalog/allowed_values.h"
#include "catalog/catalog.h"
#include "cbc/units.h"
#include "compiled/compiled_catalog.h"
#include "coordinator/state.h"
#include "diagnostic/diagnostic.h"
#include "script/script.h"
#include "support/wording.h"
#include "yaml/document.h"
#include "yaml/values.h"

namespace cbc {

/// Finds the tasks and behaviors that a script names, by their places in the catalog, and reports
/// names that there are not.
class NameIndex {
 public:
  /// The catalog must outlive this object.
  explicit NameIndex(const CompiledCatalog& catalog) : catalog_(catalog) {}

  /// `what` is the key that the name belongs to.
  [[nodiscard]] std::optional<std::uint32_t> find_task(const yaml::Node& node,
                                                       std::string_view what, Reporter& reporter);
  [[nodiscard]] std::optional<std::uint32_t> find_behavior(const yaml::Node& node,
                                                           std::string_view what,
                                                           Reporter& reporter);

  [[nodiscard]] const CompiledCatalog& catalog() const { return catalog_; }

 private:
  const CompiledCatalog& catalog_;
  // Made when the first unknown name is met.
  std::optional<Suggestions> tasks_;
  std::optional<Suggestions> behaviors_;
};

/// Checks what tasks are started with against what they declare.
class ParameterChecks {
 public:
  /// Findings have this severity. The catalog must outlive this object.
  ParameterChecks(const CompiledCatalog& catalog, Severity severity)
      : catalog_(catalog), severity_(severity) {}

  /// Reports the parameters that the task does not declare, and values that are not allowed.
  /// `given` is a mapping.
  void check(std::uint32_t task, const yaml::Node& given, Reporter& reporter);

 private:
  /// The parameters that a task declares; of equal names the first counts.
  struct Declared {
    explicit Declared(std::vector<Parameter> declared);
    Declared(const Declared&) = delete;
    Declared& operator=(const Declared&) = delete;
    const std::vector<Parameter> parameters;
    std::unordered_map<std::string_view, AllowedValues> values;
    Suggestions suggestions;
    std::string all;  ///< for messages
  };

  [[nodiscard]] Declared& declared_by(std::uint32_t task);
  void report_undeclared(std::uint32_t task, const yaml::Node& name, Reporter& reporter);

  const CompiledCatalog& catalog_;
  Severity severity_;
  std::unordered_map<std::uint32_t, Declared> declared_;  ///< of tasks that were asked for
};

/// Reads the parameters of a start: a mapping of anything.
///
/// The canonical form compares them as data: scalars by their text, mappings without order; null,
/// empty and absent are alike at every depth. The JSON form keeps the order, and numbers, booleans
/// and nulls where the text is plain and JSON would write it in just this way.
[[nodiscard]] std::optional<Parameters> read_parameters(const yaml::Node& node, Reporter& reporter);

/// The values that an event consists of, as an entry of a script or a line of a log has them.
struct EventParts {
  Verb verb = Verb::wait;
  std::string_view subject_key;         ///< names the subject in messages
  const yaml::Node* subject = nullptr;  ///< null: there is none, or that is an error already
  const yaml::Node* priority = nullptr;
  const yaml::Node* parameters = nullptr;
  const yaml::Node* cause = nullptr;
};

/// Reads the entries of a script one after the other, and keeps its clock and its situation.
class StepReader {
 public:
  /// The catalog must outlive this object; see read_script.
  StepReader(const CompiledCatalog& catalog, Severity of_parameters)
      : names_(catalog),
        parameter_checks_(catalog, of_parameters),
        is_available_(catalog.behaviors.size(), true) {}

  /// The next entry. What is wrong with it is reported; the result may be used only if there were
  /// no errors.
  [[nodiscard]] Step read(const yaml::Node& node, Reporter& reporter);

  /// Reads an event into a step, but for its time. Parts that do not belong to the verb are
  /// ignored.
  void read_parts(const EventParts& parts, Step& step, Reporter& reporter);

  /// A mapping of behaviors to booleans.
  [[nodiscard]] std::vector<Availability> read_situation(const yaml::Node& node,
                                                         Reporter& reporter);

  /// Goes on from the state that a coordinator has come to, whatever was read before.
  void resume(Microseconds now, const State& state);

  /// Tells that something may be meant to change the situation, but is not understood.
  void doubt_situation() { knows_situation_ = false; }

 private:
  void read_time(const yaml::Fields& fields, Step& step, Reporter& reporter);
  void check_finish(std::uint32_t behavior, const Range& range, Reporter& reporter);

  Microseconds clock_ = 0;
  NameIndex names_;
  ParameterChecks parameter_checks_;
  std::vector<bool> is_available_;  ///< by behavior, at this place of the script
  bool knows_situation_ = true;
};

/// Reads the value of an `expect`, and warns of what can never hold. What is wrong with it is
/// reported; the result may be used only if there were no errors.
[[nodiscard]] Expectation read_expectation(const yaml::Node& node, NameIndex& names,
                                           Reporter& reporter);

/// The `catalog:` of a script (as written, relative to the script), if it names one.
[[nodiscard]] std::optional<std::string> catalog_of_script(const yaml::Document& document);

/// Understands an event script and checks it as a whole. A script has a meaning whatever the
/// parameters in it are: findings about them have the severity `of_parameters`. It goes on from
/// `state`, if there is one. The result is empty if there is an error.
[[nodiscard]] std::optional<Script> read_script(const yaml::Document& document,
                                                const CompiledCatalog& catalog,
                                                Severity of_parameters, Diagnostics& diagnostics,
                                                const Snapshot* state = nullptr);

}  // namespace cbc

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "cbc/units.h"
#include "core/catalog/allowed_values.h"
#include "core/catalog/catalog.h"
#include "core/diagnostic/diagnostic.h"
#include "core/script/names.h"
#include "core/script/script.h"
#include "core/support/wording.h"
#include "core/yaml/document.h"
#include "core/yaml/values.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/state.h"

namespace cbc {

// Event scripts: the reader of whole scripts, and the parts that streams and logs share with it.

/// Checks the parameters of starts against those that the tasks declare.
class ParameterChecks {
 public:
  /// Findings have this severity. The catalog must outlive this object.
  ParameterChecks(const CompiledCatalog& catalog, Severity severity)
      : catalog_(catalog), severity_(severity) {}

  /// Reports parameters that the task does not declare, and values that are not allowed. `given` is
  /// a mapping.
  void check(std::uint32_t task, const yaml::Node& given, Reporter& reporter);

 private:
  /// The parameters that a task declares; the first one of a name counts.
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
  void report_undeclared(std::uint32_t task, const yaml::Node& name, const yaml::Node& given,
                         Reporter& reporter);

  const CompiledCatalog& catalog_;
  Severity severity_;
  std::unordered_map<std::uint32_t, Declared> declared_;  ///< by task, made on demand
};

/// Reads the parameters of a start: a mapping of anything.
///
/// The canonical form compares them as data: scalars by their text, mappings regardless of order;
/// null, empty and absent are the same at every depth. The JSON form keeps the order; a plain
/// scalar is a number, a boolean or null in it if JSON would write it in the same way.
[[nodiscard]] std::optional<Parameters> read_parameters(const yaml::Node& node, Reporter& reporter);

/// The parts of an event, as an entry of a script or a line of a log has them.
struct EventParts {
  Verb verb = Verb::wait;
  std::string_view subject_key;         ///< names the subject in messages
  const yaml::Node* subject = nullptr;  ///< null: none, or reported as missing
  const yaml::Node* task = nullptr;     ///< of a finish that names a task in place of the subject
  const yaml::Node* priority = nullptr;
  const yaml::Node* parameters = nullptr;
  const yaml::Node* cause = nullptr;
};

/// Reads the entries of a script one after the other, and keeps track of clock and situation.
class StepReader {
 public:
  /// The catalog must outlive this object; see read_script, and NameIndex for `names`.
  StepReader(const CompiledCatalog& catalog, Severity of_parameters,
             std::vector<NamePlace>* names = nullptr)
      : names_(catalog, names),
        parameter_checks_(catalog, of_parameters),
        is_denied_(catalog.behaviors.size(), false),
        variables_(catalog.variables.size(), 0) {}

  /// Reads the next entry. Mistakes are reported; the result may be used only if there was no
  /// error.
  [[nodiscard]] Step read(const yaml::Node& node, Reporter& reporter);

  /// Reads an event into a step, except for its time. Parts that do not belong to the verb are
  /// ignored.
  void read_parts(const EventParts& parts, Step& step, Reporter& reporter);

  /// A mapping of behaviors to booleans, and of situation variables to their values.
  [[nodiscard]] Situation read_situation(const yaml::Node& node, Reporter& reporter);

  /// Continues from the state of a coordinator, whatever was read before.
  void resume(Microseconds now, const State& state);

  /// Notes that something not understood may have been meant to change the situation.
  void doubt_situation() { knows_situation_ = false; }

  /// From here on nothing is found about parameters.
  void stop_checking_parameters() { checks_parameters_ = false; }

 private:
  void read_time(const yaml::Fields& fields, Step& step, Reporter& reporter);
  void check_finish(std::uint32_t subject, bool is_task, const Range& range, Reporter& reporter);
  [[nodiscard]] std::optional<VariableValue> find_unfit_value(BehaviorId behavior) const;

  Microseconds clock_ = 0;
  NameIndex names_;
  ParameterChecks parameter_checks_;
  bool checks_parameters_ = true;
  // The situation at this place of the script.
  std::vector<bool> is_denied_;  ///< by behavior
  std::vector<std::uint32_t> variables_;
  bool knows_situation_ = true;
};

/// The value of `catalog:` in a script or a property file; null if it names none.
[[nodiscard]] const yaml::Node* catalog_of_script(const yaml::Document& document);

/// Reads and checks a whole event script. Findings about parameters have the severity
/// `of_parameters`, since a script has a meaning whatever they are. The script continues from
/// `state`, if there is one. `names`, if not null, takes where names of the catalog stand. The
/// result is empty after an error.
[[nodiscard]] std::optional<Script> read_script(const yaml::Document& document,
                                                const CompiledCatalog& catalog,
                                                Severity of_parameters, Diagnostics& diagnostics,
                                                const Snapshot* state = nullptr,
                                                std::vector<NamePlace>* names = nullptr);

}  // namespace cbc

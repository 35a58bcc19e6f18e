#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "cbc/units.h"
#include "coordinator/state.h"
#include "diagnostic/reporter.h"
#include "script/names.h"
#include "script/parameter_checks.h"
#include "script/script.h"
#include "yaml/document.h"
#include "yaml/fields.h"

namespace cbc {

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

  /// A mapping of behaviors to booleans.
  [[nodiscard]] std::vector<Availability> read_situation(const yaml::Node& node,
                                                         Reporter& reporter);

  /// Goes on from the state that a coordinator has come to, whatever was read before.
  void resume(Microseconds now, const State& state);

  /// Tells that something may be meant to change the situation, but is not understood.
  void doubt_situation() { knows_situation_ = false; }

 private:
  void read_time(const yaml::Fields& fields, Step& step, Reporter& reporter);
  void read_verb(std::string_view verb, const yaml::Fields& fields, Step& step, Reporter& reporter);
  void check_finish(std::uint32_t behavior, const Range& range, Reporter& reporter);

  Microseconds clock_ = 0;
  NameIndex names_;
  ParameterChecks parameter_checks_;
  std::vector<bool> is_available_;  ///< by behavior, at this place of the script
  bool knows_situation_ = true;
};

}  // namespace cbc

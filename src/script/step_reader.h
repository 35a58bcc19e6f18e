#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "cbc/units.h"
#include "diagnostic/reporter.h"
#include "script/names.h"
#include "script/script.h"
#include "yaml/document.h"
#include "yaml/fields.h"

namespace cbc {

/// Reads the entries of a script one after the other, and keeps its clock.
class StepReader {
 public:
  explicit StepReader(const ScriptNames& names) : names_(names) {}

  /// The next entry. What is wrong with it is reported; the result may be used only if there were
  /// no errors.
  [[nodiscard]] Step read(const yaml::Node& node, Reporter& reporter);

  /// A mapping of behaviors to booleans.
  [[nodiscard]] std::vector<Availability> read_situation(const yaml::Node& node,
                                                         Reporter& reporter);

 private:
  void read_time(const yaml::Fields& fields, Step& step, Reporter& reporter);
  void read_verb(std::string_view verb, const yaml::Fields& fields, Step& step, Reporter& reporter);
  [[nodiscard]] Expectation read_expectation(const yaml::Node& node, Reporter& reporter);

  NameIndex names_;
  Microseconds clock_ = 0;
};

}  // namespace cbc

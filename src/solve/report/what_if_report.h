#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/diagnostic/diagnostic.h"
#include "core/report/blocks.h"
#include "core/script/script.h"
#include "runtime/compiled/compiled_catalog.h"
#include "runtime/coordinator/state.h"
#include "solve/engine/what_if.h"

// What could happen next, for people and for programs.

namespace cbc {

/// The state that the moves are tried in.
struct WhatIfState {
  const CompiledCatalog& catalog;
  const Script& script;
  const MissionMoment& moment;
  const State& state;  ///< that of the moment
};

/// Takes the moves one after the other, and makes a document of them.
class WhatIfReport {
 public:
  virtual ~WhatIfReport() = default;
  virtual void add(const PossibleMove& move) = 0;
  /// After the last move.
  [[nodiscard]] virtual std::string finish() = 0;
};

/// A table of moves for people, by kind; those that change nothing are only named. `columns`: of
/// the terminal; 0: none, and lines are as wide as tables are. The state must outlive the report.
class WhatIfText final : public WhatIfReport {
 public:
  WhatIfText(const WhatIfState& of, const Style& style, std::size_t columns);

  void add(const PossibleMove& move) override;
  [[nodiscard]] std::string finish() override;

 private:
  struct Row {
    std::string name;
    std::vector<std::string> priorities;  ///< of the starts that do the same
    std::string outcome;                  ///< empty: none, as nothing is decided
    std::string effect;                   ///< empty: nothing changes
  };
  struct Section {
    std::string title;
    std::vector<Row> rows;
    std::vector<std::string> priorities;  ///< of all its starts
  };

  [[nodiscard]] std::string header() const;
  void write(const Section& section, Text& text) const;
  [[nodiscard]] static std::string name_in(const Row& row, const Section& section);

  const WhatIfState of_;
  const Style style_;
  const std::size_t columns_;
  std::vector<Section> sections_;
};

/// The same for programs: the schema cbc.what-if/1.
class WhatIfJson final : public WhatIfReport {
 public:
  explicit WhatIfJson(const WhatIfState& of) : of_(of) {}

  void add(const PossibleMove& move) override;
  [[nodiscard]] std::string finish() override;

 private:
  const WhatIfState of_;
  std::string moves_;
};

[[nodiscard]] std::string what_if_schema();

}  // namespace cbc

#include "explore/moves/move_kinds.h"

#include <algorithm>
#include <vector>

namespace cbc {

bool is_of_kinds(const MoveKinds& kinds, const Model::Choice& choice, const Model& model) {
  const auto is_listed = [&](const std::vector<TaskId>& only) {
    const TaskId task = model.tasks()[choice.subject].id;
    return only.empty() || std::find(only.begin(), only.end(), task) != only.end();
  };
  switch (choice.move.kind) {
    case Move::Kind::start:
      return kinds.start && is_listed(kinds.start_only);
    case Move::Kind::stop:
      return kinds.stop && is_listed(kinds.stop_only);
    case Move::Kind::success:
      return kinds.successes;
    case Move::Kind::failure:
      return kinds.failures;
    case Move::Kind::fault:
      return kinds.fault;
    case Move::Kind::repair:
      return kinds.repair;
    case Move::Kind::situation_change:
    case Move::Kind::variable:
    case Move::Kind::own:
    case Move::Kind::together:
      return kinds.situation;
    case Move::Kind::due:
      break;
  }
  return kinds.queue;
}

}  // namespace cbc

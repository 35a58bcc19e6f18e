#include "draw/mark.h"

namespace cbc::draw {

Mark combine(Mark a, Mark b) {
  if (a == b) return a;
  if (a == Mark::faulty || b == Mark::faulty) return Mark::faulty;
  if (a == Mark::faint) return b;
  if (b == Mark::faint) return a;
  return Mark::changed;
}

Mark presence_of(Mark mark) {
  return mark == Mark::added || mark == Mark::removed ? mark : Mark::plain;
}

std::optional<Mark> join(Mark a, Mark b) {
  const auto either_is = [&](Mark mark) { return a == mark || b == mark; };
  if (either_is(Mark::added) && either_is(Mark::removed)) return std::nullopt;
  for (const Mark mark : {Mark::faulty, Mark::added, Mark::removed}) {
    if (either_is(mark)) return mark;
  }
  return combine(a, b);
}

std::string_view name_of(Mark mark) {
  switch (mark) {
    case Mark::plain:
    case Mark::faint:
      break;
    case Mark::faulty:
      return "faulty";
    case Mark::added:
      return "added";
    case Mark::removed:
      return "removed";
    case Mark::changed:
      return "changed";
  }
  return {};
}

}  // namespace cbc::draw

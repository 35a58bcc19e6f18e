#include "draw/mark.h"

namespace cbc::draw {
namespace {

bool was_in_use(Mark mark) { return mark == Mark::active || mark == Mark::stopped; }
bool is_in_use(Mark mark) { return mark == Mark::active || mark == Mark::started; }

bool is_of_use(Mark mark) { return mark == Mark::faint || was_in_use(mark) || is_in_use(mark); }

}  // namespace

Mark mark_of_use(bool was_in_use, bool is_in_use) {
  if (is_in_use) return was_in_use ? Mark::active : Mark::started;
  return was_in_use ? Mark::stopped : Mark::faint;
}

Mark combine(Mark a, Mark b) {
  if (a == b) return a;
  if (a == Mark::faulty || b == Mark::faulty) return Mark::faulty;
  if (a == Mark::faint) return b;
  if (b == Mark::faint) return a;
  if (is_of_use(a) && is_of_use(b)) {
    return mark_of_use(was_in_use(a) || was_in_use(b), is_in_use(a) || is_in_use(b));
  }
  return Mark::changed;
}

Mark presence_of(Mark mark) {
  return mark == Mark::added || mark == Mark::removed ? mark : Mark::plain;
}

Mark use_of(Mark mark) { return is_of_use(mark) ? mark : presence_of(mark); }

std::optional<Mark> join(Mark a, Mark b) {
  const auto either_is = [&](Mark mark) { return a == mark || b == mark; };
  if (either_is(Mark::added) && either_is(Mark::removed)) return std::nullopt;
  if (is_of_use(a) && is_of_use(b)) {
    return mark_of_use(was_in_use(a) && was_in_use(b), is_in_use(a) && is_in_use(b));
  }
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
    case Mark::active:
      return "active";
    case Mark::started:
      return "started";
    case Mark::stopped:
      return "stopped";
    case Mark::unavailable:
      return "unavailable";
  }
  return {};
}

}  // namespace cbc::draw

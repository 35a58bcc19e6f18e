"""Tests of the mutator: which mutants a source has, and that selecting one does what the changed source does."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import points

HERE = pathlib.Path(__file__).resolve().parent
FLAGS = ["-std=c++20"]

# What is mutated, and what follows from it.
SAMPLE = """\
#include <compare>
constexpr int limit = 7 * 3;
static_assert(limit > 20);
enum class Kind { one = 1 };
struct Pair {
  int first = 5;
  bool operator==(const Pair&) const = default;
};
int values[3] = {};
constexpr bool is_small(int number) { return number < limit; }
int subtract(int from, int what) { return from - what; }
int calculate(int a, int b, bool flag) {
  int sum = a + b;
  if (!flag && a >= 4) return -sum;
  for (int i = 0; i < 3; ++i) {
    if (i == b) continue;
    sum += i;
  }
  if (flag) sum = subtract(a, b);
  if (const int rest = a % 2) sum += rest;
  switch (a) {
    case 1:
      sum++;
      break;
    default:
      sum |= 0x10;
  }
  if (Pair{a} != Pair{b} || is_small(sum)) --sum;
  if ((a <=> b) < 0) ++sum;
  return flag ? sum / 2 : ~sum;
}
struct Memory {
  void reserve(int) {}
};
void prepare(Memory& memory, int count) { memory.reserve(count + 1); }
"""

EXPECTED = [
    (10, "comparison", "<", "<="), (10, "comparison", "<", ">="),
    (11, "arithmetic", "-", "+"), (11, "swap", "from - what", "what - from"),
    (13, "arithmetic", "+", "-"),
    (14, "statement", "return -sum;", "{}"), (14, "comparison", "&&", "||"), (14, "comparison", "!", ""),
    (14, "comparison", ">=", ">"), (14, "comparison", ">=", "<"), (14, "constant", "4", "5"),
    (14, "constant", "4", "3"),
    (14, "arithmetic", "-", ""),
    (15, "constant", "0", "1"), (15, "comparison", "<", "<="), (15, "comparison", "<", ">="),
    (15, "constant", "3", "4"), (15, "constant", "3", "2"), (15, "arithmetic", "++", "--"),
    (16, "comparison", "==", "!="), (16, "statement", "continue;", "{}"),
    (17, "statement", "sum += i;", "{}"), (17, "arithmetic", "+=", "-="),
    (19, "comparison", "", "!"), (19, "statement", "sum = subtract(a, b);", "{}"), (19, "swap", "a, b", "b, a"),
    (20, "arithmetic", "%", "*"), (20, "swap", "a % 2", "2 % a"), (20, "constant", "2", "3"),
    (20, "constant", "2", "1"),
    (20, "statement", "sum += rest;", "{}"), (20, "arithmetic", "+=", "-="),
    (23, "statement", "sum++;", "{}"), (24, "statement", "break;", "{}"),
    (26, "statement", "sum |= 0x10;", "{}"), (26, "arithmetic", "|=", "&="), (26, "constant", "0x10", "17"),
    (26, "constant", "0x10", "15"),
    (28, "comparison", "!=", "=="), (28, "comparison", "||", "&&"), (28, "comparison", "", "!"),
    (28, "statement", "--sum;", "{}"), (28, "arithmetic", "--", "++"),
    (29, "comparison", "<", ">="), (29, "statement", "++sum;", "{}"), (29, "arithmetic", "++", "--"),
    (30, "comparison", "", "!"), (30, "arithmetic", "/", "*"), (30, "swap", "sum / 2", "2 / sum"),
    (30, "constant", "2", "3"), (30, "constant", "2", "1"), (30, "arithmetic", "~", ""),
    (35, "statement", "memory.reserve(count + 1);", "{}"),
]

# Calls a function of the mutated source and of the changed ones, which must agree.
MAIN = """
#include <cstdio>
#include <initializer_list>
int main() {
  const auto calculate = changed[cbc::mutant::active];
  for (int a = 0; a < 7; ++a) {
    for (int b = 1; b < 7; ++b) {
      for (const bool flag : {false, true}) {
        const int found = mutated::calculate(a, b, flag);
        const int expected = calculate(a, b, flag);
        if (found == expected) continue;
        std::printf("%d %d %d: found %d, expected %d", a, b, flag, found, expected);
        return 1;
      }
    }
  }
}
"""
# These go on for ever, or divide by 0.
NOT_CALLED = [(15, "comparison", ">="), (15, "arithmetic", "--"), (20, "swap", "2 % a"), (30, "swap", "2 / sum")]


class Points(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.source = self.folder / "sample.cpp"
        self.source.write_text(SAMPLE)
        self.points, self.skipped = points.find_points(self.source, FLAGS)
        self.changes = [change for point in self.points for change in point.changes]

    def line_of(self, change):
        return SAMPLE.count("\n", 0, change.begin) + 1

    def test_finds_all_that_can_be_selected(self):
        found = [(self.line_of(change), change.kind, SAMPLE[change.begin:change.end], change.text)
                 for change in self.changes]
        self.assertEqual(sorted(found), sorted(EXPECTED))

    def test_counts_what_it_leaves_out(self):
        # `7 * 3`, `> 20`, `= 1`, `case 1`; the 5; the [3]; `if (const int rest`; `count + 1`.
        self.assertEqual(self.skipped, {"constant expression": 5 + 4 + 2 + 2, "initial value of a member": 2,
                                        "in a type": 2, "declaration in a condition": 1,
                                        "amount of reserved memory": 3})

    def test_selecting_is_changing(self):
        mutated = points.write_mutated(SAMPLE, self.points, 1)
        parts = [f'#include "mutant.h"\n#include <compare>\nnamespace mutated {{\n{mutated}}}\n']
        for number, change in enumerate(self.changes, 1):
            text = SAMPLE[:change.begin] + change.text + SAMPLE[change.end:]
            parts.append(f"namespace changed_{number} {{\n{text}}}\n")
        parts.append(f"namespace changed_0 {{\n{SAMPLE}}}\n")
        names = ", ".join(f"changed_{number}::calculate" for number in range(len(self.changes) + 1))
        parts.append(f"int (*const changed[])(int, int, bool) = {{{names}}};\n{MAIN}")
        (self.folder / "all.cpp").write_text("".join(parts))
        program = self.folder / "all"
        subprocess.run(["c++", *FLAGS, "-w", f"-I{HERE}", "-o", str(program), str(self.folder / "all.cpp")], check=True)
        for number, change in enumerate([None, *self.changes]):
            if change and (self.line_of(change), change.kind, change.text) in NOT_CALLED:
                continue
            with self.subTest(number=number, change=change):
                run = subprocess.run([str(program)], env={"CBC_MUTANT": str(number)}, capture_output=True, text=True,
                                     check=False)
                self.assertEqual((run.returncode, run.stdout), (0, ""))


if __name__ == "__main__":
    sys.exit(unittest.main())

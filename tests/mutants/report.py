"""Prints the results as Markdown: a table by file and by kind of change, and each survivor as a diff."""

import collections

VERDICTS = ("killed", "survived", "not-reached")


def print_report(mutants, results, file):
    tried = [(mutant, results[mutant.key]) for mutant in mutants if mutant.key in results]
    print_table("file", tried, lambda mutant: f"`{mutant.path}`", file)
    print_table("change", tried, lambda mutant: mutant.kind, file)
    for mutant, result in tried:
        if result.verdict != "killed":
            print(f"\n{mutant.path}:{mutant.line}:{mutant.column}: {mutant.kind}, {result.verdict}", file=file)
            for sign, text in (("-", mutant.before), ("+", mutant.after)):
                for line in text.splitlines():
                    print(f"    {sign} {line.strip()}", file=file)


def print_table(head, tried, name_of, file):
    counts = collections.defaultdict(collections.Counter)
    for mutant, result in tried:
        counts[name_of(mutant)][result.verdict] += 1
        counts["all"][result.verdict] += 1
    print(f"\n| {head} | mutants | killed | survived | not reached | killed, in percent |", file=file)
    print("| --- | ---: | ---: | ---: | ---: | ---: |", file=file)
    for name in sorted(counts, key=lambda name: (name == "all", name)):
        killed, survived, not_reached = (counts[name][verdict] for verdict in VERDICTS)
        total = killed + survived + not_reached
        print(f"| {name} | {total} | {killed} | {survived} | {not_reached} | {100 * killed / total:.1f} |", file=file)

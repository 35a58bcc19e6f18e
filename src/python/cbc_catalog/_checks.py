"""The commands of the program. Their options are those of the command line: `--time-limit 5` is
time_limit=5, `--cut-sets A --cut-sets B` is cut_sets=["A", "B"]."""

from ._program import run

# Each function has its options as parameters, so that a wrong one is a TypeError, and an editor knows
# them. So locals() has just these.


def lint(*files, script=None, summary=False, max_nodes=None, confine=None, error=None, warn=None,
         note=None, allow=None, strict=False):
    """Finds mistakes in catalogs, scripts and property files: cbc-lint(1)."""
    options = locals()
    return run("lint", options.pop("files"), options)


def solve(*files, html=None, jobs=None, stats=False, confine=None, why=None, alternatives=None,
          what_if=False, after=None, max_solutions=None, max_nodes=None,
          max_clock_events=None, time_limit=None):
    """Runs event scripts; `passed` says whether all expectations hold: cbc-solve(1)."""
    options = locals()
    return run("solve", options.pop("files"), options)


def verify(*files, scripts=None, html=None, jobs=None, confine=None, refused=None,
           outcomes=False, same_as=None, renamed=None, allow_missing=False, max_states=None,
           max_memory=None, time_limit=None, cut_sets=None, order=None, in_some_situation=False,
           situation=None, effects=False, situations=False, fail_on=None, overrides=False):
    """Proves properties in every reachable state, or shows what breaks them: cbc-verify(1)."""
    options = locals()
    return run("verify", options.pop("files"), options)


def coverage(*files, fail_under=None, jobs=None, confine=None, prove=False,
             mutants=False, scripts=None, assume=None, max_states=None,
             max_memory=None, time_limit=None, max_solutions=None, max_nodes=None,
             max_clock_events=None):
    """What event scripts test of a catalog: cbc-coverage(1)."""
    options = locals()
    return run("coverage", options.pop("files"), options)


def sweep(*files, jobs=None, stats=False, slowest=None, slowest_by_time=None,
          confine=None, against=None, renamed=None, allow_missing=False, scripts=None,
          sequences=None, seed=None, events=None, priorities=None, failures=None, faults=None,
          max_solutions=None, max_nodes=None, max_clock_events=None):
    """Runs random events and faults: cbc-sweep(1)."""
    options = locals()
    return run("sweep", options.pop("files"), options)


def tune(*files, html=None, only=None, fail_under=None, jobs=None, confine=None, all_states=False,
         max_states=None, max_memory=None, time_limit=None, margin=None):
    """How wrong each number of a catalog may be: cbc-tune(1)."""
    options = locals()
    return run("tune", options.pop("files"), options)

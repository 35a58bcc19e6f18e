#include "bench/tables.h"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <map>
#include <ostream>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace cbc::bench {
namespace {

using Run = benchmark::BenchmarkReporter::Run;
using Row = std::vector<std::string>;

/// Columns of text, the first flush left, the others flush right. A row may go on with a remark.
class Table {
 public:
  Table(std::string title, Row header) : title_(std::move(title)) { add(std::move(header)); }

  void add(Row row) { rows_.push_back(std::move(row)); }

  void print(std::ostream& out) const {
    if (rows_.size() == 1) return;
    std::vector<std::size_t> widths(rows_.front().size());
    for (const Row& row : rows_) {
      for (std::size_t i = 0; i < widths.size(); ++i) {
        widths[i] = std::max(widths[i], row[i].size());
      }
    }
    out << '\n' << title_ << "\n\n";
    for (const Row& row : rows_) {
      out << fmt::format("{:<{}}", row.front(), widths.front());
      for (std::size_t i = 1; i < widths.size(); ++i) {
        out << fmt::format("{:>{}}", row[i], widths[i] + 2);
      }
      if (row.size() > widths.size()) out << "  " << row.back();
      out << '\n';
    }
  }

 private:
  std::string title_;
  std::vector<Row> rows_;
};

/// A benchmark's name is family/subject/detail.
struct Name {
  explicit Name(const Run& run) {
    const std::string& text = run.run_name.function_name;
    const std::size_t first = text.find('/');
    const std::size_t second = text.find('/', first + 1);
    family = text.substr(0, first);
    subject = text.substr(first + 1, second - first - 1);
    detail = text.substr(second + 1);
  }

  std::string family;
  std::string subject;
  std::string detail;
};

std::string format_number(double number) { return fmt::format("{:.2f}", number); }

/// In microseconds.
double time_of(const Run& run) {
  return run.GetAdjustedRealTime() / benchmark::GetTimeUnitMultiplier(run.time_unit) * 1e6;
}

double value_of(const Run& run, const std::string& counter) {
  return run.counters.at(counter).value;
}

std::string format_count(double count) {
  return count < 1e4 ? fmt::format("{:.0f}", count) : fmt::format("{:.1e}", count);
}

/// The runs of a family by subject and detail. Subjects come in the order in which they ran.
class Family {
 public:
  Family(const std::vector<Run>& runs, const std::string& family) {
    for (const Run& run : runs) {
      const Name name(run);
      if (name.family != family) continue;
      if (runs_[name.subject].empty()) subjects_.push_back(name.subject);
      runs_[name.subject].emplace(name.detail, &run);
    }
  }

  [[nodiscard]] const std::vector<std::string>& subjects() const { return subjects_; }
  [[nodiscard]] const std::map<std::string, const Run*>& details(const std::string& subject) const {
    return runs_.at(subject);
  }
  /// Null if it did not run.
  [[nodiscard]] const Run* find(const std::string& subject, const std::string& detail) const {
    const auto entry = details(subject).find(detail);
    return entry == details(subject).end() ? nullptr : entry->second;
  }

 private:
  std::vector<std::string> subjects_;
  std::map<std::string, std::map<std::string, const Run*>> runs_;
};

void add_events(const Family& family, Table& table) {
  for (const std::string& subject : family.subjects()) {
    double sum = 0;
    double least = std::numeric_limits<double>::infinity();
    double greatest = 0;
    std::size_t proven = 0;
    std::string slowest;
    for (const auto& [detail, run] : family.details(subject)) {
      const double time = time_of(*run);
      sum += time;
      least = std::min(least, time);
      if (run->report_label == "optimal" || run->report_label == "infeasible") ++proven;
      if (time <= greatest) continue;
      greatest = time;
      slowest = detail;
    }
    const std::size_t events = family.details(subject).size();
    table.add({subject, std::to_string(events), std::to_string(proven),
               format_number(sum / static_cast<double>(events)), format_number(least),
               format_number(greatest), slowest});
  }
}

void print_events(const std::vector<Run>& runs, std::ostream& out) {
  Table table(
      "Single events, to the proven optimum: those of the missions; from idle, start of task0_*",
      {"catalog", "events", "proven", "t mean", "t min", "t max"});
  add_events(Family(runs, "mission"), table);
  add_events(Family(runs, "optimum"), table);
  table.print(out);
}

/// The paper's Table 1.
void print_missions(const std::vector<Run>& runs, std::ostream& out) {
  Table table("Missions (Table 1): n coordinations, each with the best of the first m solutions",
              {"application", "m", "n", "t mean", "t min", "t max"});
  const Family family(runs, "table1");
  for (const std::string& subject : family.subjects()) {
    for (const char* const m : {"m1", "m10", "optimum"}) {
      const Run* const run = family.find(subject, m);
      if (run == nullptr) continue;
      table.add({subject, m, format_count(value_of(*run, "coordinations")),
                 format_number(value_of(*run, "mean_us")), format_number(value_of(*run, "min_us")),
                 format_number(value_of(*run, "max_us"))});
    }
    if (const Run* const run = family.find(subject, "domains")) {
      table.add({subject, "domains", "", format_number(time_of(*run)), "", "",
                 "(their initialization alone)"});
    }
  }
  table.print(out);
}

/// The paper's Table 2.
void print_catalogs(const std::vector<Run>& runs, std::ostream& out) {
  Table table(
      "Catalogs (Table 2): c constraints, search space s, the best of the first m solutions",
      {"catalog", "c", "s", "m", "solutions", "nodes", "t"});
  const Family family(runs, "table2");
  for (const std::string& subject : family.subjects()) {
    for (const char* const m : {"m1", "m5", "optimum"}) {
      const Run* const run = family.find(subject, m);
      if (run == nullptr) continue;
      table.add({subject, format_count(value_of(*run, "constraints")),
                 format_count(value_of(*run, "space")), m,
                 format_count(value_of(*run, "solutions")), format_count(value_of(*run, "nodes")),
                 format_number(time_of(*run)), run->report_label});
    }
  }
  table.print(out);
}

void print_compiled(const std::vector<Run>& runs, std::ostream& out) {
  Table table("The compiled reference catalog; whole processes in turn on it and on the YAML",
              {"quadrotor", "t", "ratio"});
  const Family family(runs, "compiled");
  for (const std::string& subject : family.subjects()) {
    if (const Run* const run = family.find(subject, "load")) {
      table.add({"load (open, map, verify)", format_number(time_of(*run)), ""});
    }
    if (const Run* const run = family.find(subject, "solve")) {
      table.add({"cbc solve, YAML", format_number(value_of(*run, "yaml_us")), ""});
      table.add({"cbc solve, compiled", format_number(value_of(*run, "compiled_us")),
                 format_number(value_of(*run, "ratio"))});
    }
  }
  table.print(out);
}

void print_fleet_sizes(const Family& family, std::ostream& out) {
  Table table(
      "Compiling of fleets, 10 tasks and 30 behaviors a robot: seconds of the processor, and how\n"
      "many times those of the row above; megabytes, and how many times those of the YAML;\n"
      "microseconds to load",
      {"tasks", "parse", "check", "compile", "all", "times", "YAML", "compiled", "times", "load"});
  double before = 0;
  for (const std::string& subject : family.subjects()) {
    const Run* const run = family.find(subject, "compile");
    if (run == nullptr) continue;
    const double all = time_of(*run) / 1e6;
    const Run* const load = family.find(subject, "load");
    table.add({subject, format_number(value_of(*run, "parsing_s")),
               format_number(value_of(*run, "understanding_s")),
               format_number(value_of(*run, "compiling_s")), format_number(all),
               before > 0 ? format_number(all / before) : "",
               format_number(value_of(*run, "source_mb")), format_number(value_of(*run, "mb")),
               format_number(value_of(*run, "size_ratio")),
               load != nullptr ? format_number(time_of(*load)) : ""});
    before = all;
  }
  table.print(out);
}

void print_fleet_events(const Family& family, std::ostream& out) {
  Table table(
      "An event of one robot: with a catalog of its own, in the fleet, and of a random robot there",
      {"other robots", "alone", "fleet", "times", "random"});
  for (const std::string& subject : family.subjects()) {
    for (const char* const detail : {"idle", "busy"}) {
      const Run* const run = family.find(subject, detail);
      if (run == nullptr) continue;
      table.add({detail, format_number(value_of(*run, "alone_us")),
                 format_number(value_of(*run, "fleet_us")), format_number(value_of(*run, "ratio")),
                 format_number(value_of(*run, "elsewhere_us"))});
    }
  }
  table.print(out);
}

}  // namespace

void TableReporter::ReportRuns(const std::vector<Run>& runs) {
  std::vector<Run> medians;
  for (const Run& run : runs) {
    const bool is_median =
        run.run_type == Run::RT_Aggregate ? run.aggregate_name == "median" : run.repetitions <= 1;
    if (is_median && !run.error_occurred) medians.push_back(run);
  }
  medians_.insert(medians_.end(), medians.begin(), medians.end());
  display_.ReportRuns(is_for_people() && !medians.empty() ? medians : runs);
}

bool TableReporter::is_for_people() const {
  return dynamic_cast<const benchmark::ConsoleReporter*>(&display_) != nullptr;
}

void TableReporter::print_tables(std::ostream& out) const {
  if (medians_.empty()) return;
  print_missions(medians_, out);
  print_catalogs(medians_, out);
  print_events(medians_, out);
  print_compiled(medians_, out);
  const Family fleet(medians_, "fleet");
  print_fleet_sizes(fleet, out);
  print_fleet_events(fleet, out);
  out << "\nt: microseconds for a whole event (initialization of the domains, search, checker and\n"
         "applying), the median over repetitions. The CPU times above have the preparation, too.\n";
  if (fleet.subjects().empty()) {
    out << "\nCatalogs of up to 100,000 tasks: --benchmark_filter=^fleet/ (a minute).\n";
  }
}

}  // namespace cbc::bench

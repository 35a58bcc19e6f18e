#include "lint_catalogs.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace cbc::mutation {
namespace {

class Writer {
 public:
  explicit Writer(Random& random)
      : random_(random),
        list_indent_(random.percent(30) ? "  " : ""),
        uses_older_names_(random.percent(20)),
        has_comments_(random.percent(50)) {
    const std::vector<std::pair<std::string, std::string>> words{
        {"TRUE", "FALSE"}, {"true", "false"}, {"yes", "no"}};
    std::tie(true_, false_) = random_.pick(words);
  }

  std::string write() {
    make_names();
    make_lists();
    std::vector<std::function<void()>> sections{[this] { write_tasks(); },
                                                [this] { write_behaviors(); }};
    if (random_.percent(70)) sections.emplace_back([this] { write_defaults(); });
    if (!lists_.empty()) sections.emplace_back([this] { write_lists(); });
    random_.shuffle(sections);
    if (has_comments_) line("# A catalog.");
    for (const auto& section : sections) section();
    return std::move(text_);
  }

 private:
  void line(const std::string& content) { text_ += content + "\n"; }

  void gap() {
    if (!has_comments_) return;
    if (random_.percent(30)) line("");
    if (random_.percent(20)) line("# it's a comment: \"one\" [of many]");
    if (random_.percent(10)) line("      # - task: NONE");
  }

  std::string end_comment() {
    return has_comments_ && random_.percent(10) ? "  # percent, or what it is" : "";
  }

  void make_names() {
    std::vector<std::string> words{"TAKE_OFF",         "LAND",     "HOVER",
                                   "FollowPath",       "localize", "estimate-position",
                                   "MOTION_CONTROL",   "THRUST",   "Überfliegen",
                                   "recharge battery", "camera",   "OBSERVE_QR",
                                   "inform.operator",  "wait0_1"};
    random_.shuffle(words);
    words.resize(static_cast<std::size_t>(random_.between(3, 9)));
    tasks_ = words;
    // Only what something performs may be left out of the section of tasks.
    for (const std::string& task : tasks_) {
      static_cast<void>(task);
      is_listed_.push_back(!random_.percent(10));
      // The later ones are mostly services.
      is_service_.push_back(random_.percent(20 + 70 * is_service_.size() / tasks_.size()));
    }
  }

  void make_lists() {
    const auto count = static_cast<std::size_t>(random_.between(0, 3));
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<std::size_t> all(tasks_.size());
      for (std::size_t task = 0; task < all.size(); ++task) all[task] = task;
      random_.shuffle(all);
      all.resize(std::min(all.size(), static_cast<std::size_t>(random_.between(2, 4))));
      lists_.push_back(all);
    }
  }

  [[nodiscard]] bool excludes(std::size_t task, std::size_t other) const {
    return std::any_of(lists_.begin(), lists_.end(), [&](const std::vector<std::size_t>& list) {
      return std::find(list.begin(), list.end(), task) != list.end() &&
             std::find(list.begin(), list.end(), other) != list.end();
    });
  }

  std::string suitability_key() {
    return uses_older_names_ && random_.percent(50) ? "efficacy" : "suitability";
  }

  std::string suitability() {
    static const std::vector<std::string> degrees{"100", "95", "90", "80.5", "80", "70", "62.25"};
    return random_.pick(degrees);
  }

  std::string minimum() {
    static const std::vector<std::string> degrees{"10", "20", "35.5", "50"};
    return random_.pick(degrees);
  }

  std::string seconds() {
    static const std::vector<std::string> times{"15", "30", "0.5", "180"};
    return random_.pick(times);
  }

  /// Lines of a mapping: in default_values, and for the attributes of a task.
  std::vector<std::string> attributes(bool is_service) {
    std::vector<std::string> lines;
    if (uses_older_names_ && random_.percent(50)) {
      lines.emplace_back(is_service ? "category: recurrent" : "category: goal_based");
      lines.push_back("automatic_activation: " + (is_service ? true_ : false_));
    } else {
      lines.emplace_back(is_service ? "execution_goal: keep_running"
                                    : "execution_goal: achieve_goal");
      lines.push_back("start_on_request: " + (is_service ? false_ : true_));
    }
    return lines;
  }

  void write_mapping(const std::string& first, const std::string& rest,
                     const std::vector<std::string>& lines) {
    bool is_first = true;
    for (const std::string& content : lines) {
      line((is_first ? first : rest) + content + end_comment());
      is_first = false;
    }
  }

  void write_defaults() {
    line("default_values:");
    std::vector<std::string> of_tasks = attributes(random_.percent(30));
    if (random_.percent(50)) of_tasks.push_back("timeout: " + seconds());
    const std::vector<std::string> of_behaviors{suitability_key() + ": 100"};
    if (random_.percent(50)) {
      line(list_indent_ + "- tasks:");
      write_mapping(list_indent_ + "  - ", list_indent_ + "    ", of_tasks);
      line(list_indent_ + "- behaviors:");
      write_mapping(list_indent_ + "  - ", list_indent_ + "    ", of_behaviors);
    } else {
      line("  tasks:");
      write_mapping("    ", "    ", of_tasks);
      line("  behaviors:");
      write_mapping("    ", "    ", of_behaviors);
    }
  }

  void write_tasks() {
    line("tasks:");
    // There is always one, so that the section is a list.
    is_listed_[random_.below(tasks_.size())] = true;
    const std::string keys = list_indent_ + "  ";
    for (std::size_t task = 0; task < tasks_.size(); ++task) {
      if (!is_listed_[task]) continue;
      gap();
      line(list_indent_ + "- task: " + tasks_[task] + end_comment());
      std::vector<std::string> lines;
      if (random_.percent(70)) lines = attributes(is_service_[task]);
      if (!is_service_[task] && random_.percent(40)) lines.push_back("timeout: " + seconds());
      if (random_.percent(10)) lines.push_back("minimum_performance: " + minimum());
      random_.shuffle(lines);
      write_mapping(keys, keys, lines);
      if (random_.percent(30)) write_parameters(keys);
    }
  }

  void write_parameters(const std::string& keys) {
    static const std::vector<std::string> allowed{"[0, 30]", "[LEFT, RIGHT, UP]", "string",
                                                  "point_list", "[-360, 360]"};
    std::vector<std::string> names{"speed", "direction", "path"};
    random_.shuffle(names);
    names.resize(static_cast<std::size_t>(random_.between(1, 3)));
    line(keys + "parameters:");
    for (const std::string& name : names) {
      line(keys + list_indent_ + "- parameter: " + name);
      line(keys + list_indent_ + "  allowed_values: " + random_.pick(allowed));
    }
  }

  void write_behaviors() {
    line("behaviors:");
    for (std::size_t task = 0; task < tasks_.size(); ++task) {
      const std::int64_t count = random_.between(1, 3);
      for (std::int64_t i = 1; i <= count; ++i) {
        gap();
        write_behavior(task, tasks_[task] + (i == 1 ? "" : "_WITH_" + std::to_string(i * 111)));
      }
    }
  }

  void write_behavior(std::size_t task, const std::string& name) {
    const std::string keys = list_indent_ + "  ";
    line(list_indent_ + "- behavior: " + name);
    if (random_.percent(50)) line(keys + "package: some_package" + end_comment());
    std::set<std::size_t> performed{task};
    if (random_.percent(15)) performed.insert(random_.below(tasks_.size()));
    if (performed.size() > 1 || random_.percent(5)) {
      line(keys + "tasks:");
      for (const std::size_t each : performed) {
        line(keys + list_indent_ + "- task: " + tasks_[each]);
        if (random_.percent(50)) {
          line(keys + list_indent_ + "  " + suitability_key() + ": " + suitability());
        }
      }
    } else {
      line(keys + "task: " + tasks_[task]);
    }
    if (random_.percent(50)) line(keys + suitability_key() + ": " + suitability() + end_comment());
    if (random_.percent(15)) line(keys + "timeout: " + seconds());
    write_requirements(keys, performed);
  }

  /// Only of later tasks, so that there is no cycle.
  void write_requirements(const std::string& keys, const std::set<std::size_t>& performed) {
    std::vector<std::size_t> required;
    for (std::size_t task = *performed.rbegin() + 1; task < tasks_.size(); ++task) {
      const bool is_excluded = std::any_of(performed.begin(), performed.end(),
                                           [&](std::size_t own) { return excludes(own, task); });
      if (!is_excluded && random_.percent(30)) required.push_back(task);
    }
    if (required.empty()) return;
    random_.shuffle(required);
    line(keys + "requires:");
    for (const std::size_t task : required) {
      line(keys + list_indent_ + "- task: " + tasks_[task] + end_comment());
      if (random_.percent(20)) {
        line(keys + list_indent_ + "  minimum_performance: " + minimum());
      }
    }
  }

  void write_lists() {
    line("exclusivity_constraints:");
    for (const std::vector<std::size_t>& list : lists_) {
      gap();
      if (random_.percent(50)) {
        std::string names;
        for (const std::size_t task : list) names += (names.empty() ? "" : ", ") + tasks_[task];
        line(list_indent_ + "- mutually_exclusive: [" + names + "]" + end_comment());
      } else {
        line(list_indent_ + "- mutually_exclusive:");
        for (const std::size_t task : list) {
          line(list_indent_ + "  " + list_indent_ + "- " + tasks_[task]);
        }
      }
    }
  }

  Random& random_;
  std::string text_;
  std::string list_indent_;  // of a list against the key that it belongs to
  bool uses_older_names_ = false;
  bool has_comments_ = false;
  std::string true_;
  std::string false_;
  std::vector<std::string> tasks_;
  std::vector<bool> is_listed_;
  std::vector<bool> is_service_;
  std::vector<std::vector<std::size_t>> lists_;
};

}  // namespace

std::string random_catalog_text(Random& random) { return Writer(random).write(); }

}  // namespace cbc::mutation

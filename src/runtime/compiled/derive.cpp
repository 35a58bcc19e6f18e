#include "runtime/compiled/derive.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <numeric>
#include <tuple>
#include <utility>

#include "runtime/base/text.h"

namespace cbc {

namespace {

/// Lets views refer to the arrays of a catalog that is being made.
void set_views(CatalogArrays<View, Rows>& views, const GrowingCatalog& made) {
  std::apply(
      [&](auto&... to) {
        std::apply([&](const auto&... from) { ((to = from), ...); }, arrays_of(made));
      },
      arrays_of(views));
}

}  // namespace

CompiledCatalog to_catalog(GrowingCatalog made) {
  const auto arrays = std::make_shared<const GrowingCatalog>(std::move(made));
  CompiledCatalog catalog;
  catalog.storage = arrays;
  set_views(catalog, *arrays);
  catalog.set_names();
  return catalog;
}

namespace {

constexpr auto itself = [](std::uint32_t number) { return number; };

/// The places of the items with each key, ascending. Keys are less than `keys`.
template <typename Place = std::uint32_t, typename Items, typename Key>
GrowingRows<Place> group_by(const Items& items, std::size_t keys, const Key& key) {
  GrowingRows<Place> rows;
  // One entry more than is needed: begin[k + 1] is where the next item with key k goes, and so in
  // the end where the first with key k + 1 is.
  rows.begin.assign(keys + 2, 0);
  for (const auto& item : items) ++rows.begin[key(item) + 2];
  std::partial_sum(rows.begin.begin(), rows.begin.end(), rows.begin.begin());
  rows.begin.pop_back();
  rows.items.resize(items.size());
  Place place(0);
  for (const auto& item : items) {
    rows.items[rows.begin[key(item) + 1]++] = place;
    ++place;
  }
  return rows;
}

template <typename Place>
std::vector<Place> inverse(const std::vector<std::uint32_t>& order) {
  std::vector<Place> place_of(order.size());
  for (Place place(0); place < order.size(); ++place) place_of[order[place]] = place;
  return place_of;
}

}  // namespace

void derive_groups(GrowingCatalog& catalog, const DisjointSets& connected,
                   std::span<const std::uint32_t> tasks_of_behaviors) {
  const std::vector<std::uint32_t> group_of_task = connected.numbers();
  const std::size_t groups =
      group_of_task.empty() ? 0 : *std::max_element(group_of_task.begin(), group_of_task.end()) + 1;
  GrowingRows<std::uint32_t> by_group = group_by(group_of_task, groups, itself);
  catalog.task_ids = inverse<TaskId>(by_group.items);
  catalog.group_tasks = std::vector<TaskId>(by_group.begin.begin(), by_group.begin.end());

  by_group =
      group_by(tasks_of_behaviors, groups, [&](std::uint32_t task) { return group_of_task[task]; });
  catalog.behavior_ids = inverse<BehaviorId>(by_group.items);
  catalog.group_behaviors = std::vector<BehaviorId>(by_group.begin.begin(), by_group.begin.end());
}

namespace {

/// Derives arrays of a catalog, in an order in which each has what it needs.
class Derivation {
 public:
  Derivation(const CatalogArrays<View, Rows>& given, GrowingCatalog& out)
      : given_(given),
        out_(out),
        task_count_(given.tasks.size()),
        behavior_count_(given.behaviors.size()) {}

  std::optional<std::string> run(std::size_t most_masks) {
    add_places();
    add_value_tasks();
    out_.performs = group_by<ValueId>(given_.values.items, behavior_count_,
                                      [](const Value& value) { return value.behavior; });
    if (!add_arcs(most_masks)) {
      return concat("more than ", most_masks, " masks are needed");
    }
    out_.incoming =
        group_by(out_.arcs.items, task_count_, [](const Arc& arc) { return arc.target; });
    if (!add_task_levels()) return "the requirements are cyclic";
    add_behavior_levels();
    add_performance_rules();
    add_topological_order();
    out_.task_cliques = rows_by_task(given_.cliques);
    if (given_.limits.empty()) {
      out_.task_limits.begin.clear();
    } else {
      out_.task_limits = rows_by_task(given_.limited);
    }
    return std::nullopt;
  }

 private:
  void add_places() {
    for (std::uint32_t index = 0; index < task_count_; ++index) {
      out_.tasks[out_.task_ids[index]].catalog_index = index;
    }
    for (std::uint32_t index = 0; index < behavior_count_; ++index) {
      out_.behaviors[out_.behavior_ids[index]].catalog_index = index;
    }
    for (GroupId group(0); group + 1 < out_.group_tasks.size(); ++group) {
      for (TaskId id = out_.group_tasks[group]; id < out_.group_tasks[group + 1]; ++id) {
        out_.tasks[id].group = group;
      }
    }
  }

  void add_value_tasks() {
    out_.value_tasks.resize(given_.values.items.size());
    out_.words.assign(1, 0);
    out_.words.reserve(task_count_ + 1);
    for (TaskId task(0); task < task_count_; ++task) {
      const std::uint32_t first = given_.values.begin[task];
      const std::uint32_t end = given_.values.begin[task + 1];
      std::fill(out_.value_tasks.begin() + first, out_.value_tasks.begin() + end, task);
      out_.words.push_back(out_.words.back() + (end - first + 63) / 64);
    }
  }

  /// Each requirement of each value sets a bit of a mask of its own, so that the work is at most
  /// that of reading the bits of `most` masks.
  [[nodiscard]] bool add_arcs(std::size_t most) {
    std::vector<std::uint32_t> arc_to(task_count_, none);
    out_.arcs.begin.reserve(task_count_ + 1);
    for (TaskId task(0); task < task_count_; ++task) {
      const std::uint32_t words = out_.words[task + 1] - out_.words[task];
      const auto values = given_.values[task];
      const auto first = static_cast<std::uint32_t>(out_.arcs.items.size());
      for (std::size_t place = 0; place < values.size(); ++place) {
        for (const CompiledRequirement& requirement : given_.requirements[values[place].behavior]) {
          std::uint32_t& number = arc_to[requirement.task];
          if (number == none || number < first) {
            number = static_cast<std::uint32_t>(out_.arcs.items.size());
            const std::size_t mask = out_.masks.size();
            if (mask + words > most) return false;
            out_.arcs.items.push_back({task, requirement.task, static_cast<std::uint32_t>(mask)});
            out_.masks.resize(mask + words, 0);
          }
          out_.masks[out_.arcs.items[number].mask + place / 64] |= std::uint64_t{1} << (place % 64);
        }
      }
      out_.arcs.close_row();
    }
    return true;
  }

  /// The highest level of the behaviors of a task is that of the longest path of arcs from it.
  /// Tasks are taken after those that they have arcs to, which fails if arcs are cyclic.
  [[nodiscard]] bool add_task_levels() {
    std::vector<std::uint32_t> missing(task_count_);  ///< targets that were not taken, by task
    std::vector<TaskId> taken;
    taken.reserve(task_count_);
    for (TaskId task(0); task < task_count_; ++task) {
      out_.tasks[task].level = 0;
      missing[task] = static_cast<std::uint32_t>(out_.arcs[task].size());
      if (missing[task] == 0) taken.push_back(task);
    }
    for (std::size_t next = 0; next < taken.size(); ++next) {
      const TaskId task = taken[next];
      for (const std::uint32_t arc : out_.incoming[task]) {
        const TaskId source = out_.arcs.items[arc].source;
        out_.tasks[source].level = std::max(out_.tasks[source].level, out_.tasks[task].level + 1);
        if (--missing[source] == 0) taken.push_back(source);
      }
    }
    return taken.size() == task_count_;
  }

  void add_behavior_levels() {
    for (BehaviorId id(0); id < behavior_count_; ++id) {
      std::uint32_t& level = out_.behaviors[id].level;
      level = 0;
      for (const CompiledRequirement& requirement : given_.requirements[id]) {
        level = std::max(level, out_.tasks[requirement.task].level + 1);
      }
    }
  }

  void add_performance_rules() {
    for (CompiledTask& task : out_.tasks) {
      task.has_performance_rules = task.minimum_performance > 0 ? 1 : 0;
    }
    for (BehaviorId id(0); id < behavior_count_; ++id) {
      const auto requirements = given_.requirements[id];
      if (std::none_of(requirements.begin(), requirements.end(),
                       [](const auto& one) { return one.minimum_performance > 0; })) {
        continue;
      }
      for (const ValueId value : out_.performs[id]) {
        out_.tasks[out_.value_tasks[value]].has_performance_rules = 1;
      }
    }
  }

  /// Sorted by level first, and then, which keeps that order, by group.
  void add_topological_order() {
    const std::vector<TaskId> by_level =
        group_by<TaskId>(out_.tasks, task_count_, [](const CompiledTask& task) {
          return task.level;
        }).items;
    const std::vector<std::uint32_t> places =
        group_by(by_level, out_.group_tasks.size() - 1, [&](TaskId task) {
          return out_.tasks[task].group;
        }).items;
    out_.topological_order.resize(places.size());
    std::transform(places.begin(), places.end(), out_.topological_order.begin(),
                   [&](std::uint32_t place) { return by_level[place]; });
  }

  /// The lists that each task is in.
  [[nodiscard]] GrowingRows<std::uint32_t> rows_by_task(const Rows<TaskId>& lists) const {
    std::vector<std::uint32_t> list_of;  // by place in the lists
    list_of.reserve(lists.items.size());
    for (std::uint32_t list = 0; list < lists.size(); ++list) {
      list_of.insert(list_of.end(), lists[list].size(), list);
    }
    GrowingRows<std::uint32_t> rows = group_by(lists.items, task_count_, itself);
    for (std::uint32_t& item : rows.items) item = list_of[item];
    return rows;
  }

  const CatalogArrays<View, Rows>& given_;
  GrowingCatalog& out_;
  std::size_t task_count_;
  std::size_t behavior_count_;
};

}  // namespace

std::optional<std::string> derive_rest(const CatalogArrays<View, Rows>& given,
                                       GrowingCatalog& out) {
  const std::size_t most_masks = given.masks.size();
  out.masks.reserve(most_masks);
  out.arcs.items.reserve(given.arcs.items.size());
  return Derivation(given, out).run(most_masks);
}

void derive_rest(GrowingCatalog& catalog) {
  CatalogArrays<View, Rows> given;
  set_views(given, catalog);
  Derivation(given, catalog).run(UINT32_MAX);
}

namespace {

__extension__ using Wide = unsigned __int128;  // -Wpedantic knows no such type

constexpr unsigned bits = 60;  ///< after the binary point
constexpr std::uint64_t one = std::uint64_t{1} << bits;
constexpr std::uint64_t log_of_two = 799'144'290'325'165'979;  ///< ln(2) * 2^60

std::uint64_t multiply(std::uint64_t a, std::uint64_t b) {
  return static_cast<std::uint64_t>((Wide{a} * b) >> bits);
}

/// ln(m) = 2 artanh(z) = 2 (z + z^3 / 3 + z^5 / 5 + ...) with z = (m - 1) / (m + 1), for
/// n = m * 2^exponent and m in [1, 2), so that z is at most 1/3.
std::int64_t log_of_prime(Millionths prime) {
  const auto exponent = static_cast<unsigned>(std::bit_width(prime)) - 1;
  const std::uint64_t m = std::uint64_t{prime} << (bits - exponent);
  const auto z = static_cast<std::uint64_t>((Wide{m - one} << bits) / (m + one));
  const std::uint64_t square = multiply(z, z);
  std::uint64_t sum = 0;
  std::uint64_t divisor = 1;
  for (std::uint64_t power = z; power > 0; power = multiply(power, square)) {
    sum += power / divisor;
    divisor += 2;
  }
  const Wide log = Wide{exponent} * log_of_two + 2 * Wide{sum};
  constexpr unsigned surplus = bits - 40;
  return static_cast<std::int64_t>((log + (Wide{1} << (surplus - 1))) >> surplus);
}

std::int64_t sum_of_prime_logs(Millionths number) {
  std::int64_t sum = 0;
  for (Millionths divisor = 2; divisor * divisor <= number; ++divisor) {
    if (number % divisor != 0) continue;
    const std::int64_t log = log_of_prime(divisor);
    for (; number % divisor == 0; number /= divisor) sum += log;
  }
  return number > 1 ? sum + log_of_prime(number) : sum;
}

/// e^-x for x below ln(2), rounded up. The terms of the series are less than a unit off each.
std::uint64_t exponential(std::uint64_t x) {
  constexpr std::uint64_t error = 32;
  std::uint64_t sum = one;
  std::uint64_t term = one;
  bool is_added = false;
  for (std::uint64_t divisor = 1; term > 0; ++divisor, is_added = !is_added) {
    term = multiply(term, x) / divisor;
    sum = is_added ? sum + term : sum - term;
  }
  return sum + error;
}

}  // namespace

std::int64_t log_cost(Millionths degree) {
  if (degree == 0) return 0;
  return sum_of_prime_logs(one_million) - sum_of_prime_logs(degree);
}

double highest_product(std::int64_t cost, std::uint32_t factors) {
  constexpr std::int64_t unit = std::int64_t{1} << 40;
  constexpr std::int64_t with_zero = std::int64_t{1} << 60;  // a suitability of 0
  if (cost >= with_zero) return 0;
  const std::int64_t least = cost - log_cost_error * std::int64_t{factors};
  if (least <= 0) return 1;
  constexpr double e_to_minus_700 = 1e-304;  // rounded up
  if (least >= 700 * unit) return e_to_minus_700;
  const Wide log = Wide{static_cast<std::uint64_t>(least)} << (bits - 40);
  const auto halvings = static_cast<int>(log / log_of_two);
  const auto rest = static_cast<std::uint64_t>(log % log_of_two);
  const double product =
      std::ldexp(static_cast<double>(exponential(rest)), -static_cast<int>(bits) - halvings);
  return std::min(1.0, std::nextafter(product, 1.0));
}

}  // namespace cbc

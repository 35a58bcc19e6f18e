// How long events take in C++: live_events CATALOG.cbc EVENTS TASK..., which starts and stops the
// tasks in turn. Prints nanoseconds for one event. compare.py does the same in Python.
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <span>
#include <vector>

#include "cbc/live_coordinator.h"

namespace {

std::optional<std::vector<cbc::Event>> read_events(const cbc::LoadedCatalog& catalog,
                                                   std::span<char*> tasks) {
  std::vector<cbc::Event> events;
  for (const cbc::Verb verb : {cbc::Verb::start, cbc::Verb::stop}) {
    for (const char* const task : tasks) {
      const std::optional<std::uint32_t> found = catalog.find_task(task);
      if (!found) return std::nullopt;
      cbc::Event& event = events.emplace_back();
      event.verb = verb;
      event.subject = *found;
    }
  }
  return events;
}

}  // namespace

int main(int argc, char** argv) {
  const std::span<char*> arguments(argv, static_cast<std::size_t>(argc));
  if (arguments.size() < 4) return 2;
  const cbc::CatalogLoading loading = cbc::LoadedCatalog::load(arguments[1]);
  if (!loading.catalog) {
    std::fprintf(stderr, "%s: %s\n", arguments[1], loading.error.c_str());
    return 2;
  }
  const auto events = read_events(*loading.catalog, arguments.subspan(3));
  if (!events) return 2;
  const std::uint64_t count = std::strtoull(arguments[2], nullptr, 10);
  cbc::LiveCoordinator robot(*loading.catalog);
  const auto begin = std::chrono::steady_clock::now();
  for (std::uint64_t number = 0; number < count; ++number) {
    if (robot.handle(0, (*events)[number % events->size()]) != cbc::LiveStatus::ok) return 1;
  }
  const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - begin;
  std::printf("%.0f\n", time.count() / static_cast<double>(count));
}

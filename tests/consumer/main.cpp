// Drives a short flight of the quadrotor, and prints what its behaviors have to do.
#include <cstdint>
#include <iostream>
#include <string_view>

#include <cbc/live_coordinator.h>
#include <cbc/version.h>

namespace {

void print(const cbc::LoadedCatalog& catalog, const cbc::HandledEvent& event) {
  const bool is_of_behavior = event.verb == cbc::Verb::finish;
  std::cout << event.time / 1000 << " ms, " << name_of(event.origin) << ", " << name_of(event.verb)
            << ' '
            << (is_of_behavior ? catalog.behavior_name(event.subject)
                               : catalog.task_name(event.subject))
            << ": " << name_of(event.outcome) << '\n';
  for (const cbc::BehaviorChange& change : event.changes) {
    std::cout << (change.is_activation ? "  activate " : "  deactivate ")
              << catalog.behavior_name(change.behavior) << " for";
    for (const auto task : change.tasks) std::cout << ' ' << catalog.task_name(task);
    std::cout << ", " << name_of(change.cause) << '\n';
  }
  for (const cbc::TaskStop& stop : event.stopped_tasks) {
    std::cout << "  stopped: " << catalog.task_name(stop.task) << ", " << name_of(stop.cause)
              << '\n';
  }
}

class Flight {
 public:
  explicit Flight(const cbc::LoadedCatalog& catalog) : catalog_(catalog), coordinator_(catalog) {}

  void start(cbc::Microseconds time, std::string_view task, std::string_view parameters) {
    cbc::Event event;
    event.verb = cbc::Verb::start;
    event.subject = catalog_.find_task(task).value_or(UINT32_MAX);
    event.parameters = parameters;
    conclude(coordinator_.handle(time, event));
  }

  void finish(cbc::Microseconds time, std::string_view behavior) {
    cbc::Event event;
    event.verb = cbc::Verb::finish;
    event.subject = catalog_.find_behavior(behavior).value_or(UINT32_MAX);
    event.cause = cbc::FinishCause::goal_achieved;
    conclude(coordinator_.handle(time, event));
  }

  /// What a timer does: sleeps until something is due.
  void wait() {
    if (const auto due = coordinator_.next_due()) conclude(coordinator_.advance_to(*due));
  }

  void print_running() const {
    for (std::uint32_t task = 0; task < catalog_.task_count(); ++task) {
      if (const auto behavior = coordinator_.behavior_of(task)) {
        std::cout << catalog_.task_name(task) << " runs with " << catalog_.behavior_name(*behavior)
                  << '\n';
      }
    }
  }

 private:
  void conclude(cbc::LiveStatus status) {
    if (status != cbc::LiveStatus::ok) std::cout << "refused: " << name_of(status) << '\n';
    for (const cbc::HandledEvent& event : coordinator_.events()) print(catalog_, event);
  }

  cbc::LoadedCatalog catalog_;
  cbc::LiveCoordinator coordinator_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: consumer CATALOG (a compiled one)\n";
    return 2;
  }
  const cbc::CatalogLoading loading = cbc::LoadedCatalog::load(argv[1]);
  if (!loading.catalog) {
    std::cerr << argv[1] << ": " << loading.error << '\n';
    return 2;
  }
  std::cout << "cbc " << cbc::version << '\n';
  Flight flight(*loading.catalog);
  flight.start(0, "TAKE_OFF", "");
  flight.finish(4 * cbc::second, "TAKE_OFF");
  flight.start(6 * cbc::second, "ROTATE", "{angle: 90}");
  flight.wait();
  flight.start(40 * cbc::second, "FLY", "");
  flight.print_running();
}

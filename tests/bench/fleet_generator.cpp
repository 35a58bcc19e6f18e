#include "bench/fleet_generator.h"

#include <array>
#include <iterator>
#include <random>
#include <string_view>

#include <fmt/format.h>

namespace cbc::bench {
namespace {

constexpr std::string_view head =
    R"(#------------------------------------------------------
# BRIEF: Catalog of the behaviors of a fleet of robots.
#------------------------------------------------------
default_values:
- tasks:
  - execution_goal: achieve_goal
    start_on_request: TRUE
    reactive_start: FALSE
    timeout: 15
- behaviors:
  - suitability: 100

)";
constexpr std::string_view line = "#------------------------------------------------------\n";

struct MissionKind {
  std::string_view name;
  std::string_view attributes;
};
constexpr std::array<MissionKind, 8> mission_kinds{{
    {"FOLLOW_PATH",
     "  timeout: 180\n"
     "  parameters:\n"
     "  - parameter: path\n"
     "    allowed_values: point_list\n"},
    {"ROTATE",
     "  timeout: 30\n"
     "  parameters:\n"
     "  - parameter: angle\n"
     "    allowed_values: [-360,360]\n"
     "  - parameter: relative_angle\n"
     "    allowed_values: [-360,360]\n"},
    {"MOVE",
     "  parameters:\n"
     "  - parameter: speed\n"
     "    allowed_values: [0,30]\n"
     "  - parameter: direction\n"
     "    allowed_values: [FORWARD, BACKWARD, LEFT, RIGHT]\n"},
    {"TAKE_OFF", ""},
    {"HOVER", "  execution_goal: keep_running\n  start_on_request: FALSE\n"},
    {"LAND", ""},
    {"GENERATE_PATH",
     "  parameters:\n"
     "  - parameter: destination\n"
     "    allowed_values: point\n"},
    {"INSPECT_AREA",
     "  timeout: 600\n"
     "  parameters:\n"
     "  - parameter: area\n"
     "    allowed_values: point_list\n"},
}};
constexpr std::array<std::string_view, 6> service_kinds{"PID_MOTION_CONTROL", "MPC_MOTION_CONTROL",
                                                        "SELF_LOCALIZE",      "THRUST_CONTROL",
                                                        "ESTIMATE_POSITION",  "DETECT_OBSTACLES"};

struct Method {
  std::string_view name;
  std::string_view package;
};
constexpr std::array<Method, 6> mission_methods{
    {{"WITH_PID_CONTROL", "quadrotor_motion_with_pid_control"},
     {"WITH_MPC_CONTROL", "quadrotor_motion_with_mpc_control"},
     {"WITH_LIDAR", "navigation_with_lidar"},
     {"WITH_VISUAL_MARKERS", "attention_to_visual_markers"},
     {"WITH_OCCUPANCY_GRID", "navigation_with_occupancy_grid"},
     {"WITH_OPERATOR_ASSISTANCE", "interaction_with_operator"}}};
constexpr std::array<Method, 5> service_methods{
    {{"WITH_EKF_SENSOR_FUSION", "multi_sensor_fusion"},
     {"WITH_GROUND_TRUTH", "basic_quadrotor_behaviors"},
     {"WITH_VISUAL_ODOMETRY", "visual_odometry_with_stereo_camera"},
     {"WITH_LIDAR", "navigation_with_lidar"},
     {"WITH_LINEAR_SPEED", "basic_quadrotor_behaviors"}}};

/// The kinds are used over again where they are too few; then the name tells the round.
std::string numbered(std::string_view name, std::size_t round) {
  return round == 0 ? std::string(name) : fmt::format("{}_{}", name, round + 1);
}

std::string name_of_robot(std::size_t robot) { return fmt::format("QUADROTOR_{:05}", robot + 1); }

class Generator {
 public:
  explicit Generator(const FleetShape& shape)
      : shape_(shape), missions_(shape.tasks / 2), text_(head) {}

  std::string run() {
    behaviors_ = "behaviors:\n";
    tasks_ = "tasks:\n\n";
    lists_ = "exclusivity_constraints:\n\n";
    for (std::size_t robot = shape_.first; robot < shape_.first + shape_.robots; ++robot) {
      random_.seed(shape_.seed + robot);
      behaviors_ += line;
      for (std::size_t task = 0; task < shape_.tasks; ++task) write_task(robot, task);
      write_lists(robot);
    }
    text_.append(behaviors_).append(line).append(tasks_).append(line).append(lists_);
    return std::move(text_);
  }

 private:
  template <typename... Values>
  static void add(std::string& text, fmt::format_string<const Values&...> pattern,
                  const Values&... values) {
    fmt::format_to(std::back_inserter(text), pattern, values...);
  }

  // The distributions of the standard library are not the same everywhere.
  std::size_t below(std::size_t bound) { return static_cast<std::size_t>(random_() % bound); }

  [[nodiscard]] bool is_mission(std::size_t task) const { return task < missions_; }
  [[nodiscard]] bool is_controller(std::size_t task) const {
    return task == missions_ || task == missions_ + 1;
  }
  /// What stands after the two controllers requires nothing that could exclude something.
  [[nodiscard]] std::size_t first_service() const { return missions_ + 2; }

  [[nodiscard]] std::string name_of_task(std::size_t robot, std::size_t task) const {
    if (is_mission(task)) return name_of_mission(robot, task);
    const std::size_t place = task - missions_;
    return fmt::format(
        "{}_{}", name_of_robot(robot),
        numbered(service_kinds[place % service_kinds.size()], place / service_kinds.size()));
  }

  void write_task(std::size_t robot, std::size_t task) {
    const std::string name = name_of_task(robot, task);
    const std::size_t before = shape_.behaviors * task / shape_.tasks;
    const std::size_t count = shape_.behaviors * (task + 1) / shape_.tasks - before;
    for (std::size_t place = 0; place < count; ++place) write_behavior(robot, task, name, place);
    add(tasks_, "- task: {}\n", name);
    if (is_mission(task)) {
      tasks_ += mission_kinds[task % mission_kinds.size()].attributes;
    } else {
      tasks_ += "  start_on_request: FALSE\n  execution_goal: keep_running\n";
    }
    tasks_ += '\n';
  }

  void write_behavior(std::size_t robot, std::size_t task, const std::string& name,
                      std::size_t place) {
    const std::size_t methods = is_mission(task) ? mission_methods.size() : service_methods.size();
    // The first method of a task is drawn, so that robots are not all alike.
    if (place == 0) first_method_ = below(methods);
    const std::size_t number = first_method_ + place;
    const Method& method =
        is_mission(task) ? mission_methods[number % methods] : service_methods[number % methods];
    add(behaviors_, "- behavior: {}_{}\n  package: {}\n  task: {}\n", name,
        numbered(method.name, place / methods), method.package, name);
    // The best of each task reaches every minimum that is asked for.
    if (place > 0 && below(4) > 0) add(behaviors_, "  suitability: {}\n", 60 + 5 * below(8));
    if (is_mission(task)) {
      write_mission_requirements(robot, task, place);
    } else if (is_controller(task)) {
      behaviors_ += "  requires:\n";
      write_requirement(robot, place == 0 ? first_service() : draw_service());
    } else if (task + 1 < shape_.tasks && place > 0 && below(3) == 0) {
      behaviors_ += "  requires:\n";
      write_requirement(robot, task + 1 + below(shape_.tasks - task - 1));
    }
    behaviors_ += '\n';
  }

  /// A controller, a service, or both. The first behaviors of the missions hold the group together.
  void write_mission_requirements(std::size_t robot, std::size_t task, std::size_t place) {
    const std::size_t kind = place == 0 ? 0 : below(5);
    if (kind == 4) return;
    behaviors_ += "  requires:\n";
    if (kind < 3) write_requirement(robot, missions_ + below(2));
    if (place == 0) {
      for (std::size_t service = first_service() + task; service < shape_.tasks;
           service += missions_) {
        write_requirement(robot, service);
      }
    } else if (kind > 1) {
      write_requirement(robot, draw_service());
    }
  }

  std::size_t draw_service() { return first_service() + below(shape_.tasks - first_service()); }

  void write_requirement(std::size_t robot, std::size_t task) {
    add(behaviors_, "  - task: {}\n", name_of_task(robot, task));
    if (below(3) == 0) add(behaviors_, "    minimum_performance: {}\n", 50 + 10 * below(4));
  }

  void write_lists(std::size_t robot) {
    lists_ += "- mutually_exclusive:\n";
    for (std::size_t task = 0; task < missions_; ++task) {
      add(lists_, "  - {}\n", name_of_task(robot, task));
    }
    add(lists_, "\n- mutually_exclusive:\n  - {}\n  - {}\n\n", name_of_task(robot, missions_),
        name_of_task(robot, missions_ + 1));
  }

  const FleetShape shape_;
  const std::size_t missions_;
  std::mt19937_64 random_;
  std::size_t first_method_ = 0;
  std::string text_;
  std::string behaviors_;
  std::string tasks_;
  std::string lists_;
};

}  // namespace

std::string generate_fleet(const FleetShape& shape) { return Generator(shape).run(); }

std::string name_of_mission(std::size_t robot, std::size_t place) {
  return fmt::format(
      "{}_{}", name_of_robot(robot),
      numbered(mission_kinds[place % mission_kinds.size()].name, place / mission_kinds.size()));
}

}  // namespace cbc::bench

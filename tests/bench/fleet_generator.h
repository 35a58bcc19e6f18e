#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace cbc::bench {

/// A catalog of many robots, each a group of its own: missions, of which one runs at a time, two
/// controllers that exclude one another, and services that these require. Robots differ in what
/// their behaviors require and in how well they suit.
struct FleetShape {
  std::size_t robots = 0;
  std::size_t tasks = 0;      ///< of a robot; at least 6
  std::size_t behaviors = 0;  ///< of a robot; at least one for each task
  std::uint64_t seed = 0;     ///< of everything that is drawn
  std::size_t first = 0;      ///< number of the first robot
};

/// A catalog file without errors, in the style of the published ones. The same shape gives the same
/// text everywhere; a robot is the same in every fleet that it is in.
[[nodiscard]] std::string generate_fleet(const FleetShape& shape);

/// Name of the mission with this place (0 up to half the tasks) of a robot.
[[nodiscard]] std::string name_of_mission(std::size_t robot, std::size_t place);

}  // namespace cbc::bench

#pragma once

#include <optional>
#include <string>
#include <string_view>

/// The page of the simulator: one file, which `./dev play` makes, and which is no part of the
/// program.
namespace cbc {

/// The file of an installed program, ../share/cbc/play/cbc-play.html from its folder. Empty if it
/// is not there.
[[nodiscard]] std::optional<std::string> installed_simulator();

/// The same, or else that beside the folder of a build, ../play/cbc-play.html.
[[nodiscard]] std::optional<std::string> find_simulator();

/// The page with a session in it, which may ask the server that it comes from. `session` is JSON.
/// Empty if `page` is none of the simulator.
[[nodiscard]] std::optional<std::string> simulator_with(std::string page, std::string_view session);

}  // namespace cbc

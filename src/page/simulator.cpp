#include "page/simulator.h"

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <system_error>

#include "page/script_element.h"

namespace cbc {
namespace {

constexpr std::string_view no_session =
    R"(<script type="application/json" id="saved-session">null</script>)";
constexpr std::string_view no_server = "connect-src 'none'";

std::optional<std::string> find_beside_program(std::initializer_list<const char*> places) {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return std::nullopt;
  for (const char* const place : places) {
    std::filesystem::path file = (program.parent_path() / place).lexically_normal();
    if (std::filesystem::is_regular_file(file, error)) return file.string();
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> installed_simulator() {
  return find_beside_program({"../share/cbc/play/cbc-play.html"});
}

std::optional<std::string> find_simulator() {
  return find_beside_program({"../share/cbc/play/cbc-play.html", "../play/cbc-play.html"});
}

std::optional<std::string> simulator_with(std::string page, std::string_view session) {
  const std::size_t policy = page.find(no_server);
  if (policy == std::string::npos) return std::nullopt;
  page.replace(policy, no_server.size(), "connect-src 'self'");
  const std::size_t element = page.find(no_session);
  if (element == std::string::npos) return std::nullopt;
  const std::size_t begin = element + no_session.find("null");
  std::string rest = page.substr(begin + std::string_view("null").size());
  page.resize(begin);
  add_to_script_element(page, session);
  return page + rest;
}

}  // namespace cbc

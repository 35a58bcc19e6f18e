#include <charconv>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <poll.h>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "commands.h"
#include "core/command_line/command_line.h"
#include "core/files/file_set.h"
#include "core/files/output.h"
#include "core/files/read.h"
#include "core/files/signals.h"
#include "core/support/json.h"
#include "page/serve/server.h"
#include "page/simulator.h"
#include "play/edited_file.h"
#include "runtime/base/text.h"

namespace cbc::cli {
namespace {

struct PlayOptions {
  std::vector<std::string> paths;
  std::string address = serve::default_address;
};

constexpr const char* play_examples =
    "  cbc play robot.yaml                      drive a robot in a browser\n"
    "  cbc play robot.yaml mission.yaml         from the end of a mission\n"
    "  cbc play robot.yaml properties.yaml      with properties to prove\n"
    "  cbc play robot.yaml --address 127.0.0.1:0\n"
    "                                           at a free port\n";

constexpr const char* play_footer =
    "The program prints the address to open, and runs until Ctrl-C. The page saves on request, and "
    "into these files only; it asks before it replaces what others have written meanwhile.\n"
    "\n"
    "Exit status: 0 it was ended, 2 the input or the usage is wrong, or the page cannot be served, "
    "3 an internal error (please report it).\n"
    "\n"
    "Read more: man cbc-play";

constexpr std::string_view catalog = "catalog";
constexpr std::string_view mission = "mission";
constexpr std::string_view properties = "properties";

/// By what they are for the page, one of these words.
using EditedFiles = std::map<std::string, EditedFile, std::less<>>;

Values loopback_address() {
  return {"ADDRESS:PORT", "ADDRESS:PORT",
          [](const std::string& text) -> std::string {
            const auto address = serve::read_address(text);
            if (address && serve::is_loopback(address->host)) return {};
            return fmt::format(
                "expected a numeric ADDRESS:PORT of this machine alone, such as {} or [::1]:0, "
                "found {}",
                serve::default_address, quote(text));
          },
          [] {
            return std::vector<NameWithHelp>{{serve::default_address, "the default"},
                                             {"127.0.0.1:0", "a free port"}};
          }};
}

/// What a file is for the page; empty if it is nothing, which is printed.
std::string_view role_of(const InputFile& file) {
  switch (file.what.kind) {
    case FileKind::catalog:
      return catalog;
    case FileKind::script:
      return mission;
    case FileKind::properties:
      return properties;
    case FileKind::compiled:
      complain("{} is a compiled catalog, which has no text; expected one in YAML",
               quote(file.name));
      return {};
    case FileKind::log:
      complain_of_log(file);
      return {};
    case FileKind::settings:
    case FileKind::other:
      break;
  }
  complain("{} is neither a catalog nor an event script nor a property file", quote(file.name));
  return {};
}

/// Empty if they cannot be used, which is printed.
std::optional<EditedFiles> read_files(const std::vector<std::string>& paths) {
  EditedFiles files;
  for (const std::string& path : paths) {
    if (path == "-") {
      complain("expected a file, found '-': nothing can be saved into standard input");
      return std::nullopt;
    }
    const auto file = FileSet().open(path);
    const std::string_view role = file == nullptr ? std::string_view() : role_of(*file);
    if (role.empty()) return std::nullopt;
    if (const auto obstacle = EditedFile::find_obstacle(*file->text)) {
      return cannot_read(path, *obstacle);
    }
    const auto [place, is_new] = files.try_emplace(std::string(role), path, *file->text);
    if (is_new) continue;
    complain("expected one file of each kind; both {} and {} are {}", quote(place->second.path()),
             quote(path),
             role == catalog   ? "catalogs"
             : role == mission ? "event scripts"
                               : "property files");
    return std::nullopt;
  }
  if (files.find(catalog) != files.end()) return files;
  complain("expected a catalog among the files: cbc play CATALOG [MISSION] [PROPERTIES]");
  return std::nullopt;
}

/// What the page begins with, as JSON.
std::string session_of(const EditedFiles& files) {
  std::string session;
  JsonWriter json(session);
  json.open('{');
  const std::filesystem::path path = files.find(catalog)->second.path();
  json.write("name", printable(path.filename().string()));
  for (const auto& [role, file] : files) json.write(role, file.text());
  json.open("files", '{');
  for (const auto& [role, file] : files) {
    json.key(role);
    json.open('{');
    json.write("name", printable(file.path()));
    json.write("version", file.version());
    json.close('}');
  }
  json.close('}');
  json.close('}');
  return session;
}

/// The page with what is in the files now. `page`: of the simulator.
std::string page_of(const std::string& page, EditedFiles& files) {
  for (auto& [role, file] : files) file.look();
  return simulator_with(page, session_of(files)).value_or(std::string());
}

/// The number in "version=NUMBER"; empty if it is something else.
std::optional<std::uint64_t> version_in(std::string_view query) {
  constexpr std::string_view name = "version=";
  if (!query.starts_with(name)) return std::nullopt;
  std::uint64_t version = 0;
  const char* const end = query.data() + query.size();
  const auto [stop, error] = std::from_chars(query.data() + name.size(), end, version);
  if (error != std::errc() || stop != end) return std::nullopt;
  return version;
}

/// Takes a text that the page saves. A page always knows a version; none is 0.
serve::Reply save(EditedFiles& files, std::string_view role, std::string_view query,
                  std::string_view text) {
  const auto file = files.find(role);
  if (file == files.end()) return refusal("404 Not Found", "there is no such file");
  return file->second.replace(version_in(query).value_or(0), text);
}

/// The page of the simulator; empty if there is none, which is printed.
std::optional<std::string> read_simulator() {
  const std::optional<std::string> place = find_simulator();
  if (!place) {
    complain(
        "the page of the simulator, cbc-play.html, is not there: expected it in ../share/cbc/play "
        "or ../play from the folder of this program; './dev play' makes it in the sources of cbc");
    return std::nullopt;
  }
  std::optional<std::string> page = read_input(*place);
  if (page && !simulator_with(*page, "null")) {
    complain("{} is no page of this version of the simulator; './dev play' makes it anew",
             quote(*place));
    return std::nullopt;
  }
  return page;
}

int play(const PlayOptions& options) {
  std::optional<EditedFiles> files = read_files(options.paths);
  if (!files) return exit_unusable;
  const std::optional<std::string> page = read_simulator();
  if (!page) return exit_unusable;
  const StopSignals signals;
  serve::Server::Site site;
  // A secret one: other users of this machine can connect as well.
  site.path = "/" + serve::make_token() + "/";
  site.page = [&] { return page_of(*page, *files); };
  site.put = [&](std::string_view role, std::string_view query, std::string_view text) {
    return save(*files, role, query, text);
  };
  const std::string path = site.path.substr(1);
  const auto [server, error] =
      serve::Server::start(*serve::read_address(options.address), std::move(site));
  if (server == nullptr) {
    return complain("cannot serve a page at {}: {}; '--address 127.0.0.1:0' takes a free port",
                    quote(options.address), error);
  }
  complain("simulator: {}{} (Ctrl-C ends it)", serve::to_url(server->address()), path);
  pollfd signal{signals.descriptor(), POLLIN, 0};
  while (!signals.have_come()) ::poll(&signal, 1, -1);
  return exit_ok;
}

}  // namespace

void add_play_command(Program& program) {
  const auto options = std::make_shared<PlayOptions>();
  Command& command = program.add_command(
      "play", "Serves the simulator: drive a robot in a browser.",
      {{"[OPTION...] CATALOG [MISSION] [PROPERTIES]"}, play_examples, play_footer});
  command
      .argument("FILE", options->paths, input("...", ValueKind::catalog_or_script),
                "A catalog; perhaps an event script and a property file")
      .required();
  command.option("--address", options->address, loopback_address(), "Where to serve it");
  command.add_confinement();
  command.action([options] { return play(*options); });
}

}  // namespace cbc::cli

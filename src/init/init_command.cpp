#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/core.h>

#include "commands.h"
#include "core/command_line/command_line.h"
#include "core/files/output.h"
#include "init_files.h"
#include "runtime/base/mapped_file.h"
#include "runtime/base/text.h"
#include "schema_files.h"

// Writes the first files of a project. Their texts are those of the folder src/init/files.
namespace cbc::cli {
namespace {

namespace fs = std::filesystem;

/// The only entry of this name; its absence is an error of compilation.
template <typename Table>
constexpr std::string_view text_in(const Table& table, std::string_view name) {
  const auto found = std::find_if(std::begin(table), std::end(table),
                                  [&](const EmbeddedFile& file) { return file.name == name; });
  return found->text;
}

struct NewFile {
  std::string_view path;  ///< in the folder
  std::string_view purpose;
  std::string_view text;
};

// The schemas are in a hidden folder, which other commands skip. None of them refers to another.
constexpr std::array new_files = {
    NewFile{"robot.yaml", "the catalog: what the robot can do, and how well",
            text_in(init_files, "robot.yaml")},
    NewFile{"missions/delivery.yaml", "a mission: what happens, and what you expect",
            text_in(init_files, "missions/delivery.yaml")},
    NewFile{".cbc.yaml", "settings: warnings fail, too", text_in(init_files, ".cbc.yaml")},
    NewFile{"ci.sh", "what continuous integration runs", text_in(init_files, "ci.sh")},
    NewFile{".cbc/catalog.json", "the schema of catalogs, for editors",
            text_in(schema_files, "catalog")},
    NewFile{".cbc/script.json", "the schema of missions", text_in(schema_files, "script")},
    NewFile{".cbc/settings.json", "the schema of settings", text_in(schema_files, "settings")},
};
static_assert(std::size(init_files) + 3 == new_files.size(),
              "all files of src/init/files are listed");

constexpr const char* init_examples =
    "  cbc init          in the current folder\n"
    "  cbc init robot    in a folder, which is created if it is missing\n";

constexpr const char* init_footer =
    "It writes a small catalog, a mission with expectations, settings of lint, a script for "
    "continuous integration, and the schemas that their first lines name, by which an editor with "
    "the YAML language server completes and explains keys. Comments in the files explain them. If "
    "one of the files exists, nothing is written, unless it is what an interrupted run has left.\n"
    "\n"
    "Exit status: 0 the files are written, 2 a file exists or cannot be written, or the usage is "
    "wrong.\n"
    "\n"
    "Read more: man cbc-init, man cbc-catalog, man cbc-events";

/// Writes a file that does not exist. Returns the exit status.
int write_new_file(const std::string& path, std::string_view text) {
  std::error_code error;
  const fs::path folder = fs::path(path).parent_path();
  if (!folder.empty()) fs::create_directories(folder, error);
  if (error) return complain("cannot write {}: {}", quote(path), error.message());
  return create_output(path, text);
}

/// Whether a file has this content. One that cannot be read has another.
bool has_content(const std::string& path, std::string_view text) {
  const MappedFile file = map_file(path, text.size());
  return file.memory != nullptr && file.content == text;
}

/// Where the files of a folder go, in their order.
std::vector<std::string> paths_in(const std::string& folder) {
  std::vector<std::string> paths;
  paths.reserve(std::size(new_files));
  for (const NewFile& file : new_files) {
    paths.push_back((fs::path(folder) / file.path).lexically_normal().string());
  }
  return paths;
}

void print_next_commands(const std::string& folder) {
  fmt::print("\nnext:\n");
  if (folder != ".") {
    const bool is_one_word = folder.find_first_of(" \t\n'\"\\$&;()<>|*?`") == std::string::npos;
    fmt::print("  cd {}\n", is_one_word ? printable(folder) : quote(folder));
  }
  fmt::print(
      "  cbc lint .\n"
      "  cbc solve missions/delivery.yaml\n"
      "  cbc solve missions/ --html missions.html\n");
}

int init(const std::string& folder) {
  const std::vector<std::string> paths = paths_in(folder);
  std::vector<std::string> existing;
  std::vector<bool> is_written(paths.size(), false);
  std::size_t width = 0;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    std::error_code error;
    if (fs::exists(fs::symlink_status(paths[i], error))) existing.push_back(quote(paths[i]));
    is_written[i] = has_content(paths[i], new_files[i].text);
    width = std::max(width, paths[i].size());
  }
  // What a run that ended early has left is completed.
  const auto written = std::count(is_written.begin(), is_written.end(), true);
  const bool is_rest = existing.size() < paths.size() && written == std::ssize(existing);
  if (!existing.empty() && !is_rest) {
    return complain("{} {}; nothing is written", join(existing, ", "),
                    existing.size() == 1 ? "exists" : "exist");
  }
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (is_written[i]) continue;
    if (const int status = write_new_file(paths[i], new_files[i].text); status != exit_ok) {
      return status;
    }
    fmt::print("wrote {:<{}}  {}\n", printable(paths[i]), width, new_files[i].purpose);
  }
  print_next_commands(fs::path(folder).lexically_normal().string());
  return exit_ok;
}

}  // namespace

void add_init_command(Program& program) {
  const auto target = std::make_shared<std::string>(".");
  Command& command = program.add_command(
      "init", "Writes a first catalog and mission, with what an editor and CI need.",
      {{"[FOLDER]"}, init_examples, init_footer});
  command.argument("FOLDER", *target, folder(""), "Where to write the files");
  command.action([target] { return init(*target); });
}

}  // namespace cbc::cli

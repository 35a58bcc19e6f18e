#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <fmt/core.h>

#include "cbc/version.h"
#include "commands.h"
#include "compile/catalog_dump.h"
#include "core/command_line/command_line.h"
#include "core/compile/compile.h"
#include "core/files/file_set.h"
#include "core/files/output.h"
#include "core/files/read.h"
#include "runtime/base/mapped_file.h"
#include "runtime/base/text.h"
#include "runtime/compiled/compiled_file.h"

namespace cbc::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* compile_examples =
    "  cbc compile robot.yaml                    writes robot.cbc\n"
    "  cbc compile --check robot.yaml            is robot.cbc up to date?\n"
    "  cbc compile --dump robot.cbc              its contents, as JSON\n"
    "  cbc solve robot.cbc mission.yaml          uses it in place of the YAML\n";

constexpr const char* compile_footer =
    "A catalog with errors is not compiled. The same catalog gives the same bytes on every "
    "machine, and the file is replaced as a whole or not at all. On success "
    "only warnings are printed.\n"
    "\n"
    "Exit status: 0 success, 1 the file checked with --check is not up to date, 2 the catalog has "
    "errors, a file could not be read or written, or the usage is wrong, 3 an internal error.\n"
    "\n"
    "Read more: man cbc-compile";

struct CompileCommand {
  std::string catalog;
  std::optional<std::string> output;
  bool check = false;
  bool dump = false;
};

std::string output_of(const CompileCommand& command) {
  if (command.output) return *command.output;
  return fs::path(command.catalog).replace_extension(".cbc").string();
}

/// A catalog in YAML, ready to be compiled.
struct Source {
  Catalog catalog;
  Digest digest;
};

/// Also prints the findings. Empty if there are errors.
std::optional<Source> understand(FileSet& files, const InputFile& file) {
  FileSet::Check checked = files.check(file, FileSet::Purpose::compilation);
  files.print_findings();
  if (!checked.is_usable) return std::nullopt;
  return Source{std::move(checked.catalog.reading.catalog), digest_of(*file.text)};
}

/// Null if the file cannot be used; the findings are printed then.
std::shared_ptr<const InputFile> read_catalog(FileSet& files, const std::string& path) {
  auto file = files.read_catalog(path);
  if (file == nullptr) files.print_findings();
  return file;
}

std::optional<Source> read_source(const std::string& path) {
  FileSet files;
  const auto file = read_catalog(files, path);
  if (file == nullptr) return std::nullopt;
  if (file->is(FileKind::compiled)) {
    complain("{} is a compiled catalog already; expected one in YAML", quote(file->name));
    return std::nullopt;
  }
  return understand(files, *file);
}

/// A compiled file, and the catalog that its readers find in it.
struct Compiled {
  std::string content;
  CompiledFile file;
};

/// Empty, after a message, if the file would be too large. The file is read back, so that no file
/// is written that readers would refuse.
std::optional<Compiled> compile_source(const Source& source) {
  std::string content = write_compiled(compile(source.catalog), source.digest);
  if (content.empty()) {
    complain("cannot compile {}: the file would be larger than {} MiB", quote(source.catalog.file),
             largest_compiled_file >> 20);
    return std::nullopt;
  }
  CompiledFileResult result = read_compiled(content);
  if (!result.file) {
    throw std::logic_error("the compiled catalog is refused: " + result.error +
                           "; please report it with the catalog");
  }
  return Compiled{std::move(content), std::move(*result.file)};
}

int write(const std::string& output, const std::string& content) {
  if (output == "-" && isatty(STDOUT_FILENO) != 0) {
    return complain("a compiled catalog is not written to a terminal; expected a file or a pipe");
  }
  return write_output(output, content);
}

int compile_to_file(const CompileCommand& command) {
  const std::optional<Source> source = read_source(command.catalog);
  if (!source) return exit_unusable;
  const std::string output = output_of(command);
  if (!can_write_output(output)) return exit_unusable;
  const std::optional<Compiled> compiled = compile_source(*source);
  return compiled ? write(output, compiled->content) : exit_unusable;
}

int say_stale(const std::string& output, const std::string& reason) {
  fmt::print("{} is not up to date: {}\n", quote(output), reason);
  return exit_no;
}

/// Compares a file with the one that would be written now.
int check(const CompileCommand& command) {
  std::optional<Source> source = read_source(command.catalog);
  if (!source) return exit_unusable;
  const std::string name = source->catalog.file;
  const std::string output = output_of(command);
  std::error_code error;
  if (!fs::exists(output, error) && !error) return say_stale(output, "it does not exist");
  if (const auto refusal = find_refusal(output)) {
    return complain("cannot read {}: {}", quote(output), *refusal);
  }
  const MappedFile memory = map_file(output, largest_compiled_file);
  if (memory.memory == nullptr) {
    return complain("cannot read {}: {}", quote(output), memory.error);
  }
  const CompiledFileResult existing = read_compiled(memory.content);
  if (!existing.file) return say_stale(output, existing.error);
  if (existing.file->source != source->digest) {
    return say_stale(output, fmt::format("{} has changed since it was compiled", quote(name)));
  }
  if (existing.file->written_by != version) {
    return say_stale(output, fmt::format("it was written by cbc {}, and this is cbc {}",
                                         printable(existing.file->written_by), version));
  }
  // The catalog may have been compiled under another path.
  source->catalog.file = existing.file->catalog.file;
  const std::optional<Compiled> compiled = compile_source(*source);
  if (!compiled) return exit_unusable;
  if (compiled->content == memory.content) return exit_ok;
  return say_stale(output, "its bytes differ from what cbc compile would write");
}

/// The compiled form of a catalog, even if there is no file of it.
std::optional<CompiledFile> read_for_dump(const std::string& path) {
  FileSet files;
  const auto file = read_catalog(files, path);
  if (file == nullptr) return std::nullopt;
  if (file->is(FileKind::compiled)) return load_compiled(*file);
  const std::optional<Source> source = understand(files, *file);
  if (!source) return std::nullopt;
  std::optional<Compiled> compiled = compile_source(*source);
  if (!compiled) return std::nullopt;
  return std::move(compiled->file);
}

int dump(const CompileCommand& command) {
  const std::optional<CompiledFile> file = read_for_dump(command.catalog);
  if (!file) return exit_unusable;
  fmt::print("{}", catalog_json(*file));
  return exit_ok;
}

int run_compile(const CompileCommand& command) {
  if (command.dump) return dump(command);
  if (command.catalog == "-" && !command.output) {
    return usage_error("compile",
                       "a catalog from standard input needs the name of the output: -o OUT");
  }
  return command.check ? check(command) : compile_to_file(command);
}

}  // namespace

void add_compile_command(Program& program) {
  const auto options = std::make_shared<CompileCommand>();
  Command& command = program.add_command(
      "compile", "Compiles a catalog into a file that robots load in microseconds.",
      {{"[OPTION...] CATALOG", "--check [OPTION...] CATALOG", "--dump [OPTION...] CATALOG"},
       compile_examples,
       compile_footer});
  command
      .argument("CATALOG", options->catalog, input("", ValueKind::catalog),
                "The catalog: a YAML file, or - for standard input")
      .required();
  command.output_option(options->output)
      .without("CATALOG with the suffix .cbc")
      .not_with({"--dump"}, "it writes to standard output");
  command.flag("--check", options->check, "Write nothing; check that the file is up to date")
      .not_with({"--output -"}, "it checks a file");
  command
      .flag("--dump", options->dump,
            "Write nothing; print the contents of the catalog (YAML or compiled) as JSON (schema "
            "cbc.catalog/1)")
      .not_with({"--check"});
  command.add_confinement();
  command.action([options] { return run_compile(*options); });
}

}  // namespace cbc::cli

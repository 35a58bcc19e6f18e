#include "rename/report/rename_text.h"

#include <fmt/format.h>

#include "core/support/wording.h"
#include "runtime/base/text.h"

namespace cbc::cli {
namespace {

/// What ended a comparison. Nobody interrupts it but by ending the program, and no time is set.
std::string describe_end(const ReportedProof& proof) {
  switch (*proof.comparison.end) {
    case Budget::End::max_states:
      return fmt::format("ended by --max-states {}", proof.max_states);
    case Budget::End::max_memory:
      return "ended, as the memory of this machine is full";
    case Budget::End::too_many:
    case Budget::End::time_limit:
    case Budget::End::stopped:
      break;
  }
  return "ended, as there are more states than can be counted";
}

}  // namespace

std::string renamed_files_text(const Renaming& renaming, const std::vector<RenamedFile>& files,
                               bool is_done) {
  std::string text;
  std::size_t places = 0;
  for (const RenamedFile& file : files) {
    places += file.places;
    text += fmt::format("{}: {}\n", printable(file.name), quantity(file.places, "place"));
  }
  text += fmt::format("{} {} {} {} in {} of {}\n", name_of(renaming.kind), quote(renaming.old_name),
                      is_done ? "is now" : "would be", quote(renaming.new_name),
                      quantity(places, "place"), quantity(files.size(), "file"));
  return text;
}

std::string proof_text(const ReportedProof& proof, const Style& style) {
  const CatalogComparison& comparison = proof.comparison;
  const auto line = [&](std::string_view color, std::string_view words, const std::string& more) {
    return fmt::format("{}: {}{}\n", printable(proof.catalog), style.paint(color, words), more);
  };
  if (comparison.error) return line(style.warning, "not compared", ": " + *comparison.error);
  const std::string counts =
      fmt::format("{} of states, depth {}", quantity(comparison.states, "pair"), comparison.depth);
  if (comparison.result == Verdict::Result::proved) {
    return line(style.good, "every reachable event is decided as before", ": " + counts);
  }
  if (!comparison.end) {
    return line(style.warning, "nothing was compared", ": no start, stop or finish can happen");
  }
  return line(style.warning, "no difference was found",
              fmt::format("; the proof was {}, at {}", describe_end(proof), counts));
}

}  // namespace cbc::cli

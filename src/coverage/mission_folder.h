#pragma once

#include <string>
#include <vector>

namespace cbc::cli {

/// A folder of scripts that `cbc coverage` writes, and replaces when it is called again. Each says
/// so in a comment with a digest of the rest, so that none that anybody has changed is replaced.
class MissionFolder {
 public:
  struct File {
    std::string name;
    std::string text;
  };

  explicit MissionFolder(std::string path) : path_(std::move(path)) {}

  /// Looks at the files of the folder, if it exists. False if there is one that is not ours, or the
  /// folder cannot be made or written to; the reason is printed. Changes nothing.
  [[nodiscard]] bool open();
  /// Replaces all scripts by these; makes the folder if there are any. Returns the exit status.
  /// After an error, no script is new.
  [[nodiscard]] int replace(const std::vector<File>& files);

  /// Whether it had no scripts when it was opened.
  [[nodiscard]] bool was_empty() const { return names_.empty(); }
  [[nodiscard]] std::string path_of(const std::string& name) const;

 private:
  std::string path_;
  std::vector<std::string> names_;  ///< of our files
};

}  // namespace cbc::cli

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "page/serve/server.h"

namespace cbc::cli {

/// A file whose text a page edits, and others may edit, too. Each text that it has had, whoever
/// wrote it, is a version of its own; a page replaces the one that it knows, and no other.
class EditedFile {
 public:
  /// `text`: what is in the file.
  EditedFile(std::string path, std::string text) : path_(std::move(path)), text_(std::move(text)) {}

  /// Why a page cannot edit a text, or nothing.
  [[nodiscard]] static std::optional<std::string> find_obstacle(std::string_view text);

  /// As on the command line.
  [[nodiscard]] const std::string& path() const { return path_; }
  /// Reads the file again. If that is not possible any more, which is printed, the text is kept,
  /// and the lack of it is a version as well.
  void look();
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] std::uint64_t version() const { return version_; }

  /// Writes a text in place of a version. The answer has the new version; or, with status 409, the
  /// version and the text that are there instead (null: it cannot be read), and nothing was
  /// written; or what is wrong.
  [[nodiscard]] serve::Reply replace(std::uint64_t version, std::string_view text);

 private:
  const std::string path_;
  std::string text_;
  bool is_lost_ = false;
  std::uint64_t version_ = 1;
};

/// An answer that says what is wrong with a request.
[[nodiscard]] serve::Reply refusal(const char* status, std::string_view error);

}  // namespace cbc::cli

#include "play/edited_file.h"

#include <fmt/core.h>

#include "core/files/read.h"
#include "core/support/json.h"
#include "core/support/system.h"
#include "runtime/base/text.h"

namespace cbc::cli {
namespace {

/// Null if it is gone, or nothing that can be edited any more.
std::optional<std::string> read_text(const std::string& path) {
  if (is_special(path)) return cannot_read(path, "it is no regular file");
  std::optional<std::string> text = read_input(path);
  if (!text) return std::nullopt;
  if (const auto obstacle = EditedFile::find_obstacle(*text)) return cannot_read(path, *obstacle);
  return text;
}

}  // namespace

serve::Reply refusal(const char* status, std::string_view error) {
  std::string json;
  JsonWriter(json).write_object({{"error", error}});
  return {status, std::move(json)};
}

std::optional<std::string> EditedFile::find_obstacle(std::string_view text) {
  if (text.size() > serve::most_text) {
    return fmt::format("it has more than {} MiB, which is too much for a page",
                       serve::most_text >> 20U);
  }
  const std::optional<std::size_t> invalid = utf8::find_invalid(text);
  if (invalid)
    return fmt::format("expected UTF-8, found another encoding at byte {}", *invalid + 1);
  return std::nullopt;
}

void EditedFile::look() {
  std::optional<std::string> now = read_text(path_);
  const bool is_other = now ? is_lost_ || *now != text_ : !is_lost_;
  if (is_other) ++version_;
  is_lost_ = !now;
  if (now) text_ = std::move(*now);
}

serve::Reply EditedFile::replace(std::uint64_t version, std::string_view text) {
  if (const auto obstacle = find_obstacle(text)) {
    return refusal("422 Unprocessable Entity", *obstacle);
  }
  look();
  std::string json;
  JsonWriter answer(json);
  if (version != version_) {
    answer.open('{');
    answer.write("version", version_);
    answer.write("text", is_lost_ ? std::nullopt : std::optional(std::string_view(text_)));
    answer.close('}');
    return {"409 Conflict", std::move(json)};
  }
  if (const auto error = write_atomically(path_, text)) {
    return refusal("500 Internal Server Error", *error);
  }
  text_ = text;
  is_lost_ = false;
  ++version_;
  answer.write_object({{"version", version_}});
  return {"200 OK", std::move(json)};
}

}  // namespace cbc::cli

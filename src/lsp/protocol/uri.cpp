#include "lsp/protocol/uri.h"

#include <charconv>
#include <filesystem>

#include "core/support/wording.h"

namespace cbc::lsp {

std::optional<std::string> path_of_uri(std::string_view uri) {
  if (uri.starts_with("untitled:")) return std::string(uri);
  constexpr std::string_view scheme = "file://";
  if (!uri.starts_with(scheme)) return std::nullopt;
  uri.remove_prefix(scheme.size());
  constexpr std::string_view host = "localhost";
  if (uri.starts_with(host)) uri.remove_prefix(host.size());
  std::string path;
  for (std::size_t at = 0; at < uri.size(); ++at) {
    unsigned char byte = 0;
    if (uri[at] != '%') {
      path += uri[at];
    } else if (at + 2 < uri.size() &&
               std::from_chars(uri.data() + at + 1, uri.data() + at + 3, byte, 16).ptr ==
                   uri.data() + at + 3 &&
               byte != 0) {
      path += static_cast<char>(byte);
      at += 2;
    } else {
      return std::nullopt;
    }
  }
  if (!path.starts_with('/')) return std::nullopt;
  std::string normal = std::filesystem::path(path).lexically_normal().string();
  if (normal.size() > 1 && normal.back() == '/') normal.pop_back();  // of a folder
  return normal;
}

std::string uri_of_path(std::string_view path) { return "file://" + percent_encode(path); }

}  // namespace cbc::lsp

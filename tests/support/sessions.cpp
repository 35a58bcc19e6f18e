#include "support/sessions.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>

#include "support/lines.h"
#include "support/read_file.h"

namespace cbc::test {
namespace {

namespace fs = std::filesystem;

const fs::path source = CBC_SOURCE_DIR;

std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words;
  bool is_in_word = false;
  bool is_quoted = false;
  for (const char character : line) {
    const bool separates = !is_quoted && character == ' ';
    if (!separates && !is_in_word) words.emplace_back();
    is_in_word = !separates;
    if (character == '\'') {
      is_quoted = !is_quoted;
    } else if (!separates) {
      words.back() += character;
    }
  }
  return words;
}

/// Takes "MARK FILE" from the end of a command.
std::string take_redirection(std::vector<std::string>& words, std::string_view mark) {
  if (words.size() < 2 || words[words.size() - 2] != mark) return {};
  std::string file = words.back();
  words.resize(words.size() - 2);
  return file;
}

std::string unescape(std::string_view text) {
  std::string bytes;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] != '\\') {
      bytes += text[at];
      continue;
    }
    const char kind = text.at(++at);
    if (kind == 'x') {
      bytes += static_cast<char>(std::stoi(std::string(text.substr(at + 1, 2)), nullptr, 16));
      at += 2;
    } else {
      bytes += kind == 'n' ? '\n' : kind == 'r' ? '\r' : kind;
    }
  }
  return bytes;
}

class Reader {
 public:
  explicit Reader(const fs::path& path) : path_(path), lines_(lines_of(read_file(path))) {}

  std::vector<Case> read() {
    for (; at_ < lines_.size(); ++at_) read_line(lines_[at_]);
    end_block(true);
    for (Case& one : cases_) {
      one.session = path_;
      one.files.insert(one.files.begin(), shared_.begin(), shared_.end());
      if (one.commands.empty()) fail(one.name + " has no command");
    }
    return cases_;
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw std::runtime_error(fmt::format("{}:{}: {}", path_.string(), at_ + 1, reason));
  }

  void read_line(const std::string& line) {
    const std::string_view rest =
        std::string_view(line).substr(std::min<std::size_t>(2, line.size()));
    if (line.empty()) {
      ++empty_lines_;
    } else if (line.starts_with("## ")) {
      end_block(true);
      cases_.push_back({line.substr(3), {}, {}, {}});
    } else if (line.starts_with('#')) {
      end_block(true);
    } else if (line.starts_with("+ ")) {
      end_block(true);
      begin_file(rest);
    } else if (line.starts_with("= ")) {
      end_block(true);
      file_ = &texts_[std::string(rest)];
    } else if (line.starts_with("$ ")) {
      end_block(true);
      begin_command(rest);
    } else if (line.starts_with('[') && command_ != nullptr) {
      end_block(false);
      cases_.back().commands.back().status = std::stoi(line.substr(1));
      cases_.back().commands.back().end = at_ + 2;
    } else if (line.starts_with("  ")) {
      add(std::string(rest) + "\n", false);
    } else if (line.starts_with('!')) {
      add(std::string(rest) + "\n", true);
    } else if (line.starts_with("\\ ") || line.starts_with("\\!")) {
      add(unescape(rest), line[1] == '!');
    } else {
      fail("this is no line of a session");
    }
  }

  void begin_file(std::string_view line) {
    std::vector<CaseFile>& files = cases_.empty() ? shared_ : cases_.back().files;
    constexpr std::string_view mark = " = ";
    const std::size_t at = line.find(mark);
    file_ = &files.emplace_back(CaseFile{std::string(line.substr(0, at)), {}, false});
    if (at == std::string_view::npos) return;
    const auto text = texts_.find(std::string(line.substr(at + mark.size())));
    if (text == texts_.end()) fail("there is no such text above");
    file_->content = text->second.content;
    file_->is_in_session = true;
  }

  void begin_command(std::string_view line) {
    if (cases_.empty()) fail("a command needs the name of its case above");
    command_ = &cases_.back().commands.emplace_back();
    command_->line = at_ + 1;
    command_->end = at_ + 2;
    std::vector<std::string> words = words_of(line);
    command_->output = take_redirection(words, ">");
    command_->input = take_redirection(words, "<");
    if (words.empty() || words.front() != "cbc") fail("the command is not cbc");
    command_->arguments.assign(words.begin() + 1, words.end());
  }

  void add(const std::string& text, bool is_error) {
    if (command_ == nullptr && file_ == nullptr) fail("this belongs to no file and to no command");
    add_empty_lines(empty_lines_);
    if (file_ != nullptr) {
      file_->content += text;
      file_->is_in_session = true;
    } else {
      (is_error ? command_->err : command_->out) += text;
      command_->end = at_ + 2;
    }
  }

  void add_empty_lines(std::size_t count) {
    (file_ != nullptr ? file_->content : command_->out).append(count, '\n');
    empty_lines_ = 0;
  }

  /// One empty line before what comes next separates.
  void end_block(bool is_separated) {
    if (file_ != nullptr || command_ != nullptr) {
      const std::size_t separating = is_separated && empty_lines_ > 0 ? 1 : 0;
      if (command_ != nullptr) command_->end += empty_lines_ - separating;
      add_empty_lines(empty_lines_ - separating);
    }
    file_ = nullptr;
    command_ = nullptr;
    empty_lines_ = 0;
  }

  fs::path path_;
  std::vector<std::string> lines_;
  std::size_t at_ = 0;
  std::vector<CaseFile> shared_;           ///< by all cases
  std::map<std::string, CaseFile> texts_;  ///< by name; of files
  std::vector<Case> cases_;
  CaseFile* file_ = nullptr;        ///< that the next lines belong to
  CaseCommand* command_ = nullptr;  ///< the same
  std::size_t empty_lines_ = 0;     ///< before this one
};

bool is_plain(const std::string& line) {
  const auto is_control = [](unsigned char byte) {
    return (byte < 0x20 && byte != '\t') || byte == 0x7f;
  };
  return std::none_of(line.begin(), line.end(), is_control) && !line.ends_with(' ') &&
         !line.ends_with('\t');
}

std::string escape(const std::string& line) {
  std::string text;
  for (std::size_t at = 0; at < line.size(); ++at) {
    const auto byte = static_cast<unsigned char>(line[at]);
    const bool is_last_blank = byte <= ' ' && at + 1 == line.size();
    if (byte == '\\') {
      text += "\\\\";
    } else if (byte == '\r') {
      text += "\\r";
    } else if ((byte < ' ' && byte != '\t') || byte == 0x7f || is_last_blank) {
      text += fmt::format("\\x{:02x}", byte);
    } else {
      text += line[at];
    }
  }
  return text;
}

/// The lines of a session that stand for an output.
void add_lines(std::vector<std::string>& lines, const std::string& text, char mark) {
  const bool is_ended = text.empty() || text.ends_with('\n');
  const std::vector<std::string> contents = lines_of(text);
  for (const std::string& content : contents) {
    const bool has_end = is_ended || &content != &contents.back();
    if (!has_end || !is_plain(content)) {
      lines.push_back(std::string("\\") + mark + escape(content) + (has_end ? "\\n" : ""));
    } else if (content.empty()) {
      lines.emplace_back(mark == ' ' ? "" : "!");
    } else {
      lines.push_back(std::string(1, mark) + " " + content);
    }
  }
}

}  // namespace

std::vector<Case> read_session(const fs::path& path) { return Reader(path).read(); }

std::vector<Case> read_cases() {
  std::vector<fs::path> sessions;
  for (const auto& entry : fs::directory_iterator(source / "tests/golden/sessions")) {
    sessions.push_back(entry.path());
  }
  std::sort(sessions.begin(), sessions.end());
  std::vector<Case> cases;
  std::set<std::string> names;
  for (const fs::path& session : sessions) {
    for (Case& one : read_session(session)) {
      if (!names.insert(one.name).second)
        throw std::runtime_error(one.name + ": two cases have this name");
      cases.push_back(std::move(one));
    }
  }
  return cases;
}

void unpack(const Case& one, const fs::path& folder) {
  for (const CaseFile& file : one.files) {
    fs::path place = folder / file.path;
    if (place.filename().empty()) place = place.parent_path();  // of a folder
    fs::create_directories(place.parent_path());
    if (file.is_in_session) {
      std::ofstream(place, std::ios::binary) << file.content;
      continue;
    }
    const fs::path shared = source / "tests/golden/shared" / file.path;
    const fs::path original = fs::exists(shared) ? shared : source / file.path;
    fs::copy(original, place, fs::copy_options::recursive);
  }
}

void update_session(const Case& one) {
  std::vector<std::string> lines = lines_of(read_file(one.session));
  const std::vector<Case> written =
      read_session(one.session);  // other cases were updated meanwhile
  const auto old = std::find_if(written.begin(), written.end(),
                                [&](const Case& other) { return other.name == one.name; });
  for (std::size_t place = one.commands.size(); place-- > 0;) {
    const CaseCommand& command = one.commands[place];
    std::vector<std::string> news;
    add_lines(news, command.out, ' ');
    add_lines(news, command.err, '!');
    if (command.status != 0) news.push_back(fmt::format("[{}]", command.status));
    const auto begin = lines.begin() + static_cast<std::ptrdiff_t>(old->commands[place].line);
    const auto end = lines.begin() + static_cast<std::ptrdiff_t>(old->commands[place].end - 1);
    const bool is_separated = end != lines.end() && end->empty();
    if (!news.empty() && news.back().empty() && !is_separated) news.emplace_back();
    lines.insert(lines.erase(begin, end), news.begin(), news.end());
  }
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  if (text != read_file(one.session)) std::ofstream(one.session, std::ios::binary) << text;
}

}  // namespace cbc::test

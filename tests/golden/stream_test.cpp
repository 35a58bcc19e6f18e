// `cbc solve --format jsonl` as a part of a pipe, and what it recorded run again.
#include <array>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "golden/process.h"
#include "unit/scratch_folder.h"

namespace cbc::golden {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

class StreamTest : public testing::Test {
 protected:
  StreamTest() {
    fs::copy(fs::path(CBC_SOURCE_DIR) / "catalogs" / "quadrotor.yaml", folder_.path());
    fs::copy(fs::path(CBC_SOURCE_DIR) / "catalogs" / "quadrotor.mission.yaml", folder_.path());
  }

  [[nodiscard]] Call call(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "solve");
    return {std::move(arguments), folder_.path()};
  }
  [[nodiscard]] Call stream(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"quadrotor.yaml", "-", "--format", "jsonl"});
    return call(std::move(more));
  }
  [[nodiscard]] Result feed(std::string_view input, std::vector<std::string> more = {}) const {
    folder_.write("input", input);
    Call of_stream = stream(std::move(more));
    of_stream.standard_input = folder_ / "input";
    return run(of_stream);
  }
  void make_pipe(std::string_view name) const {
    ASSERT_EQ(::mkfifo((folder_ / name).c_str(), 0600), 0);
  }

  const test::ScratchFolder folder_;
};

void write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(descriptor, text.data(), text.size());
    ASSERT_GT(count, 0);
    text.remove_prefix(static_cast<std::size_t>(count));
  }
}

/// Events of which most are accepted.
std::string many_events(std::size_t count) {
  const std::array<std::string_view, 3> tasks{"HOVER", "ROTATE", "LAND"};
  std::string text;
  for (std::size_t place = 0; place < count; ++place) {
    text += R"({"start":")";
    text += tasks[place % tasks.size()];
    text += "\",\"wait\":0.1}\n";
  }
  return text;
}

TEST_F(StreamTest, WritesTheEventsOfTheJsonReportBehindAHeader) {
  const Result whole = run(call({"quadrotor.yaml", "quadrotor.mission.yaml", "--format", "json"}));
  const Result lines = run(call({"quadrotor.yaml", "quadrotor.mission.yaml", "--format", "jsonl"}));
  EXPECT_EQ(lines.status, 0);
  EXPECT_EQ(lines.err, "");
  const std::vector<std::string> found = lines_of(lines.out);
  const json header = json::parse(found.at(0));
  EXPECT_EQ(header["schema"], "cbc.events/1");
  EXPECT_EQ(header["catalog"], "quadrotor.yaml");
  const json events = json::parse(whole.out)["runs"][0]["events"];
  ASSERT_EQ(found.size(), events.size() + 1);
  for (std::size_t place = 0; place < events.size(); ++place) {
    EXPECT_EQ(json::parse(found[place + 1]), events[place]);
  }
}

TEST_F(StreamTest, BadLinesGetAnAnswerAndTheStreamGoesOn) {
  std::string input =
      "{\"start\":\"HOVER\"}\n"
      "no event\n"
      "\n"
      "{\"start\":\"NOWHERE\"}\n"
      "{\"start\":\n"
      "\xff\xfe\n"
      "[1, 2]\n";
  input += std::string("\0\0\n", 3);
  input += std::string(2 << 20, 'x') + "\n";
  input += std::string(100'000, '[') + "\n";
  input += "{stop: HOVER}";
  const Result result = feed(input);
  EXPECT_EQ(result.status, 2);
  std::vector<std::size_t> bad;
  std::vector<std::string> verbs;
  for (const std::string& line : lines_of(result.out)) {
    const json object = json::parse(line);
    if (object.contains("error")) bad.push_back(object["line"]);
    if (object.contains("verb")) verbs.push_back(object["verb"]);
  }
  EXPECT_EQ(bad, (std::vector<std::size_t>{2, 4, 5, 6, 7, 8, 9, 10}));
  EXPECT_EQ(verbs, (std::vector<std::string>{"start", "stop"}));
}

TEST_F(StreamTest, AnswersEachEventBeforeTheNextOneComes) {
  make_pipe("in");
  make_pipe("out");
  // Open for both, so that neither side has to wait for the other to open its end.
  const int in = ::open((folder_ / "in").c_str(), O_RDWR | O_CLOEXEC);
  const int out = ::open((folder_ / "out").c_str(), O_RDWR | O_CLOEXEC);
  Call of_stream = stream();
  of_stream.standard_input = folder_ / "in";
  of_stream.standard_output = folder_ / "out";
  const Result result = run(of_stream, [in, out](pid_t process) {
    const auto read_line = [out] {
      std::string line;
      for (char character = 0; ::read(out, &character, 1) == 1 && character != '\n';) {
        line += character;
      }
      return line;
    };
    EXPECT_EQ(json::parse(read_line())["schema"], "cbc.events/1");
    for (int index = 1; index <= 3; ++index) {
      const std::string event = "{\"wait\":1}\n";
      write_all(in, event.substr(0, 5));
      write_all(in, event.substr(5));
      EXPECT_EQ(json::parse(read_line())["index"], index);
    }
    ::kill(process, SIGTERM);
  });
  EXPECT_EQ(result.status, 0);
  ::close(in);
  ::close(out);
}

TEST_F(StreamTest, SignalsEndItWithTheStateSaved) {
  for (const int signal : {SIGINT, SIGTERM}) {
    fs::remove(folder_ / "in");
    make_pipe("in");
    const int in = ::open((folder_ / "in").c_str(), O_RDWR | O_CLOEXEC);
    Call of_stream = stream({"--state-out", "state.json"});
    of_stream.standard_input = folder_ / "in";
    of_stream.standard_output = folder_ / "log";
    folder_.write("log", "");
    fs::remove(folder_ / "state.json");
    const Result result = run(of_stream, [this, in, signal](pid_t process) {
      write_all(in, "{\"start\":\"HOVER\"}\n");
      while (lines_of(folder_.read("log")).size() < 2) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      ::kill(process, signal);
    });
    ::close(in);
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.err, "");
    const json state = json::parse(folder_.read("state.json"));
    EXPECT_EQ(state["events"], 1);
    EXPECT_EQ(state["running"][0]["task"], "HOVER");
  }
}

TEST_F(StreamTest, ReaderThatGoesAwayEndsIt) {
  folder_.write("input", many_events(1000));
  make_pipe("out");
  Call of_stream = stream();
  of_stream.standard_input = folder_ / "input";
  of_stream.standard_output = folder_ / "out";
  // The program waits for a reader on its way to open the pipe; this one reads nothing.
  std::thread reader([this] { ::close(::open((folder_ / "out").c_str(), O_RDONLY | O_CLOEXEC)); });
  const Result result = run(of_stream);
  reader.join();
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.err, "cbc: cannot write the output: Broken pipe\n");
}

TEST_F(StreamTest, MissionInPiecesIsTheWholeMission) {
  const std::string events = many_events(40);
  const std::vector<std::string> input = lines_of(events);
  const std::vector<std::string> whole = lines_of(feed(events).out);
  std::string first;
  std::string second;
  for (std::size_t place = 0; place < input.size(); ++place) {
    (place < 13 ? first : second) += input[place] + "\n";
  }
  std::vector<std::string> pieces = lines_of(feed(first, {"--state-out", "state.json"}).out);
  const Result rest = feed(second, {"--state-in", "state.json"});
  EXPECT_EQ(rest.status, 0) << rest.err;
  const std::vector<std::string> more = lines_of(rest.out);
  pieces.insert(pieces.end(), more.begin() + 1, more.end());
  EXPECT_EQ(pieces, whole);
}

TEST_F(StreamTest, StateOfAnotherCatalogIsRefused) {
  ASSERT_EQ(feed("{\"wait\":1}", {"--state-out", "state.json"}).status, 0);
  std::string text = folder_.read("quadrotor.yaml");
  folder_.write("quadrotor.yaml", text + "- mutually_exclusive: [HOVER, SELF_LOCALIZE]\n");
  const Result result = feed("{\"wait\":1}", {"--state-in", "state.json"});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_NE(result.err.find("it is the state of another catalog"), std::string::npos) << result.err;
}

TEST_F(StreamTest, ReplayGivesTheLogAgain) {
  const std::string log = feed(many_events(100) + "no event\n{\"start\":\"LAND\"}\n").out;
  folder_.write("log.jsonl", log);
  ASSERT_EQ(run({{"compile", "quadrotor.yaml", "-o", "other.cbc"}, folder_.path()}).status, 0);
  fs::create_directory(folder_ / "elsewhere");
  fs::copy(folder_ / "quadrotor.yaml", folder_ / "elsewhere/other.yaml");
  for (const char* catalog : {"quadrotor.yaml", "other.cbc", "elsewhere/other.yaml"}) {
    const Result result = run(call({"--replay", "log.jsonl", catalog}));
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.out, log);
  }
}

TEST_F(StreamTest, ReplayTellsTheFirstDifference) {
  const std::string log = feed(many_events(20)).out;
  std::string changed = log;
  const std::size_t place = changed.find("\"nodes\":", changed.find("\"index\":7,")) + 8;
  changed[place] = changed[place] == '9' ? '8' : '9';
  folder_.write("log.jsonl", changed);
  const Result result = run(call({"--replay", "log.jsonl", "quadrotor.yaml"}));
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(
      result.err.starts_with("cbc: log.jsonl:8: the first difference: they differ in 'search'\n"))
      << result.err;
  const std::vector<std::string> lines = lines_of(log);
  EXPECT_NE(result.err.find("  replay: " + lines[7] + "\n"), std::string::npos);

  folder_.write("log.jsonl", log + lines.back() + "\n");
  EXPECT_NE(run(call({"--replay", "log.jsonl", "quadrotor.yaml"})).status, 0);
}

TEST_F(StreamTest, ReplayRefusesWhatIsNoLogOfTheCatalog) {
  const std::string log = feed(many_events(3)).out;
  const auto replay = [this](const std::string& text) {
    folder_.write("log.jsonl", text);
    return run(call({"--replay", "log.jsonl", "quadrotor.yaml"}));
  };
  EXPECT_EQ(replay("").status, 2);
  EXPECT_EQ(replay("{}\n").status, 2);
  EXPECT_EQ(replay(log.substr(0, log.size() - 20)).status, 2);
  std::string other = log;
  other.replace(other.find("\"digest\":\"") + 10, 4, "0000");
  const Result result = replay(other);
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("it was made with another catalog"), std::string::npos) << result.err;
}

/// The peak of the memory of a process so far, in KiB.
std::size_t peak_memory(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) return std::stoul(line.substr(6));
  }
  return 0;
}

TEST_F(StreamTest, MemoryDoesNotGrowWithTheStream) {
  constexpr std::size_t count = 100'000;
  const std::string tenth = many_events(count / 10);
  make_pipe("in");
  const int in = ::open((folder_ / "in").c_str(), O_RDWR | O_CLOEXEC);
  Call of_stream = stream();
  of_stream.standard_input = folder_ / "in";
  of_stream.standard_output = folder_ / "log";
  folder_.write("log", "");
  std::size_t early = 0;
  std::size_t late = 0;
  const Result result = run(of_stream, [&](pid_t process) {
    // All but what is in the pipe has been answered when a write is done.
    write_all(in, tenth);
    early = peak_memory(process);
    for (int part = 1; part < 10; ++part) write_all(in, tenth);
    late = peak_memory(process);
    ::kill(process, SIGTERM);
  });
  ::close(in);
  EXPECT_EQ(result.status, 0);
  if (early == 0) GTEST_SKIP() << "no VmHWM in /proc here";
  EXPECT_LT(late, early + 512);
}

}  // namespace
}  // namespace cbc::golden

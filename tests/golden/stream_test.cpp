// `cbc solve --format jsonl` as a part of a pipe, and what it recorded run again.
#include <array>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <poll.h>
#include <string>
#include <string_view>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "golden/process.h"
#include "golden/stream_text.h"
#include "support/read_file.h"
#include "support/scratch_folder.h"

namespace cbc::golden::stream_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

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
  /// `more`: options and redirections.
  [[nodiscard]] int run_in_shell(const std::string& more) const {
    const std::string command =
        "cd '" + folder_.path() +
        "' && '" CBC_PROGRAM_PATH "' solve quadrotor.yaml - --format jsonl " + more;
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  void make_pipe(std::string_view name) const {
    ASSERT_EQ(::mkfifo((folder_ / name).c_str(), 0600), 0);
  }
  /// Makes a pipe, and opens both ends of it, so that no side has to wait for the other.
  [[nodiscard]] int open_pipe(std::string_view name) const {
    make_pipe(name);
    return ::open((folder_ / name).c_str(), O_RDWR | O_CLOEXEC);
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

/// What the system says about a process under a name; empty if it says nothing.
std::string status_of(pid_t process, std::string_view name) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(name)) return line.substr(name.size());
  }
  return {};
}

/// What can be read of a pipe, up to its end or until nothing more comes for a while.
std::string read_rest(int descriptor) {
  std::string text;
  std::array<char, 1 << 14> block{};
  pollfd waiting{descriptor, POLLIN, 0};
  while (::poll(&waiting, 1, text.empty() ? 30'000 : 1000) > 0) {  // a program may start slowly
    const ssize_t count = ::read(descriptor, block.data(), block.size());
    if (count <= 0) break;
    text.append(block.data(), static_cast<std::size_t>(count));
  }
  return text;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
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

/// The times are those of the machine, so only their order is known.
TEST_F(StreamTest, FollowsTheRealClockBetweenLines) {
  folder_.write("quadrotor.yaml",
                "behaviors:\n- {behavior: SCAN_AREA, task: SCAN, timeout: 0.3}\n"
                "- {behavior: STAND_BY, task: WAIT}\ntasks:\n- task: SCAN\n"
                "- {task: WAIT, reactive_start: true, execution_goal: keep_running,"
                " start_on_request: false}\n"
                "exclusivity_constraints:\n- mutually_exclusive: [SCAN, WAIT]\n");
  // The input stays open, and silent, for longer than everything takes to fall due.
  const std::string lines = "(sleep 0.3; echo '{start: SCAN}'; sleep 1; echo '{stop: WAIT}')";
  const std::string command = "cd '" + folder_.path() + "' && " + lines +
                              " | '" CBC_PROGRAM_PATH
                              "' solve quadrotor.yaml - --format jsonl --clock real >log";
  ASSERT_EQ(std::system(command.c_str()), 0);
  std::ifstream log(folder_ / "log");
  std::vector<json> found;
  for (std::string line; std::getline(log, line);) found.push_back(json::parse(line));
  ASSERT_EQ(found.size(), 6U);
  EXPECT_EQ(found[0]["clock"], "real");
  EXPECT_EQ(found[1]["time"], 0.08);  // before the first line
  EXPECT_EQ(found[1]["origin"], "reactive");
  const double start = found[2]["time"];
  EXPECT_EQ(found[2]["name"], "SCAN");
  EXPECT_GE(start, 0.2);
  EXPECT_EQ(found[3]["origin"], "timeout");
  EXPECT_NEAR(found[3]["time"], start + 0.3, 1e-6);
  EXPECT_EQ(found[4]["origin"], "reactive");
  EXPECT_NEAR(found[4]["time"], start + 0.38, 1e-6);
  EXPECT_GT(found[5]["time"], start + 0.38);
  const Result replayed = run(call({"--replay", "log", "quadrotor.yaml"}));
  EXPECT_EQ(replayed.status, 0) << replayed.err;
}

TEST_F(StreamTest, LogsAreScripts) {
  const std::string mission = "quadrotor.mission.yaml";
  const std::string catalog = "quadrotor.yaml";
  folder_.write("log.jsonl", run(call({catalog, mission, "--format", "jsonl"})).out);
  const json of_mission = json::parse(run(call({catalog, mission, "--format", "json"})).out);
  const Result result = run(call({catalog, "log.jsonl", "--format", "json"}));
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(json::parse(result.out)["runs"][0]["events"], of_mission["runs"][0]["events"]);
  const Result explained =
      run(call({catalog, "log.jsonl", "--why", "FOLLOW_PATH", "--html", "page.html"}));
  EXPECT_EQ(explained.status, 0) << explained.err;
  EXPECT_NE(explained.out.find("why FOLLOW_PATH"), std::string::npos);
  EXPECT_NE(folder_.read("page.html").find("why"), std::string::npos);

  EXPECT_EQ(run(call({"--replay", "log.jsonl", catalog, "--to-script", "again.yaml"})).status, 0);
  const Result again = run(call({catalog, "again.yaml", "--format", "jsonl"}));
  EXPECT_EQ(again.out, folder_.read("log.jsonl"));
}

TEST_F(StreamTest, ReplayDrawsWhatItsCatalogDecides) {
  const auto run_of_page = [this](const std::string& log, std::vector<std::string> more = {}) {
    folder_.write("log.jsonl", log);
    more.insert(more.begin(), {"--replay", "log.jsonl", "quadrotor.yaml", "--html", "page.html"});
    const Result result = run(call(std::move(more)));
    EXPECT_EQ(result.status, 0) << result.err << result.out;
    const json page = data_of_page(folder_.read("page.html"));
    return std::pair(page["report"]["runs"][0]["events"], page["runs"][0]["state"]);
  };
  const auto events_of = [](const std::string& log) {
    json all = json::array();
    for (const std::string& line : lines_of(log)) {
      if (json::parse(line).contains("index")) all.push_back(json::parse(line));
    }
    return all;
  };
  const std::string events = many_events(60);
  const std::string log = feed(events).out;
  const auto [drawn, begin] = run_of_page(log);
  EXPECT_EQ(drawn, events_of(log));
  EXPECT_EQ(begin["index"], 0);

  folder_.write("first", many_events(40));
  EXPECT_EQ(run_in_shell("--state-out state < first > out 2> err"), 0);
  const std::string second = feed(events, {"--state-in", "state"}).out;
  const auto [drawn_later, state] = run_of_page(second, {"--state-in", "state"});
  EXPECT_EQ(drawn_later, events_of(second));
  EXPECT_EQ(state["index"], json::parse(folder_.read("state"))["events"]);
}

/// It names its catalog, wherever it is written.
TEST_F(StreamTest, ScriptsOfLogsRunInOtherFolders) {
  folder_.write("log.jsonl", feed("{start: FOLLOW_PATH}\n").out);
  fs::create_directory(folder_ / "scripts");
  for (const std::string& file :
       {std::string("scripts/relative.yaml"), folder_ / "scripts/absolute.yaml"}) {
    const Result written =
        run(call({"--replay", "log.jsonl", "quadrotor.yaml", "--to-script", file}));
    EXPECT_EQ(written.status, 0) << written.err;
    const Result again = run(call({file}));
    EXPECT_EQ(again.status, 0) << again.err;
  }
}

TEST_F(StreamTest, ReplayWarnsOfItsCatalogOnce) {
  folder_.write("older.yaml", "behaviors: [{behavior: A, task: FOLLOW_PATH, efficacy: 50}]\n");
  folder_.write("input", "{start: FOLLOW_PATH}\n");
  Call logged = call({"older.yaml", "-", "--format", "jsonl"});
  logged.standard_input = folder_ / "input";
  const Result log = run(logged);
  EXPECT_NE(log.err, "");
  folder_.write("log.jsonl", log.out);
  const Result replayed =
      run(call({"--replay", "log.jsonl", "older.yaml", "--to-script", "script.yaml"}));
  EXPECT_EQ(replayed.status, 0);
  EXPECT_EQ(replayed.err, log.err);
}

/// A log with reasons is that of the same events without.
TEST_F(StreamTest, ReplayComparesDecisionsNotReasons) {
  const std::string lines = "{start: FOLLOW_PATH}\n{stop: FOLLOW_PATH, at: 5}\n";
  const std::vector<std::string> why = {"--why", "FOLLOW_PATH"};
  for (const bool is_logged : {false, true}) {
    folder_.write("log.jsonl", feed(lines, is_logged ? why : std::vector<std::string>()).out);
    const Result result = run(call({"--replay", "log.jsonl", "quadrotor.yaml"}));
    EXPECT_EQ(result.status, 0) << result.err;
  }
}

/// In a replay, what is due at the time of a line comes after it.
TEST_F(StreamTest, PutsLinesAfterWhatTheRealClockHasDone) {
  folder_.write("quadrotor.yaml",
                "behaviors:\n- {behavior: SCAN_AREA, task: SCAN}\n"
                "- {behavior: STAND_BY, task: WAIT}\ntasks:\n- task: SCAN\n"
                "- {task: WAIT, reactive_start: true, execution_goal: keep_running,"
                " start_on_request: false}\n"
                "exclusivity_constraints:\n- mutually_exclusive: [SCAN, WAIT]\n");
  const std::string lines =
      "(sleep 0.4; echo '{start: SCAN, at: 0.08}'; echo '{stop: SCAN, wait: 0}')";
  const std::string command = "cd '" + folder_.path() + "' && " + lines +
                              " | '" CBC_PROGRAM_PATH
                              "' solve quadrotor.yaml - --format jsonl --clock real >log";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::vector<std::string> found = lines_of(test::read_file(folder_ / "log"));
  ASSERT_GE(found.size(), 4U);  // WAIT may start again before the end of the input is seen
  EXPECT_EQ(json::parse(found[1])["time"], 0.08);
  EXPECT_EQ(json::parse(found[2])["time"], 0.080001);
  EXPECT_EQ(json::parse(found[3])["time"], 0.080001);
  const Result replayed = run(call({"--replay", "log", "quadrotor.yaml"}));
  EXPECT_EQ(replayed.status, 0) << replayed.err;
}

TEST_F(StreamTest, RefusesTimesThatTheRealClockHasNotReached) {
  folder_.write("quadrotor.yaml",
                "behaviors:\n- {behavior: SCAN_AREA, task: SCAN, timeout: 0.1}\n");
  const std::string lines =
      "(echo '{start: SCAN, at: 100}'; echo '{start: SCAN, wait: 200}'; echo '{start: SCAN}';"
      " sleep 0.5; echo '{start: SCAN}')";
  const std::string command = "cd '" + folder_.path() + "' && " + lines +
                              " | '" CBC_PROGRAM_PATH
                              "' solve quadrotor.yaml - --format jsonl --clock real >log";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 2);
  std::vector<json> found;
  for (const std::string& line : lines_of(test::read_file(folder_ / "log"))) {
    found.push_back(json::parse(line));
  }
  ASSERT_EQ(found.size(), 6U);
  for (const std::size_t place : {1U, 2U}) {
    EXPECT_EQ(found[place]["line"], place);
    const std::string error = found[place]["error"];
    EXPECT_NE(error.find("but the real clock is at"), std::string::npos) << error;
  }
  EXPECT_EQ(found[3]["name"], "SCAN");  // the clock has not moved on
  EXPECT_LT(found[3]["time"], 50);
  EXPECT_EQ(found[4]["origin"], "timeout");
  EXPECT_EQ(found[5]["name"], "SCAN");
}

TEST_F(StreamTest, AnswersEachEventBeforeTheNextOneComes) {
  const int in = open_pipe("in");
  const int out = open_pipe("out");
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
      for (const char character : std::string_view("{\"wait\":1}\n")) {
        write_all(in, std::string_view(&character, 1));
      }
      EXPECT_EQ(json::parse(read_line())["index"], index);
    }
    ::kill(process, SIGTERM);
  });
  EXPECT_EQ(result.status, 0);
  ::close(in);
  ::close(out);
}

TEST_F(StreamTest, AnswersAllCompleteLinesBeforeItWaits) {
  const int in = open_pipe("in");
  const int out = open_pipe("out");
  Call of_stream = stream();
  of_stream.standard_input = folder_ / "in";
  of_stream.standard_output = folder_ / "out";
  const Result result = run(of_stream, [in, out](pid_t process) {
    write_all(in, "{\"wait\":1}\n{\"wait\":2}\n{\"wait\":3}\n{\"wa");
    std::vector<std::string> lines = lines_of(read_rest(out));
    ASSERT_EQ(lines.size(), 4U) << "the header and three answers";
    write_all(in, "it\":4}\n");
    lines = lines_of(read_rest(out));
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(json::parse(lines.front())["time"], 10);
    ::kill(process, SIGTERM);
  });
  EXPECT_EQ(result.status, 0);
  ::close(in);
  ::close(out);
}

TEST_F(StreamTest, MessagesStandAmongTheAnswers) {
  folder_.write("input",
                "{\"wait\":1}\n"
                "{\"start\":\"ROTATE\",\"parameters\":{\"unknown\":1}}\n"
                "{\"expect\":{\"outcome\":\"rejected\"}}\n"
                "{\"wait\":1}\n");
  EXPECT_EQ(run_in_shell("< input > all 2>&1"), 1);
  std::vector<bool> are_messages;
  for (const std::string& line : lines_of(folder_.read("all"))) {
    are_messages.push_back(line.starts_with("cbc: "));
  }
  EXPECT_EQ(are_messages, (std::vector<bool>{false, false, true, false, true, false}));
}

TEST_F(StreamTest, TotalsComeLast) {
  const std::string events =
      "{\"start\":\"HOVER\"}\nno event\n{\"stop\":\"HOVER\"}\n{\"wait\":1}\n";
  const Result result = feed(events, {"--stats"});
  EXPECT_EQ(result.status, 2);
  std::vector<std::string> lines = lines_of(result.out);
  const json last = json::parse(lines.back());
  EXPECT_EQ(last["totals"]["events"], 2);
  EXPECT_GT(last["process"]["peak_memory_bytes"], 0);
  lines.pop_back();
  std::uint64_t nodes = 0;
  for (std::string& line : lines) {
    json object = json::parse(line);
    if (!object.contains("search") || object["search"].is_null()) continue;
    nodes += object["search"]["nodes"].get<std::uint64_t>();
    EXPECT_GE(object["search"]["elapsed_us"], 0);
    // Without what --stats adds it is the line without --stats.
    const std::size_t begin = line.find(",\"propagations\"");
    line.erase(begin, line.find('}', begin) - begin);
  }
  EXPECT_EQ(last["totals"]["nodes"]["sum"], nodes);
  EXPECT_EQ(joined(lines), feed(events).out);
}

TEST_F(StreamTest, SignalsEndItWithTheStateSaved) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    fs::remove(folder_ / "in");
    const int in = open_pipe("in");
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

/// Two tasks that take turns for ever, at 1.08 seconds each.
constexpr std::string_view restless = R"(tasks:
- {task: H, reactive_start: true, timeout: 1, execution_goal: achieve_goal}
- {task: G, reactive_start: true, timeout: 1, execution_goal: achieve_goal}
behaviors:
- {behavior: h, task: H}
- {behavior: g, task: G}
exclusivity_constraints:
- mutually_exclusive: [G, H]
)";

TEST_F(StreamTest, SignalsEndALongRunOfTheClockWithTheStateSaved) {
  folder_.write("restless.yaml", restless);
  folder_.write("script.yaml", "[{start: H}, {wait: 1000000000}]\n");
  // A script, and a stream that nobody closes.
  for (const std::string script : {"script.yaml", "-"}) {
    fs::remove(folder_ / "in");
    const int in = open_pipe("in");
    Call of_stream = call({"restless.yaml", script, "--format", "jsonl", "--max-clock-events",
                           "1000000000000", "--state-out", "state.json"});
    of_stream.standard_input = folder_ / "in";
    of_stream.standard_output = folder_ / "log";
    folder_.write("log", "");
    fs::remove(folder_ / "state.json");
    const Result result = run(of_stream, [this, in](pid_t process) {
      write_all(in, "{\"start\":\"H\"}\n{\"wait\":1000000000}\n");
      while (fs::file_size(folder_ / "log") < 100'000) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      ::kill(process, SIGTERM);
    });
    ::close(in);
    EXPECT_EQ(result.status, 0) << script;
    EXPECT_NE(result.err.find("cbc: stopped by a signal, before the event that the clock moved "
                              "on to\n"),
              std::string::npos)
        << result.err;
    const std::vector<std::string> log = lines_of(folder_.read("log"));
    const json last = json::parse(log.back());
    const json state = json::parse(folder_.read("state.json"));
    EXPECT_EQ(state["events"], last["index"]);
    EXPECT_EQ(state["events"], log.size() - 1);

    const Result replay =
        run(call({"restless.yaml", "--replay", "log", "--max-clock-events", "1000000000000"}));
    EXPECT_EQ(replay.status, 0) << replay.out << replay.err;
  }
}

TEST_F(StreamTest, TooManyClockEventsEndItWithTheStateSaved) {
  folder_.write("restless.yaml", restless);
  folder_.write("input", "{\"start\":\"H\"}\n{\"wait\":1000}\n");
  Call of_stream = call({"restless.yaml", "-", "--format", "jsonl", "--max-clock-events", "5",
                         "--state-out", "state.json"});
  of_stream.standard_input = folder_ / "input";
  const Result result = run(of_stream);
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.err, "cbc: the clock made more than 5 events (--max-clock-events)\n");
  const std::vector<std::string> log = lines_of(result.out);
  const json state = json::parse(folder_.read("state.json"));
  EXPECT_EQ(state["events"], log.size() - 1);
  EXPECT_EQ(state["events"], 6);

  // The stream goes on where it was.
  folder_.write("input", "{\"wait\":2}\n");
  Call next = call({"restless.yaml", "-", "--format", "jsonl", "--state-in", "state.json"});
  next.standard_input = folder_ / "input";
  const std::vector<std::string> rest = lines_of(run(next).out);
  EXPECT_EQ(json::parse(rest.at(1))["index"], 7);
  EXPECT_EQ(json::parse(rest.at(1))["origin"], "reactive");

  folder_.write("log", result.out);
  const Result replay = run(call({"restless.yaml", "--replay", "log", "--max-clock-events", "5"}));
  EXPECT_EQ(replay.status, 0) << replay.out << replay.err;
}

bool has_ended(pid_t process) { return !fs::exists("/proc/" + std::to_string(process) + "/fd/0"); }

/// Whether a process waits for something.
bool is_waiting(pid_t process) {
  return status_of(process, "State:").find('S') != std::string::npos;
}

/// Whether the first signal that was sent to a process has reached it.
bool has_received(pid_t process, int signal) {
  const std::string pending = status_of(process, "ShdPnd:");
  return pending.empty() || (std::stoull(pending, nullptr, 16) >> (signal - 1) & 1) == 0;
}

/// A stream whose output nobody reads: it cannot go on.
class BlockedStreamTest : public StreamTest {
 protected:
  /// `meanwhile` gets the process, and the end of the output to read from.
  template <typename Meanwhile>
  Result run_blocked(const Meanwhile& meanwhile) {
    folder_.write("input", many_events(1000));
    const int out = open_pipe("out");
    Call of_stream = stream({"--state-out", "state.json"});
    of_stream.standard_input = folder_ / "input";
    of_stream.standard_output = folder_ / "out";
    Result result = run(of_stream, [&](pid_t process) {
      // The input never keeps it waiting.
      pollfd room{out, POLLOUT, 0};
      while (::poll(&room, 1, 0) > 0 || !is_waiting(process)) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      meanwhile(process, out);
    });
    ::close(out);
    return result;
  }
};

TEST_F(BlockedStreamTest, SignalThatComesTwiceAtOnceEndsItWithTheStateSaved) {
  std::string text;
  const Result result = run_blocked([&text](pid_t process, int out) {
    ::kill(process, SIGTERM);
    while (!has_received(process, SIGTERM) && !has_ended(process)) std::this_thread::yield();
    ::kill(process, SIGTERM);
    ::kill(process, SIGINT);
    text = read_rest(out);
  });
  EXPECT_EQ(result.status, 0);
  const json state = json::parse(folder_.read("state.json"));
  const json last = json::parse(lines_of(text).back());
  EXPECT_EQ(state["events"], last["index"]);
  EXPECT_LT(last["index"], 1000);
}

TEST_F(BlockedStreamTest, SignalsThatGoOnEndItAtLast) {
  const Result result = run_blocked([](pid_t process, int /*out*/) {
    while (!has_ended(process)) {
      ::kill(process, SIGTERM);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  });
  EXPECT_EQ(result.status, 128 + SIGTERM);
  EXPECT_FALSE(fs::exists(folder_ / "state.json"));
}

TEST_F(StreamTest, OutputThatMustNotBlockGetsAllOfIt) {
  const std::string events = many_events(1000);
  const std::string whole = feed(events).out;
  const int out = open_pipe("out");
  Call of_stream = stream();
  of_stream.standard_input = folder_ / "input";
  of_stream.standard_output = folder_ / "out";
  of_stream.standard_output_flags = O_NONBLOCK;
  std::string text;
  const Result result = run(of_stream, [&text, out](pid_t /*process*/) { text = read_rest(out); });
  ::close(out);
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(text, whole);
}

TEST_F(StreamTest, MessagesThatCannotBeWrittenDoNotEndIt) {
  folder_.write("input",
                "{\"start\":\"ROTATE\",\"parameters\":{\"unknown\":1}}\n"
                "{\"expect\":{\"outcome\":\"rejected\"}}\n"
                "{\"stop\":\"ROTATE\"}\n");
  for (const std::string to : {"2>&-", "2>/dev/full"}) {
    fs::remove(folder_ / "state.json");
    EXPECT_EQ(run_in_shell("--state-out state.json < input > log " + to), 1)
        << "the expectation fails";
    EXPECT_EQ(lines_of(folder_.read("log")).size(), 3U) << to;
    EXPECT_EQ(json::parse(folder_.read("state.json"))["events"], 2);
  }
}

TEST_F(StreamTest, ClosedInputOrOutputIsAnError) {
  folder_.write("input", many_events(3));
  EXPECT_EQ(run_in_shell("<&- > log 2> messages"), 2);
  EXPECT_EQ(lines_of(folder_.read("log")).size(), 1U) << "the header";
  EXPECT_EQ(folder_.read("messages"), "cbc: cannot read standard input: Bad file descriptor\n");
  // No other file takes the place of the output.
  EXPECT_EQ(run_in_shell("--state-out state.json < input >&- 2> messages"), 2);
  EXPECT_EQ(folder_.read("messages"), "cbc: cannot write the output: Bad file descriptor\n");
  EXPECT_TRUE(json::accept(folder_.read("state.json")));
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

TEST_F(StreamTest, NewStateReplacesTheOneThatWasRead) {
  ASSERT_EQ(feed(many_events(2), {"--state-out", "state.json"}).status, 0);
  const Result more = feed("", {"--state-in", "state.json", "--state-out", "state.json"});
  EXPECT_EQ(more.status, 0) << more.err;
  EXPECT_EQ(json::parse(folder_.read("state.json"))["events"], 2);
}

TEST_F(StreamTest, ExpectationsAndWarningsKnowWhatWasBeforeTheCut) {
  ASSERT_EQ(feed("{\"start\":\"HOVER\"}\n"
                 "{\"situation\":{\"SELF_LOCALIZE_WITH_GROUND_TRUTH\":false}}\n",
                 {"--state-out", "state.json"})
                .status,
            0);
  const std::string events =
      "[{expect: {outcome: accepted}},"
      " {finish: SELF_LOCALIZE_WITH_GROUND_TRUTH, cause: situation_change}]";
  const Result lines = feed(
      "{expect: {outcome: accepted}}\n"
      "{finish: SELF_LOCALIZE_WITH_GROUND_TRUTH, cause: situation_change}\n",
      {"--state-in", "state.json"});
  folder_.write("script.yaml", events);
  const Result script =
      run(call({"quadrotor.yaml", "script.yaml", "--format", "jsonl", "--state-in", "state.json"}));
  for (const Result& result : {lines, script}) {
    EXPECT_EQ(result.status, 0);
    EXPECT_EQ(result.err, "");
  }
  EXPECT_EQ(lines.out, script.out);
}

TEST_F(StreamTest, StateThatCannotBeSavedIsToldBeforeTheFirstEvent) {
  for (const char* place : {"missing/state.json", "elsewhere", "-"}) {
    fs::create_directories(folder_ / "elsewhere");
    const Result result = feed("{\"wait\":1}\n", {"--state-out", place});
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_NE(result.err, "");
  }
  EXPECT_FALSE(fs::exists(folder_ / "-"));
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

/// What starts reactively starts after the delay, so nothing is due later than that.
TEST_F(StreamTest, StateWithAnImpossibleTimeInTheQueueIsRefused) {
  folder_.write("restless.yaml", restless);
  folder_.write("input", "{\"wait\":0.05}\n");
  const auto go_on = [this](std::vector<std::string> more) {
    more.insert(more.begin(), {"restless.yaml", "-", "--format", "jsonl"});
    Call of_stream = call(std::move(more));
    of_stream.standard_input = folder_ / "input";
    return run(of_stream);
  };
  ASSERT_EQ(go_on({"--state-out", "state.json"}).status, 0);
  json state = json::parse(folder_.read("state.json"));
  ASSERT_EQ(state["time_us"], 50'000);
  ASSERT_EQ(state["reactive_delay_us"], 80'000);
  const auto status_with = [&](std::int64_t due) {
    state["queue"]["H"] = due;
    folder_.write("changed.json", state.dump());
    const Result result = go_on({"--state-in", "changed.json"});
    const bool is_told = result.err.find("for an impossible time") != std::string::npos;
    EXPECT_EQ(is_told, result.status == 2) << result.err;
    return result.status;
  };
  EXPECT_EQ(status_with(50'000), 0);
  EXPECT_EQ(status_with(130'000), 0);
  EXPECT_EQ(status_with(130'001), 2);
  EXPECT_EQ(status_with(49'999), 2);
}

TEST_F(StreamTest, ReplayFindsALogAlike) {
  const std::string log = feed(many_events(100) + "no event\n{\"start\":\"LAND\"}\n").out;
  folder_.write("log.jsonl", log);
  ASSERT_EQ(run({{"compile", "quadrotor.yaml", "-o", "other.cbc"}, folder_.path()}).status, 0);
  for (const char* catalog : {"quadrotor.yaml", "other.cbc"}) {
    const Result result = run(call({"--replay", "log.jsonl", catalog}));
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_NE(result.out.find("all was decided alike"), std::string::npos) << result.out;
  }
  folder_.write("log.jsonl", "\xEF\xBB\xBF" + log);
  EXPECT_EQ(run(call({"--replay", "log.jsonl", "quadrotor.yaml"})).status, 0);
}

TEST_F(StreamTest, ReplayAndContinuedStreamHaveNoTimeoutsIfTheScriptHasNone) {
  const auto script = [this](const std::string& name, std::vector<std::string> more,
                             const std::string& text) {
    folder_.write(name, text);
    more.insert(more.begin(), {"dock.yaml", name, "--format", "jsonl"});
    return run(call(std::move(more)));
  };
  folder_.write("dock.yaml",
                "behaviors: [{behavior: BLIND, task: DOCK, timeout: 10}]\n"
                "tasks: [{task: DOCK}]\n");
  const Result first = script("first.yaml", {"--state-out", "state.json"},
                              "{timeouts: false, events: [{start: DOCK}, {at: 50}]}");
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_EQ(json::parse(lines_of(first.out).at(0))["timeouts"], false);
  const json state = json::parse(folder_.read("state.json"));
  EXPECT_EQ(state["timeouts"], false);
  EXPECT_EQ(state["running"][0]["waits_for_timeout"], false);

  const std::string again = "[{at: 100, expect: {running: {DOCK: any}}}, {start: DOCK, at: 101}]";
  const Result second = script("second.yaml", {"--state-in", "state.json"}, again);
  EXPECT_EQ(second.status, 0) << second.err;
  EXPECT_EQ(lines_of(second.out).size(), 2U);
  folder_.write("log.jsonl", second.out);
  const Result replay =
      run(call({"--replay", "log.jsonl", "dock.yaml", "--state-in", "state.json"}));
  EXPECT_EQ(replay.status, 0) << replay.out << replay.err;
  const Result refused = run(call({"--replay", "log.jsonl", "dock.yaml"}));
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("it continues from another state"), std::string::npos) << refused.err;

  folder_.write("log.jsonl", first.out);
  const Result whole = run(call({"--replay", "log.jsonl", "dock.yaml"}));
  EXPECT_EQ(whole.status, 0) << whole.out << whole.err;

  // The state decides, not the script.
  const Result on = script("third.yaml", {"--state-out", "state.json"}, "[{start: DOCK}]");
  ASSERT_EQ(on.status, 0) << on.err;
  const Result end =
      script("end.yaml", {"--state-in", "state.json"}, "{timeouts: false, events: [{at: 50}]}");
  EXPECT_EQ(json::parse(lines_of(end.out).at(1))["origin"], "timeout") << end.out;
}

TEST_F(StreamTest, ReplayRepeatsTimesThatNoDoubleHas) {
  const std::string log = feed("{\"start\":\"HOVER\",\"at\":0.000649}\n").out;
  EXPECT_NE(log.find("\"time\":0.000649,"), std::string::npos) << log;
  folder_.write("log.jsonl", log);
  EXPECT_EQ(run(call({"--replay", "log.jsonl", "quadrotor.yaml"})).status, 0);
}

TEST_F(StreamTest, ReplayGoesAsFarAsAnExpectationMovedTheClock) {
  const std::string events =
      "{\"start\":\"TAKE_OFF\"}\n"
      "{\"expect\":{\"stopped\":[\"TAKE_OFF\"]},\"at\":1000}\n"
      "no event\n";
  const std::string log = feed(events).out;
  EXPECT_NE(log.find("\"origin\":\"timeout\""), std::string::npos) << log;
  folder_.write("log.jsonl", log);
  const Result result = run(call({"--replay", "log.jsonl", "quadrotor.yaml"}));
  EXPECT_EQ(result.status, 0) << result.out << result.err;
}

TEST_F(StreamTest, ReplayRefusesALogWithTimes) {
  for (const char* events : {"{\"start\":\"HOVER\"}\n", "no event\n"}) {
    folder_.write("log.jsonl", feed(events, {"--stats"}).out);
    const Result result = run(call({"--replay", "log.jsonl", "quadrotor.yaml"}));
    EXPECT_EQ(result.status, 2);
    EXPECT_NE(result.err.find("it was made with --stats"), std::string::npos) << result.err;
  }
}

TEST_F(StreamTest, ReplayRefusesWhatIsNoLog) {
  const std::string log = feed(many_events(3)).out;
  for (const std::string& text :
       {std::string(), std::string("{}\n"), log.substr(0, log.size() - 20)}) {
    folder_.write("log.jsonl", text);
    EXPECT_EQ(run(call({"--replay", "log.jsonl", "quadrotor.yaml"})).status, 2);
  }
}

TEST_F(StreamTest, LogsOfAnotherCatalogAreNoScripts) {
  std::string log = feed(many_events(3)).out;
  log.replace(log.find(R"("digest":")") + 10, 4, "0000");
  folder_.write("log.jsonl", log);
  const Result result = run(call({"quadrotor.yaml", "log.jsonl"}));
  EXPECT_EQ(result.status, 2);
  EXPECT_NE(result.err.find("it was made with another catalog"), std::string::npos) << result.err;
}

/// A sanitizer would keep much of what is given back.
constexpr std::pair gives_back{"ASAN_OPTIONS", "quarantine_size_mb=1"};

/// The peak of the memory of a process so far, in KiB.
std::size_t peak_memory(pid_t process) {
  const std::string peak = status_of(process, "VmHWM:");
  return peak.empty() ? 0 : std::stoul(peak);
}

TEST_F(StreamTest, MemoryDoesNotGrowWithTheStream) {
  constexpr std::size_t count = 100'000;
  const std::string tenth = many_events(count / 10);
  const int in = open_pipe("in");
  Call of_stream = stream();
  of_stream.environment.insert(gives_back);
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

TEST_F(StreamTest, LongLinesLeaveNothingBehind) {
  constexpr std::size_t count = 100;
  const int in = open_pipe("in");
  Call of_stream = stream();
  of_stream.environment.insert(gives_back);
  of_stream.standard_input = folder_ / "in";
  of_stream.standard_output = "/dev/null";
  std::size_t early = 0;
  std::size_t late = 0;
  const Result result = run(of_stream, [&](pid_t process) {
    for (std::size_t place = 0; place < count; ++place) {
      // Each has its long text in another place.
      std::string line = "{\"unknown\":[";
      for (std::size_t item = 0; item < place; ++item) line += "\"\",";
      write_all(in, line + "\"" + std::string(500'000, 'x') + "\"]}\n");
      if (place == count / 10) early = peak_memory(process);
    }
    late = peak_memory(process);
    ::kill(process, SIGTERM);
  });
  ::close(in);
  EXPECT_EQ(result.status, 2);
  if (early == 0) GTEST_SKIP() << "no VmHWM in /proc here";
  EXPECT_LT(late, early + 4096);
}

}  // namespace
}  // namespace cbc::golden::stream_test

// A session against the run of the mission that it writes, which is read and run as 'cbc solve'
// does.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/report/event_json.h"
#include "core/script/reader.h"
#include "core/script/runner.h"
#include "core/yaml/document.h"
#include "support/catalog_files.h"
#include "support/read_file.h"
#include "wasm/session.h"

namespace cbc::play::play_session_test {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

const fs::path catalogs = fs::path(CBC_SOURCE_DIR) / "catalogs";

/// A session with what a page would show of it.
class Page {
 public:
  explicit Page(const std::string& text) {
    const Json opened = ask({{"do", "open"}, {"catalog", text}});
    EXPECT_FALSE(opened.contains("error")) << opened;
    catalog = opened["catalog"];
    yaml_ = text;
  }

  Json ask(const Json& request) {
    Json answer = Json::parse(session_.answer(request.dump()));
    if (answer.contains("events")) {
      const auto first = answer["first"].get<std::size_t>();
      EXPECT_LE(first, events.size() + 1);
      events.resize(first - 1);
      for (const Json& event : answer["events"]) events.push_back(event);
      EXPECT_EQ(answer["index"], events.size());
    } else if (request.is_object() && request["do"] == "goto" && !answer.contains("error")) {
      EXPECT_LE(request["index"], answer["index"]);
      EXPECT_LE(answer["index"], events.size());
      events.resize(answer["index"].get<std::size_t>());
    }
    return answer;
  }
  Json apply(const std::string& event) { return ask({{"do", "apply"}, {"event", event}}); }
  Json state() { return ask({{"do", "state"}}); }

  struct Run {
    std::vector<Json> events;
    std::uint64_t passed = 0;
    std::uint64_t failed = 0;
  };
  /// Runs the mission that the session writes. `why`: the task or behavior to be explained.
  Run run(const std::string& why = "") {
    const std::string mission = ask({{"do", "mission"}})["mission"];
    Diagnostics diagnostics;
    const auto document = yaml::parse(yaml_, "catalog.yaml", diagnostics);
    const auto compiled = lint_catalog(*document, {}, diagnostics).compiled;
    Diagnostics of_mission;
    const auto parsed = yaml::parse(mission, "mission.yaml", of_mission);
    const auto script = read_script(*parsed, *compiled, Severity::warning, of_mission);
    EXPECT_TRUE(script) << mission;
    Run run;
    Questions questions{.rejections = true, .displaced = true};
    EventAdditions adds{!why.empty(), false, true};
    if (const auto task = compiled->find_task(why)) questions.why = {{true, *task}};
    EventStream stream(
        *compiled, adds,
        [&](const EventStream::Line& line) { run.events.push_back(Json::parse(line.text)); },
        [&](const Failure& failure) { ADD_FAILURE() << failure.message << '\n'
                                                    << mission; });
    const RunResult result = run_script(*compiled, *script, {}, stream, questions);
    run.passed = result.passed;
    run.failed = result.failed;
    return run;
  }

  Json catalog;
  std::vector<Json> events;

 private:
  Session session_;
  std::string yaml_;
};

class Choices {
 public:
  explicit Choices(unsigned seed) : random_(seed) {}
  std::size_t below(std::size_t bound) { return random_() % bound; }
  const Json& of(const Json& list) { return list[below(list.size())]; }

 private:
  std::mt19937 random_;
};

/// Something that a person may do.
Json random_request(Page& page, Choices& choices) {
  const std::string task = choices.of(page.catalog["tasks"]);
  const std::string behavior = choices.of(page.catalog["behaviors"])["name"];
  const auto apply = [](const char* verb, const Json& subject, Json event = Json::object()) {
    event[verb] = subject;
    return Json{{"do", "apply"}, {"event", event.dump()}};
  };
  switch (choices.below(12)) {
    case 0:
      return apply("stop", task);
    case 1:
      return apply("finish", behavior);
    case 2:
      return apply("fault", behavior);
    case 3:
      return apply("repair", behavior);
    case 4:
      return {{"do", "advance"}};
    case 5:
      return {{"do", "advance"},
              {"to", page.state()["report"]["time"].get<double>() +
                         0.05 * static_cast<double>(choices.below(50))}};
    case 6:
      return {{"do", "goto"}, {"index", choices.below(page.events.size() + 1)}};
    case 7: {
      Json situation;
      if (page.catalog["variables"].empty()) {
        situation[behavior] = choices.below(2) == 0;
      } else {
        const Json& variable = choices.of(page.catalog["variables"]);
        situation[variable["variable"].get<std::string>()] = choices.of(variable["values"]);
      }
      return apply("situation", situation);
    }
    default: {
      Json priority;
      priority["priority"] = 1 + choices.below(3);
      return apply("start", task, priority);
    }
  }
}

TEST(PlaySession, WritesAMissionThatDoesTheSame) {
  std::size_t events = 0;
  std::size_t gone_back = 0;
  for (const fs::path& path : test::catalog_files(catalogs)) {
    SCOPED_TRACE(path.string());
    for (unsigned seed = 0; seed < 10; ++seed) {
      SCOPED_TRACE(seed);
      Page page(test::read_file(path));
      Choices choices(seed);
      std::uint64_t done = 0;
      for (int step = 0; step < 60; ++step) {
        const Json request = random_request(page, choices);
        const Json answer = page.ask(request);
        if (answer.contains("error")) continue;
        if (request["do"] == "goto") ++gone_back;
        ++done;
      }
      EXPECT_GT(done, 20U);
      const Page::Run run = page.run();
      EXPECT_EQ(run.events, page.events);
      EXPECT_GT(run.passed, 0U);
      events += run.events.size();
    }
  }
  EXPECT_GT(events, 500U);
  EXPECT_GT(gone_back, 50U);
}

TEST(PlaySession, SaysWhatAnEventWouldDo) {
  Page page(test::read_file(catalogs / "hospital.yaml"));
  Choices choices(7);
  std::size_t accepted = 0;
  for (int step = 0; step < 80; ++step) {
    const Json request = random_request(page, choices);
    if (request["do"] == "apply") {
      const Json before = page.state();
      const Json asked = page.ask({{"do", "what_if"}, {"event", request["event"]}});
      EXPECT_EQ(page.state(), before);
      if (!asked.contains("error")) {
        const Json move = asked["report"]["moves"][0];
        const std::size_t count = page.events.size();
        page.ask(request);
        // What falls due before the event is no part of it.
        const Json& event = page.events.at(count);
        EXPECT_EQ(event["outcome"], move["outcome"]);
        EXPECT_EQ(event["conflict"], move["conflict"]);
        const Json running = page.state()["report"]["running"];
        for (const auto& [task, behavior] : move["started"].items()) {
          EXPECT_EQ(running.value(task, Json()), behavior);
        }
        for (const Json& task : move["stopped"]) EXPECT_FALSE(running.contains(task));
        if (event["outcome"] == "accepted") ++accepted;
        continue;
      }
    }
    page.ask(request);
  }
  EXPECT_GT(accepted, 10U);
}

TEST(PlaySession, ExplainsAsSolveDoes) {
  Page page(test::read_file(catalogs / "quadrotor.yaml"));
  Choices choices(3);
  for (int step = 0; step < 40; ++step) page.ask(random_request(page, choices));
  std::size_t explained = 0;
  for (const Json& task : page.catalog["tasks"]) {
    const std::vector<Json> events = page.run(task).events;
    for (std::size_t index = 0; index <= events.size(); ++index) {
      const Json why = page.ask({{"do", "why"}, {"task", task}, {"index", index}}).at("event");
      if (why.is_null()) continue;
      ASSERT_LE(why["index"], index);
      EXPECT_EQ(why, events[why["index"].get<std::size_t>() - 1]);
      ++explained;
    }
  }
  EXPECT_GT(explained, 50U);
}

TEST(PlaySession, LoadsMissionsWithFailures) {
  Page page(test::read_file(catalogs / "quadrotor.yaml"));
  const Json loaded = page.ask(
      {{"do", "load"},
       {"mission", "events:\n- {at: 1, start: TAKE_OFF}\n- expect: {stopped: [TAKE_OFF]}\n"}});
  ASSERT_TRUE(loaded.contains("failures")) << loaded;
  ASSERT_EQ(loaded["failures"].size(), 1U) << loaded;
  EXPECT_EQ(loaded["failures"][0]["line"], 3);
  EXPECT_FALSE(loaded["failures"][0].at("why").empty());
  EXPECT_FALSE(page.apply("stop: TAKE_OFF").contains("error"));
  EXPECT_TRUE(page.ask({{"do", "load"}, {"mission", "events: 7"}})["lint"]["errors"] > 0);
  EXPECT_EQ(page.state()["report"]["event"], page.events.size()) << "a bad mission changed it";
}

TEST(PlaySession, ChecksProperties) {
  Page page(test::read_file(catalogs / "quadrotor.yaml"));
  const auto errors_of = [&page](const std::string& properties) {
    return page.ask({{"do", "properties"}, {"properties", properties}}).at("lint")["errors"];
  };
  EXPECT_EQ(errors_of("properties:\n- {can_start: LAND}\n"), 0);
  EXPECT_EQ(errors_of("properties:\n- {can_start: NOBODY}\n"), 1);
  EXPECT_EQ(errors_of("properties: ["), 1);
  EXPECT_EQ(errors_of(""), 0);
}

TEST(PlaySession, StopsWhereTheClockRunsAway) {
  // Its tasks start, and time out, by themselves.
  Page restless(test::read_file(fs::path(CBC_SOURCE_DIR) / "src/page/play/first.yaml"));
  const Json loaded = restless.ask(
      {{"do", "load"},
       {"mission",
        "events:\n- start: DRIVE\n- {at: 3, start: GREET}\n- {at: 999999999, start: CHARGE}\n"}});
  ASSERT_TRUE(loaded.contains("stopped"));
  EXPECT_EQ(loaded["entries"], 2);
  EXPECT_EQ(loaded["events"].size(), 2U);
  EXPECT_EQ(loaded["index"], 2);
  const Json next = restless.ask({{"do", "apply"}, {"event", "stop: GREET"}});
  EXPECT_EQ(next["first"], 3) << next;
}

TEST(PlaySession, GoesBackToBeforeAllEvents) {
  Page page(test::read_file(catalogs / "quadrotor.yaml"));
  page.apply("start: TAKE_OFF");
  page.ask({{"do", "goto"}, {"index", 0}});
  const std::string mission = page.ask({{"do", "mission"}})["mission"];
  const Json loaded = page.ask({{"do", "load"}, {"mission", mission}});
  EXPECT_EQ(loaded["lint"]["errors"], 0) << mission;
  EXPECT_EQ(loaded["entries"], 0);
}

TEST(PlaySession, KeepsWhatIsExpectedOfAnEvent) {
  Page page(test::read_file(catalogs / "quadrotor.yaml"));
  const Json loaded = page.ask(
      {{"do", "load"},
       {"mission",
        "events:\n- start: TAKE_OFF\n- expect: {stopped: [LAND]}\n- {at: 1, stop: TAKE_OFF}\n"}});
  EXPECT_EQ(loaded["expectations"], 1);
  page.ask({{"do", "goto"}, {"index", 1}});
  page.apply("stop: TAKE_OFF");
  const std::string mission = page.ask({{"do", "mission"}})["mission"];
  EXPECT_NE(mission.find("stopped: [\"LAND\"]"), std::string::npos) << mission;
}

TEST(PlaySession, WritesTimesAsTheyWereAskedFor) {
  Page page(test::read_file(catalogs / "quadrotor.yaml"));
  for (const int to : {1, 2, 3}) page.ask({{"do", "advance"}, {"to", to}});
  EXPECT_EQ(page.apply("start: TAKE_OFF")["time"], 3);
  const std::string mission = page.ask({{"do", "mission"}})["mission"];
  EXPECT_EQ(mission.find("000001"), std::string::npos) << mission;
  page.run();
}

TEST(PlaySession, RefusesWhatIsWrong) {
  Session none;
  EXPECT_NE(none.answer(R"({"do":"state"})").find("expected an 'open' first"), std::string::npos);
  Page page(test::read_file(catalogs / "quadrotor.yaml"));
  page.apply("start: TAKE_OFF");
  page.ask({{"do", "advance"}, {"to", 2}});
  const Json before = page.state();
  const std::vector<Json> wrong = {
      Json::array(),
      {{"do", 1}},
      {{"do", "fly"}},
      {{"do", "open"}},
      {{"do", "apply"}},
      {{"do", "apply"}, {"event", ""}},
      {{"do", "apply"}, {"event", "start: NOBODY"}},
      {{"do", "apply"}, {"event", "{at: 1, start: LAND}"}},
      {{"do", "advance"}, {"to", 1}},
      {{"do", "advance"}, {"to", 1e300}},
      {{"do", "goto"}, {"index", 1000}},
      {{"do", "goto"}, {"index", -1}},
      {{"do", "what_if"}, {"event", "start: NOBODY"}},
      {{"do", "what_if"}, {"event", "expect: {}"}},
      {{"do", "why"}, {"task", "NOBODY"}},
      {{"do", "why"}, {"task", "LAND"}, {"index", 1000}},
  };
  for (const Json& request : wrong) {
    EXPECT_TRUE(page.ask(request).contains("error")) << request;
    EXPECT_EQ(page.state(), before) << request;
  }
  const Json faulty = page.ask({{"do", "open"}, {"catalog", "behaviors: 1"}});
  EXPECT_FALSE(faulty.contains("catalog"));
  EXPECT_GT(faulty["lint"]["errors"], 0);
  EXPECT_EQ(page.state(), before);
}

}  // namespace
}  // namespace cbc::play::play_session_test

// Random missions, cut in pieces or recorded: a state that was saved and restored, and the log of a
// run, must give the same events as the run in one go, byte for byte.
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/catalog/reader.h"
#include "core/compile/compile.h"
#include "core/report/event_json.h"
#include "core/script/event_lines.h"
#include "core/script/reader.h"
#include "core/script/runner.h"
#include "core/script/state_json.h"
#include "core/yaml/document.h"
#include "generator.h"
#include "random.h"
#include "support/rounds.h"
#include "yaml_text.h"

namespace cbc::oracle::stream_property_test {
namespace {

const std::uint64_t cases = test::rounds(300U);

using Lines = std::vector<std::string>;

struct Mission {
  CompiledCatalog catalog;
  cbc::Script script;
};

Mission make_mission(std::uint64_t seed) {
  const Case sample = generate_case(seed);
  Random forms(~seed);
  Diagnostics diagnostics;
  const auto catalog =
      read_catalog(catalog_yaml(sample.catalog, forms), "catalog.yaml", diagnostics);
  Mission mission{compile(catalog.value()), {}};
  const auto document =
      yaml::parse(script_yaml(sample.catalog, sample.script, forms), "script.yaml", diagnostics);
  mission.script = read_script(*document, mission.catalog, Severity::warning, diagnostics).value();
  mission.script.timeouts = seed % 4 != 0;
  return mission;
}

/// Of a script, of the header of a log, or of a state.
template <typename Source>
CoordinatorOptions options_of(const Source& source) {
  CoordinatorOptions options;
  options.reactive_delay = source.reactive_delay;
  options.timeouts = source.timeouts;
  return options;
}

/// A run whose events become lines.
class Recording {
 public:
  Recording(const CompiledCatalog& catalog, const CoordinatorOptions& options, Lines& lines)
      : events_(
            catalog, {}, [&lines](const EventStream::Line& line) { lines.emplace_back(line.text); },
            [](const Failure&) {}),
        runner_(catalog, options, events_, {.rejections = true}) {}

  [[nodiscard]] Runner& runner() { return runner_; }

 private:
  EventStream events_;
  Runner runner_;
};

std::string header_of(const Mission& mission) {
  Lines lines;
  Recording recording(mission.catalog, options_of(mission.script), lines);
  recording.runner().begin(mission.script.situation);
  return stream_header(mission.catalog, mission.catalog.file, options_of(mission.script),
                       mission.script.situation,
                       recording.runner().coordinator().state().variables(), "events");
}

Lines run_whole(const Mission& mission) {
  Lines lines;
  Recording recording(mission.catalog, options_of(mission.script), lines);
  recording.runner().begin(mission.script.situation);
  for (const Step& step : mission.script.steps) EXPECT_TRUE(recording.runner().take(step));
  EXPECT_TRUE(recording.runner().settle());
  return lines;
}

/// Saves and restores the state before one step in `one_in`.
Lines run_in_pieces(const Mission& mission, Random& random, std::uint64_t one_in,
                    std::vector<std::string>& states) {
  const CoordinatorOptions options = options_of(mission.script);
  Lines lines;
  auto recording = std::make_unique<Recording>(mission.catalog, options, lines);
  recording->runner().begin(mission.script.situation);
  for (const Step& step : mission.script.steps) {
    if (random.below(one_in) == 0) {
      states.push_back(write_state(mission.catalog, recording->runner().snapshot()));
      const StateReading reading = read_state(states.back(), mission.catalog);
      if (!reading.snapshot) {
        ADD_FAILURE() << reading.error << "\n" << states.back();
        return lines;
      }
      EXPECT_EQ(write_state(mission.catalog, *reading.snapshot), states.back());
      recording =
          std::make_unique<Recording>(mission.catalog, options_of(*reading.snapshot), lines);
      recording->runner().resume(*reading.snapshot);
    }
    EXPECT_TRUE(recording->runner().take(step));
  }
  EXPECT_TRUE(recording->runner().settle());
  return lines;
}

TEST(StreamProperty, PiecesGiveTheSameEventsAsTheWholeMission) {
  std::size_t cuts = 0;
  for (std::uint64_t seed = 1; seed <= cases && !HasFailure(); ++seed) {
    const Mission mission = make_mission(seed);
    Random random(seed);
    std::vector<std::string> states;
    EXPECT_EQ(run_in_pieces(mission, random, 1 + seed % 4, states), run_whole(mission)) << seed;
    cuts += states.size();
  }
  EXPECT_GT(cuts, 2 * cases);
}

TEST(StreamProperty, LogGivesTheSameEventsAgain) {
  std::size_t scripted = 0;
  for (std::uint64_t seed = 1; seed <= cases && !HasFailure(); ++seed) {
    const Mission mission = make_mission(seed);
    const Lines lines = run_whole(mission);
    EventLog log(mission.catalog);
    const auto header = log.read_header(header_of(mission));
    ASSERT_TRUE(header) << log.error();
    Lines again;
    Recording recording(mission.catalog, options_of(*header), again);
    recording.runner().begin(header->situation);
    for (const std::string& line : lines) {
      const auto entry = log.read_entry(line, 2);
      ASSERT_TRUE(entry) << log.error() << "\n" << line;
      EXPECT_TRUE(entry->is_event);
      if (!entry->step) continue;
      EXPECT_TRUE(recording.runner().take(*entry->step));
      ++scripted;
    }
    EXPECT_TRUE(recording.runner().settle());
    EXPECT_EQ(again, lines) << seed;
  }
  EXPECT_GT(scripted, 5 * cases);
}

/// Cuts the text off, or changes a few characters.
std::string change_text(std::string text, int time, Random& random) {
  if (time == 0) text.resize(random.below(text.size()));
  for (int place = 0; place < 1 + time / 2; ++place) {
    if (text.empty()) break;
    constexpr std::string_view characters = "0123456789,[]{}\"-. etn";
    text[random.below(text.size())] = characters[random.below(characters.size())];
  }
  return text;
}

/// Removes a member, or gives it another value: that of another member, or one that is huge, of
/// another type, or empty.
std::string change_member(const std::string& text, Random& random) {
  using Json = nlohmann::ordered_json;
  Json root = Json::parse(text);
  const Json members = root.flatten();
  const auto draw = [&members, &random] {
    return Json::json_pointer(
        std::next(members.begin(), static_cast<std::ptrdiff_t>(random.below(members.size())))
            .key());
  };
  Json::json_pointer place = draw();
  if (random.below(4) == 0 && !place.parent_pointer().empty()) place.pop_back();
  Json& parent = root[place.parent_pointer()];
  static const Json values = Json::parse(
      R"([0, 1, -1, 80001, 2147483647, 2147483648, 1000000000000000, 9223372036854775807,
          9223372036854775808, 18446744073709551615, 1e300, 0.5, "", "0", true, false, null, [], {},
          [[]], {"": 0}])");
  switch (random.below(3)) {
    case 0:
      if (parent.is_array()) {
        parent.erase(std::stoul(place.back()));
      } else {
        parent.erase(place.back());
      }
      break;
    case 1:
      root[place] = values[random.below(values.size())];
      break;
    default:
      root[place] = Json(root[draw()]);
  }
  return root.dump();
}

/// Whatever is accepted must be a state to go on from.
TEST(StreamProperty, DamagedStatesAreRefusedOrHarmless) {
  std::size_t refused = 0;
  std::size_t damaged = 0;
  for (std::uint64_t seed = 1; seed <= cases && !HasFailure(); ++seed) {
    const Mission mission = make_mission(seed);
    Random random(seed);
    std::vector<std::string> states;
    static_cast<void>(run_in_pieces(mission, random, 4, states));
    for (const std::string& state : states) {
      for (int time = 0; time < 12; ++time) {
        const std::string text =
            time < 8 ? change_text(state, time, random) : change_member(state, random);
        ++damaged;
        const StateReading reading = read_state(text, mission.catalog);
        if (!reading.snapshot) {
          EXPECT_FALSE(reading.error.empty());
          ++refused;
          continue;
        }
        Lines lines;
        Recording recording(mission.catalog, options_of(*reading.snapshot), lines);
        recording.runner().resume(*reading.snapshot);
        for (const Step& step : mission.script.steps) {
          if (step.time && *step.time < recording.runner().coordinator().now()) continue;
          ASSERT_TRUE(recording.runner().take(step)) << recording.runner().result().internal_error;
        }
      }
    }
  }
  EXPECT_GT(refused, damaged / 2);
  EXPECT_LT(refused, damaged);
}

}  // namespace
}  // namespace cbc::oracle::stream_property_test

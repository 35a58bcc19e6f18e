// The pages of the file formats have every key that the readers know, and no other.
#include <ostream>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "cbc/event.h"
#include "core/catalog/allowed_values.h"
#include "core/catalog/shape.h"
#include "core/script/script.h"
#include "manual/page.h"

namespace cbc::manual::keys_test {
namespace {

const std::string catalog_page = "cbc-catalog.5";
const std::string events_page = "cbc-events.5";

std::set<std::string> present_keys(const yaml::Shape& shape) {
  std::set<std::string> keys;
  for (const yaml::Key& key : shape.keys) {
    if (key.replaced_by.empty()) keys.emplace(key.name);
  }
  return keys;
}

struct Keys {
  std::string page;
  const yaml::Shape* shape = nullptr;
};

std::ostream& operator<<(std::ostream& out, const Keys& keys) { return out << keys.shape->what; }

class KeysTest : public testing::TestWithParam<Keys> {};

TEST_P(KeysTest, AreThoseOfTheReader) {
  const std::string page = read_page(GetParam().page);
  const yaml::Shape& shape = *GetParam().shape;
  EXPECT_EQ(items(subsection(page, "Keys of " + std::string(shape.what)), "Cm"),
            present_keys(shape));
}

INSTANTIATE_TEST_SUITE_P(
    Manual, KeysTest,
    testing::Values(Keys{catalog_page, &shape::catalog}, Keys{catalog_page, &shape::default_values},
                    Keys{catalog_page, &shape::task_defaults},
                    Keys{catalog_page, &shape::behavior_defaults},
                    Keys{catalog_page, &shape::behavior}, Keys{catalog_page, &shape::performance},
                    Keys{catalog_page, &shape::requirement}, Keys{catalog_page, &shape::task},
                    Keys{catalog_page, &shape::parameter},
                    Keys{catalog_page, &shape::exclusivity_list}, Keys{events_page, &shape::script},
                    Keys{events_page, &shape::event}, Keys{events_page, &shape::expectation}));

TEST(ManualTest, HasTheOlderNamesOfKeys) {
  std::set<std::string> older;
  for (const yaml::Shape* shape : {&shape::task_defaults, &shape::behavior_defaults,
                                   &shape::behavior, &shape::performance, &shape::task}) {
    for (const yaml::Key& key : shape->keys) {
      if (!key.replaced_by.empty()) older.emplace(key.name);
    }
  }
  const std::string page = read_page(catalog_page);
  EXPECT_EQ(items(subsection(page, "Older names"), "Cm"), older);
}

TEST(ManualTest, HasTheTypesOfParameters) {
  const std::string page = read_page(catalog_page);
  const std::set<std::string> types = items(subsection(page, "Types"), "Ic");
  EXPECT_FALSE(types.empty());
  for (const std::string& type : types) {
    for (const std::string& name : {type, type + "_list", "list_of_" + type + "s"}) {
      Parameter parameter;
      parameter.allowed_values = {name};
      EXPECT_FALSE(is_unknown_type(parameter)) << name;
    }
  }
}

TEST(ManualTest, HasTheCausesAndOutcomesOfEvents) {
  const std::string page = read_page(events_page);
  std::set<std::string> causes;
  for (const FinishCause cause :
       {FinishCause::goal_achieved, FinishCause::time_out, FinishCause::wrong_progress,
        FinishCause::situation_change, FinishCause::process_failure, FinishCause::interrupted}) {
    causes.emplace(name_of(cause));
  }
  EXPECT_EQ(items(subsection(page, "Keys of an event"), "Ic"), causes);
  std::set<std::string> outcomes;
  for (const Outcome outcome : {Outcome::accepted, Outcome::rejected, Outcome::unchanged}) {
    outcomes.emplace(name_of(outcome));
  }
  EXPECT_EQ(items(subsection(page, "Keys of an expect"), "Ic"), outcomes);
}

}  // namespace
}  // namespace cbc::manual::keys_test

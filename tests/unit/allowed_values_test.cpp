#include "core/catalog/allowed_values.h"

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/yaml/document.h"
#include "unit/findings.h"

namespace cbc::allowed_values_test {
namespace {

using Words = std::vector<std::string>;

Parameter of_list(Words values) {
  Parameter parameter;
  parameter.name = "p";
  parameter.allowed_values = std::move(values);
  parameter.allowed_is_list = true;
  return parameter;
}

Parameter of_type(std::string type) {
  Parameter parameter;
  parameter.name = "p";
  parameter.allowed_values = {std::move(type)};
  return parameter;
}

/// What is wrong with a value, and where: "1:2-3 message"; empty if nothing is.
std::string fault(const Parameter& parameter, const std::string& value) {
  Diagnostics diagnostics;
  const auto document = yaml::parse(value, "s.yaml", diagnostics);
  EXPECT_NE(document, nullptr) << show(diagnostics);
  if (document == nullptr) return "no YAML";
  const auto found = AllowedValues(parameter).find_fault(document->root());
  return found ? show(found->node->range) + " " + found->message : "";
}

std::string fault(const std::string& type, const std::string& value) {
  return fault(of_type(type), value);
}

/// Expects each value to be good, or to be refused as a whole.
void expect_good(const Parameter& parameter, const Words& values) {
  for (const std::string& value : values) EXPECT_EQ(fault(parameter, value), "") << value;
}

void expect_bad(const Parameter& parameter, const std::string& expected, const Words& values) {
  for (const std::string& value : values) {
    const std::string message = fault(parameter, value);
    EXPECT_TRUE(message.starts_with("1:1-") &&
                message.find(" expected " + expected + ", found ") != std::string::npos)
        << value << ": " << message;
  }
}

// Numbers, in every spelling that a plain scalar may have.
const Words& integers() {
  static const Words texts{"0", "-0", "7", "+7", "-12", "007", "123456789012345678901234567890"};
  return texts;
}
const Words& fractions() {
  static const Words texts{"1.0", "-1.5", ".5",    "5.",          "1e3",          "1E+3",
                           "2e0", "1e-9", "-.5e1", "1e999999999", "-1e-99999999", "0e5"};
  return texts;
}
const Words& no_numbers() {
  static const Words texts{
      "x",    "'5'", "\"1.5\"", "''",   ".inf", "-.inf", ".nan",    "inf",    "nan",     "NaN",
      "0x10", "0o7", "1_0",     "1,5",  "1e",   "e5",    "1:30:00", "1e5x",   ".",       "-",
      "+-1",  "1 2", "1e1.5",   "true", "[1]",  "{}",    "[]",      "{a: 1}", "infinity"};
  return texts;
}

// Ranges ---------------------------------------------------------------------------------------

TEST(AllowedValues, ARangeContainsItsEnds) {
  const Parameter range = of_list({"-360", "360"});
  expect_good(range,
              {"-360", "360", "0", "-0", "360.0", "3.6e2", "-.36E3", "1e-999999999", "359.9"});
  EXPECT_EQ(fault(range, "400"), "1:1-4 expected a number from -360 to 360, found '400'");
  expect_bad(range, "a number from -360 to 360",
             {"361", "-361", "360.0000000000000000000000000000001", "1e999999999", "-1e999999999",
              "1e99999999999999999999999999999"});
  expect_bad(range, "a number from -360 to 360", no_numbers());
}

TEST(AllowedValues, RangesAreExactAtAnySize) {
  const Parameter tiny = of_list({"0.1", "0.3"});
  expect_good(tiny, {"0.1", ".1", "0.30", "3e-1", "0.29999999999999999999999999999"});
  expect_bad(tiny, "a number from 0.1 to 0.3",
             {"0.09999999999999999999999999999", "0.30000000000000000000000000001", "0", "-0.2"});
  const Parameter huge = of_list({"1e999999999", "2e999999999"});
  expect_good(huge, {"1e999999999", "1.5e999999999", "10e999999998"});
  expect_bad(huge, "a number from 1e999999999 to 2e999999999",
             {"0.9e999999999", "2.1e999999999", "1", "-1.5e999999999"});
  const Parameter below_zero = of_list({"-2.5", "-1"});
  expect_good(below_zero, {"-2.5", "-2.49", "-1", "-1.00"});
  expect_bad(below_zero, "a number from -2.5 to -1", {"-2.51", "-0.99", "0", "2"});
  const Parameter point = of_list({"5", "5.0"});
  expect_good(point, {"5", "5.00"});
  expect_bad(point, "a number from 5 to 5.0", {"4", "6"});
}

TEST(AllowedValues, OnlyTwoNumbersAreARange) {
  expect_bad(of_list({"0", "30"}), "a number from 0 to 30", {"31", "LEFT"});
  expect_good(of_list({"0", "30", "60"}), {"0", "30", "60"});
  expect_bad(of_list({"0", "30", "60"}), "one of 0, 30, 60", {"15", "61"});
  expect_bad(of_list({"0"}), "0", {"1"});
  expect_bad(of_list({"0", "MANY"}), "one of 0, MANY", {"1"});
  expect_bad(of_list({"0", ".inf"}), "one of 0, .inf", {"1"});
}

TEST(AllowedValues, EmptyRanges) {
  EXPECT_TRUE(is_empty_range(of_list({"30", "0"})));
  EXPECT_TRUE(is_empty_range(of_list({"-1", "-2"})));
  EXPECT_TRUE(is_empty_range(of_list({"1e999999999", "1e999999998"})));
  EXPECT_TRUE(is_empty_range(of_list({"0.30000000000000000000001", "0.3"})));
  EXPECT_FALSE(is_empty_range(of_list({"0", "30"})));
  EXPECT_FALSE(is_empty_range(of_list({"3", "3.0"})));
  EXPECT_FALSE(is_empty_range(of_list({"-0", "0"})));
  EXPECT_FALSE(is_empty_range(of_list({"-2", "-1"})));
  EXPECT_FALSE(is_empty_range(of_list({"3", "2", "1"})));
  EXPECT_FALSE(is_empty_range(of_list({"b", "a"})));
  EXPECT_FALSE(is_empty_range(of_list({})));
  EXPECT_FALSE(is_empty_range(of_type("30")));
  EXPECT_FALSE(is_empty_range(Parameter{}));
  expect_bad(of_list({"30", "0"}), "a number from 30 to 0", {"30", "15", "0"});
}

// Choices --------------------------------------------------------------------------------------

TEST(AllowedValues, ChoicesOfWords) {
  const Parameter choice = of_list({"FORWARD", "BACKWARD", "LEFT", "RIGHT"});
  expect_good(choice, {"FORWARD", "'LEFT'", "\"RIGHT\""});
  EXPECT_EQ(fault(choice, "FORWRD"),
            "1:1-7 expected one of FORWARD, BACKWARD, LEFT, RIGHT, found 'FORWRD'; did you mean "
            "'FORWARD'?");
  EXPECT_EQ(fault(choice, "left"),
            "1:1-5 expected one of FORWARD, BACKWARD, LEFT, RIGHT, found 'left'; did you mean "
            "'LEFT'?");
  EXPECT_EQ(fault(choice, "UPSIDE"),
            "1:1-7 expected one of FORWARD, BACKWARD, LEFT, RIGHT, found 'UPSIDE'");
  expect_bad(choice, "one of FORWARD, BACKWARD, LEFT, RIGHT", {"''", "5", "[LEFT]", "{LEFT: 1}"});
  EXPECT_EQ(fault(of_list({"ONLY"}), "x"), "1:1-2 expected ONLY, found 'x'");
}

TEST(AllowedValues, ChoicesOfNumbersAreComparedByValue) {
  const Parameter choice = of_list({"1", "2.50", "-3e2", "0", "AUTO"});
  expect_good(choice, {"1", "1.0", "10e-1", "+1", "2.5", "2.50", "-300", "0", "-0", "0e9", "AUTO",
                       "'1'", "'2.50'"});
  // A text in quotes is no number: it is compared as it stands.
  expect_bad(choice, "one of 1, 2.50, -3e2, 0, AUTO",
             {"'1.0'", "'2.5'", "300", "-1", "1.0000000000000000000001", "1e999999999", "auto1"});
}

TEST(AllowedValues, LongChoicesAreCutInMessages) {
  Words values;
  for (int value = 0; value < 100'000; ++value) values.push_back("V" + std::to_string(value));
  EXPECT_EQ(fault(of_list(values), "other"),
            "1:1-6 expected one of V0, V1, V2, V3, V4, V5, V6, V7, V8, V9, V10, V11 and 99988 "
            "more, found 'other'");
  EXPECT_EQ(fault(of_list(values), "V99999"), "");
  EXPECT_LT(fault(of_list({std::string(100'000, 'x'), "b", "c\nd"}), "other").size(), 200U);
}

// Types ----------------------------------------------------------------------------------------

TEST(AllowedValues, Numbers) {
  for (const char* type : {"number", "float", "double", "real", "Number"}) {
    expect_good(of_type(type), integers());
    expect_good(of_type(type), fractions());
    expect_bad(of_type(type), "a number", no_numbers());
  }
}

TEST(AllowedValues, Integers) {
  for (const char* type : {"integer", "int", "INT"}) {
    expect_good(of_type(type), integers());
    expect_bad(of_type(type), "an integer", fractions());
    expect_bad(of_type(type), "an integer", no_numbers());
  }
}

TEST(AllowedValues, Booleans) {
  for (const char* type : {"boolean", "bool", "Boolean"}) {
    expect_good(of_type(type),
                {"true",  "True",  "TRUE",  "yes", "Yes", "YES", "on",  "On",  "ON",  "y", "Y",
                 "false", "False", "FALSE", "no",  "No",  "NO",  "off", "Off", "OFF", "n", "N"});
    expect_bad(of_type(type), "true or false",
               {"'true'", "1", "0", "tRUE", "''", "[true]", "{}", "maybe"});
  }
}

TEST(AllowedValues, Strings) {
  for (const char* type : {"string", "text", "str", "STRING"}) {
    expect_good(of_type(type), {"a", "'a'", "''", "5", "true", "1.5", "a b", R"("\n")", ".inf"});
    expect_bad(of_type(type), "a string", {"[a]", "[]", "{}", "{a: b}"});
  }
}

TEST(AllowedValues, Points) {
  const std::string expected = "expected a point (2 or 3 numbers), found ";
  expect_good(of_type("point"), {"[1, 2]", "[1, -2.5, 3e2]", "{x: 1, y: 2}", "{y: 2, x: 1, z: 3}",
                                 "{x: 1, y: 2, z: ~}", "[1e999999999, 0]"});
  EXPECT_EQ(fault("point", "5"), "1:1-2 " + expected + "'5'");
  EXPECT_EQ(fault("point", "'[1, 2]'"), "1:1-9 " + expected + "'[1, 2]' in quotes");
  EXPECT_EQ(fault("point", "[]"), "1:1-2 " + expected + "an empty list");
  EXPECT_EQ(fault("point", "[1]"), "1:1-2 " + expected + "a list of 1");
  EXPECT_EQ(fault("point", "[1, 2, 3, 4]"), "1:1-2 " + expected + "a list of 4");
  EXPECT_EQ(fault("point", "[1, a]"), "1:5-6 expected a number, found 'a'");
  EXPECT_EQ(fault("point", "[1, '2', b]"), "1:5-8 expected a number, found '2' in quotes");
  EXPECT_EQ(fault("point", "[[1, 2], 3]"), "1:2-3 expected a number, found a list");
  EXPECT_EQ(fault("point", "[1, ~]"), "1:5-6 expected a number, found nothing");
  const std::string without = "1:1-2 expected a point with x and y, found ";
  EXPECT_EQ(fault("point", "{x: 1}"), without + "a mapping without 'y'");
  EXPECT_EQ(fault("point", "{y: 1, z: 2}"), without + "a mapping without 'x'");
  EXPECT_EQ(fault("point", "{x: 1, y: ~}"), without + "a mapping without 'y'");
  EXPECT_EQ(fault("point", "{}"), without + "an empty mapping without 'x'");
  EXPECT_EQ(fault("point", "{x: 1, y: b}"), "1:11-12 expected a number, found 'b'");
  EXPECT_EQ(fault("point", "{x: 1, y: 2, w: 3}"),
            "1:14-15 expected a point with x, y and perhaps z, found 'w'");
}

TEST(AllowedValues, Lists) {
  struct Case {
    std::string types;
    Words good;
    std::string expected;  ///< of what is no list
    std::string bad;
    std::string fault;
  };
  const std::vector<Case> cases{
      {"string_list list_of_strings list_of_string text_list list_of_texts",
       {"[]", "[a]", "[a, 5, '']"},
       "a list of strings",
       "[a, [b]]",
       "1:5-6 expected a string, found a list"},
      {"boolean_list list_of_booleans list_of_bools bool_list",
       {"[]", "[yes, FALSE]"},
       "a list of booleans",
       "[true, 1]",
       "1:8-9 expected true or false, found '1'"},
      {"integer_list list_of_integers list_of_ints int_list",
       {"[]", "[1, -2]"},
       "a list of integers",
       "[1, 2.0, x]",
       "1:5-8 expected an integer, found '2.0'"},
      {"number_list list_of_numbers list_of_floats real_list list-of-doubles",
       {"[]", "[1, -2.5e3]"},
       "a list of numbers",
       "[1, ~]",
       "1:5-6 expected a number, found nothing"},
      {"point_list list_of_points list_of_point Point_List list-of-points",
       {"[]", "[[1, 2]]", "[[1, 2, 3], {x: 1, y: 2}]"},
       "a list of points (2 or 3 numbers each)",
       "[[1, 2], [3, b]]",
       "1:14-15 expected a number, found 'b'"}};
  for (const Case& one : cases) {
    std::string types = one.types;
    while (!types.empty()) {
      const std::string type = types.substr(0, types.find(' '));
      types.erase(0, type.size() + 1);
      SCOPED_TRACE(type);
      EXPECT_FALSE(is_unknown_type(of_type(type)));
      expect_good(of_type(type), one.good);
      expect_bad(of_type(type), one.expected, {"a", "5", "''", "{}", "{a: 1}"});
      EXPECT_EQ(fault(type, one.bad), one.fault);
    }
  }
  EXPECT_EQ(fault("point_list", "[1, 2, 3]"), "1:2-3 expected a point (2 or 3 numbers), found '1'");
}

TEST(AllowedValues, UnknownTypesAreNotChecked) {
  for (const std::string type :
       {"", "pint", "5", "strings", "list", "list_of_", "_list", "list_of_lists", "s", "points",
        "list_of_point_list", "string_", "FORWARD"}) {
    EXPECT_TRUE(is_unknown_type(of_type(type))) << type;
    expect_good(of_type(type), {"a", "5", "[1, [2]]", "{a: {}}", "''"});
  }
  EXPECT_TRUE(is_unknown_type(of_type(std::string(1'000'000, 'x'))));
  EXPECT_FALSE(is_unknown_type(of_list({"pint"})));
  EXPECT_FALSE(is_unknown_type(of_list({})));
  EXPECT_FALSE(is_unknown_type(Parameter{}));
}

TEST(AllowedValues, TheNearestType) {
  EXPECT_EQ(nearest_type("strng"), "string");
  EXPECT_EQ(nearest_type("pointlist"), "point_list");
  EXPECT_EQ(nearest_type("list_of_strngs"), "list_of_strings");
  EXPECT_EQ(nearest_type("booleen"), "boolean");
  EXPECT_EQ(nearest_type("points"), "point");
  EXPECT_EQ(nearest_type("vehicle"), std::nullopt);
  EXPECT_EQ(nearest_type(""), std::nullopt);
}

// Whatever is suggested has to be known itself.
TEST(AllowedValues, SuggestedTypesAreKnown) {
  for (const std::string item : {"string", "boolean", "integer", "number", "point"}) {
    for (const std::string& type : {item, item + "_list", "list_of_" + item + "s"}) {
      const auto nearest = nearest_type("x" + type);
      ASSERT_TRUE(nearest.has_value()) << type;
      EXPECT_EQ(*nearest, type);
      EXPECT_FALSE(is_unknown_type(of_type(std::string(*nearest))));
    }
  }
}

// Nothing to check -----------------------------------------------------------------------------

TEST(AllowedValues, WithoutAllowedValuesAnythingGoes) {
  for (const Parameter& parameter : {Parameter{}, of_list({})}) {
    expect_good(parameter, {"a", "5", "''", "[1, [2]]", "{a: {}}", "~"});
  }
}

TEST(AllowedValues, NullIsNotGiven) {
  for (const Parameter& parameter :
       {of_list({"0", "30"}), of_list({"a", "b"}), of_type("string"), of_type("point_list"),
        of_type("boolean"), of_type("number")}) {
    expect_good(parameter, {"~", "null", ""});
  }
}

TEST(AllowedValues, LongNumbersAreCheap) {
  const std::string digits(1'000'000, '7');
  const Parameter range = of_list({"0", digits});
  EXPECT_EQ(fault(range, digits), "");
  EXPECT_NE(fault(range, "8" + digits.substr(1)), "");
  EXPECT_NE(fault(range, digits + "0"), "");
  EXPECT_LT(fault(of_list({"0", "1"}), digits).size(), 200U);
}

}  // namespace
}  // namespace cbc::allowed_values_test

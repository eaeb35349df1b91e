// SPDX-License-Identifier: MIT
// The tool's words: arguments in, JSON out.
#include "tool/arguments.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tool/json.h"

namespace tool {
namespace arguments_test {
namespace {

TEST(Json, ObjectsArraysNumbersStrings) {
  JsonWriter json;
  json.begin_object().member("name", "a\"b\\\n").member("ok", true).member("count", uint64_t{18446744073709551615u});
  json.key("list").begin_array().value(1).value(-2.5).value(0.1).value(1.0 / 3).null().value(HUGE_VAL).end_array();
  json.key("empty").begin_object().end_object().key("none").begin_array().end_array();
  json.key("nested").begin_array().begin_object().member("x", 1e300).end_object().begin_object().end_object();
  json.end_array().member("text", std::string("s")).end_object();
  EXPECT_EQ(json.text(),
            "{\"name\":\"a\\\"b\\\\\\u000a\",\"ok\":true,\"count\":18446744073709551615,"
            "\"list\":[1,-2.5,0.1,0.3333333333333333,null,null],\"empty\":{},\"none\":[],"
            "\"nested\":[{\"x\":1e+300},{}],\"text\":\"s\"}");
}

Status parse(std::initializer_list<const char*> words, Arguments& arguments) {
  arguments = Arguments();
  const std::vector<const char*> list(words);
  return parse_arguments(static_cast<int>(list.size()), list.data(),
                         {{"--seed", true, true}, {"--sigma", true}, {"--json", true}, {"--quiet", false}}, arguments);
}

TEST(Arguments, OptionsFlagsPositionals) {
  Arguments arguments;
  ASSERT_TRUE(
      parse({"a.off", "--seed", "1,-2.5,3e1", "--quiet", "--seed=0,0,1", "--json", "-", "--sigma=-4", "--", "--b"},
            arguments)
          .ok);
  EXPECT_EQ(arguments.positionals, (std::vector<std::string>{"a.off", "--b"}));
  EXPECT_TRUE(arguments.has("--quiet"));
  double sigma = 1;
  std::vector<std::array<double, 3>> points;
  ASSERT_TRUE(read_points(arguments, "--seed", points).ok);
  EXPECT_EQ(points, (std::vector<std::array<double, 3>>{{1, -2.5, 30}, {0, 0, 1}}));
  ASSERT_TRUE(read_real(arguments, "--sigma", sigma).ok);
  EXPECT_EQ(sigma, -4);
  std::string json;
  ASSERT_TRUE(read_text(arguments, "--json", json).ok);
  EXPECT_EQ(json, "-");
  ASSERT_TRUE(parse({}, arguments).ok);
  ASSERT_TRUE(read_real(arguments, "--sigma", sigma).ok);
  EXPECT_EQ(sigma, -4);
}

TEST(Arguments, Errors) {
  Arguments arguments;
  EXPECT_EQ(parse({"--sed", "1"}, arguments).message, "unknown option --sed");
  EXPECT_EQ(parse({"-q"}, arguments).message, "unknown option -q");
  EXPECT_EQ(parse({"--seed"}, arguments).message, "--seed needs a value");
  EXPECT_EQ(parse({"--seed", "--quiet"}, arguments).message, "--seed needs a value");
  EXPECT_EQ(parse({"--seed="}, arguments).message, "--seed needs a value");
  EXPECT_EQ(parse({"--quiet=1"}, arguments).message, "--quiet takes no value");
  EXPECT_EQ(parse({"--quiet", "--quiet"}, arguments).message, "--quiet is given twice");
  double real = 0;
  std::vector<std::array<double, 3>> points;
  uint64_t whole = 0;
  ASSERT_TRUE(parse({"--seed", "1,2", "--sigma", "nan"}, arguments).ok);
  EXPECT_EQ(read_points(arguments, "--seed", points).message, "--seed: \"1,2\" is not three numbers x,y,z");
  EXPECT_EQ(read_real(arguments, "--sigma", real).message, "--sigma: \"nan\" is not a number");
  EXPECT_EQ(read_unsigned(arguments, "--sigma", whole).message,
            "--sigma: \"nan\" is not a whole number from 0 to 2^64 - 1");
  EXPECT_EQ(parse_whole("2", "side 1", 3, whole).message, "side 1: \"2\" is not a whole number of at least 3");
  ASSERT_TRUE(parse({"a", "b"}, arguments).ok);
  EXPECT_EQ(expect_positionals(arguments, 1, 1, "one MESH").message, "unexpected \"b\" (expected one MESH)");
  EXPECT_EQ(expect_positionals(arguments, 3, 9, "3 or more sides").message, "expected 3 or more sides, got 2");
}

}  // namespace
}  // namespace arguments_test
}  // namespace tool

// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/error.h>
#include <lmdbench/base/json_text.h>

#include "support/message_of.h"
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace lmdbench {
namespace {

using Json = nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::message_of;

std::string nested(std::size_t depth) {
  return std::string(depth, '[') + std::string(depth, ']');
}

TEST(JsonText, DepthAndLengthAreLimited) {
  EXPECT_EQ(parse_json(nested(40), "f"), Json::parse(nested(40)));
  for (const std::size_t depth : {41u, 400u, 100'000u})
    EXPECT_THAT(message_of<UsageError>([&] { parse_json(nested(depth), "f"); }),
                AllOf(HasSubstr("limit of 40"), HasSubstr("--limit json-depth=")));
  EXPECT_THAT(message_of<UsageError>([] { parse_json(std::string(3'000'000, '['), "f"); }),
              HasSubstr("deep"));
  EXPECT_THAT(
      message_of<UsageError>([] { parse_json(std::string("\"").append(50'000, 'a').append("\""), "f"); }),
      AllOf(HasSubstr("50000 bytes"), HasSubstr("--limit json-text=")));
  EXPECT_THAT(message_of<UsageError>(
                  [] { parse_json(std::string("{\"").append(50'000, 'a').append("\": 1}"), "f"); }),
              HasSubstr("50000 bytes"));
}

TEST(JsonText, ARepeatedKeyIsNamedWithItsPlace) {
  const auto refusal = [](const std::string& text) {
    return message_of<UsageError>([&] { parse_json(text, "f"); });
  };
  EXPECT_THAT(refusal(R"({"a": 1, "b": {}, "a": 2})"), HasSubstr("f: /a: key \"a\" appears twice"));
  EXPECT_THAT(refusal(R"([0, [], {"x": [1, {"y": 1}, {"z/w": [2], "y": {}, "z/w": 3}]}])"),
              HasSubstr("f: /2/x/2/z~1w: key \"z/w\" appears twice"));
  EXPECT_EQ(parse_json(R"([{"a": 1}, {"a": 2, "b": {"a": 3}}])", "f").size(), 2u);
}

TEST(JsonText, RefusesControlCharactersAndBrokenUtf8InTexts) {
  EXPECT_THROW(parse_json("\"\x1b[2J\"", "f"), UsageError);
  EXPECT_THROW(parse_json("\"\xFF\"", "f"), UsageError);
  EXPECT_THROW(parse_json(std::string("\"\0\"", 3), "f"), UsageError);
}

class Override : public ::testing::Test {
 protected:
  Json with(const std::string& text) {
    Json document = Json::parse(R"({"a": {"b": 1}, "list": [1, {"c": 2}], "none": null})");
    apply_override(document, text);
    return document;
  }
  std::string refusal(const std::string& text) {
    return message_of<UsageError>([&] { with(text); });
  }
};

TEST_F(Override, SetsMakesAndAppends) {
  EXPECT_EQ(with("/a/b=2")["a"]["b"], 2);
  EXPECT_EQ(with("/a/new/deep=x")["a"]["new"]["deep"], "x");
  EXPECT_EQ(with("/list/1/c=[1]")["list"][1]["c"], Json::parse("[1]"));
  EXPECT_EQ(with("/list/-=3")["list"], Json::parse(R"([1, {"c": 2}, 3])"));
  EXPECT_EQ(with("/list/-/c=3")["list"][2]["c"], 3);
  EXPECT_EQ(with("/fresh/0/mesh=sphere")["fresh"], Json::parse(R"([{"mesh": "sphere"}])"));
  EXPECT_EQ(with("/a~1b=1")["a/b"], 1);
}

TEST_F(Override, RefusesARepeatedKey) {
  EXPECT_THAT(refusal(R"(/a={"x": 1, "x": 2})"),
              AllOf(HasSubstr("--set /a="), HasSubstr("key \"x\" appears twice")));
}

TEST_F(Override, RefusesEveryIndexThatIsNotThere) {
  for (const std::string index :
       {"2", "400000000", "18446744073709551614", "99999999999999999999999", "-1", "01x", "x", ""})
    EXPECT_THAT(refusal("/list/" + index + "=1"), HasSubstr("a list of 2 entries has no entry \"" + index))
        << index;
  EXPECT_THAT(refusal("/list/400000000/c=1"), HasSubstr("a list of 2 entries"));
  EXPECT_THAT(refusal("/a/b/c=1"), HasSubstr("does not lead to a value"));
}

TEST_F(Override, RefusesHostileText) {
  EXPECT_THAT(refusal("/a/b=\xFF\xFE"), AllOf(HasSubstr("UTF-8"), HasSubstr("\\xff\\xfe")));
  EXPECT_THAT(refusal("/a/b=" + nested(400)), HasSubstr("json-depth"));
  EXPECT_THAT(refusal("/a/b=" + std::string(50'000, 'x')), HasSubstr("json-text"));
  std::string steps;
  for (int i = 0; i < 200; ++i) steps += "/x";
  EXPECT_THAT(refusal(steps + "=1"), HasSubstr("a pointer of 200 steps"));
  EXPECT_THAT(refusal("a=1"), HasSubstr("not of the form"));
  EXPECT_THAT(refusal("/a/b"), HasSubstr("not of the form"));
  EXPECT_THAT(refusal(""), HasSubstr("not of the form"));
  EXPECT_THAT(refusal("/a~2=1"), HasSubstr("does not lead to a value"));
}

TEST(JsonLine, TakesNamesOfAnyBytes) {
  EXPECT_EQ(json_line({{"file",
                        "a\xFF"
                        "b"}}),
            "{\"file\":\"a\xEF\xBF\xBD"
            "b\"}");
}

}  // namespace
}  // namespace lmdbench

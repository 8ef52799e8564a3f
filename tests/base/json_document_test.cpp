// SPDX-FileCopyrightText: The lmdbench authors
// SPDX-License-Identifier: BSD-3-Clause
#include <lmdbench/base/json_document.h>
#include <lmdbench/base/json_text.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <support/message_of.h>

#include <string>

namespace lmdbench {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

const Json SCHEMA = Json::parse(R"({
  "type": "object", "additionalProperties": false, "required": ["name"],
  "properties": {
    "name": {"type": "string", "description": "what it is called"},
    "size": {"type": "number", "exclusiveMinimum": 0, "default": 2.5},
    "parts": {"type": "array", "default": [], "items": {
      "type": "object", "additionalProperties": false,
      "properties": {"count": {"type": "integer", "default": 1}}}},
    "colours": {"type": "object", "additionalProperties": {
      "type": "object", "additionalProperties": false,
      "properties": {"shade": {"enum": ["dark", "light"], "default": "dark"}}}}
  }
})");

const std::string TEXT = R"({
  "name": "wheel",

  "parts": [ {},
    {"count": 3}, { "count" : 4 } ]
})";

std::string complaint_about(const std::string& text, std::vector<std::string> overrides = {}) {
  return testing::complaint_of<InputError>(
      [&] { JsonDocument(text, "w.json", SCHEMA, ExitCode::INPUT_DATA, std::move(overrides)); });
}

TEST(LineOf, FindsValuesAndTheNearestEnclosingOneOfWhatIsMissing) {
  EXPECT_EQ(line_of(TEXT, ""), 1);
  EXPECT_EQ(line_of(TEXT, "/name"), 2);
  EXPECT_EQ(line_of(TEXT, "/parts"), 4);
  EXPECT_EQ(line_of(TEXT, "/parts/0"), 4);
  EXPECT_EQ(line_of(TEXT, "/parts/1/count"), 5);
  EXPECT_EQ(line_of(TEXT, "/parts/1/colour"), 5);
  EXPECT_EQ(line_of(TEXT, "/parts/0/colour"), 4);
  EXPECT_EQ(line_of(TEXT, "/partsy"), 1);
}

TEST(LineOf, StepsOverBracketsAndEscapesInTexts) {
  const std::string text =
      "{\"a\": \"}\\\"]{\",\n \"b/c\": [1, -2e3, true,\n null, {\"d~\": []}],\n\"e\": 0}";
  ASSERT_TRUE(Json::accept(text)) << text;
  EXPECT_EQ(line_of(text, "/a"), 1);
  EXPECT_EQ(line_of(text, "/b~1c"), 2);
  EXPECT_EQ(line_of(text, "/b~1c/2"), 2);
  EXPECT_EQ(line_of(text, "/b~1c/3"), 3);
  EXPECT_EQ(line_of(text, "/b~1c/4/d~0"), 3);
  EXPECT_EQ(line_of(text, "/e"), 4);
}

TEST(JsonDocument, FillsDefaultsToAnyDepth) {
  const JsonDocument document(TEXT, "w.json", SCHEMA, ExitCode::USAGE);
  EXPECT_EQ(
      document.json(),
      Json::parse(R"({"name": "wheel", "size": 2.5, "parts": [{"count": 1}, {"count": 3}, {"count": 4}]})"));
}

TEST(JsonDocument, CompletesAndChecksTheValuesOfMaps) {
  const auto text = [](const std::string& key) {
    return "{\"name\": \"a\",\n\"colours\": {\n\"red\": {" + key + "}}}";
  };
  EXPECT_EQ(JsonDocument(text(""), "w.json", SCHEMA, ExitCode::USAGE).json()["colours"]["red"]["shade"],
            "dark");
  EXPECT_THAT(complaint_about(text("\"shades\": 2")), HasSubstr("/colours/red/shades (line 3): unknown key"));
  EXPECT_THAT(
      complaint_about(text("\"shade\": 3")),
      ::testing::AllOf(HasSubstr("/colours/red/shade (line 3): "), HasSubstr("[\"dark\",\"light\"]")));
}

TEST(JsonDocument, NamesPointerLineAndRemedy) {
  EXPECT_EQ(complaint_about("{\n\"name\": 3}"),
            "w.json: /name (line 2): Value type not permitted by 'type' constraint, found 3 "
            "(remedy: expected string: what it is called)");
  EXPECT_EQ(complaint_about("{\"name\": \"a\",\n\n\"parts\": [{}, {\n\"coumt\": 3}]}"),
            "w.json: /parts/1/coumt (line 4): unknown key \"coumt\" (remedy: did you mean \"count\"?)");
  EXPECT_THAT(complaint_about("{\n\"size\": 1}"), HasSubstr("w.json: / (line 1): "));
  EXPECT_THAT(complaint_about("{\n\"name\": }"), HasSubstr("w.json: line 2, column 9: not JSON"));
  EXPECT_EQ(complaint_about(TEXT), "");
}

TEST(JsonDocument, NamesNoLineForWhatAnOverrideGave) {
  EXPECT_THAT(complaint_about(TEXT, {"/size=-1"}), HasSubstr("w.json: /size: "));
}

TEST(JsonDocument, AddsLinesToErrorsOfThisFileOnly) {
  const JsonDocument document(TEXT, "w.json", SCHEMA, ExitCode::USAGE);
  const auto complaint = [&](const Error& thrown) {
    return testing::message_of<Error>([&] { document.locate([&] { throw thrown; }); });
  };
  EXPECT_EQ(complaint(UsageError("w.json", "/name", "is odd", "mend it")),
            "w.json: /name (line 2): is odd (remedy: mend it)");
  EXPECT_EQ(complaint(InputError("m.off", "line 7", "is odd", "mend it")),
            "m.off: line 7: is odd (remedy: mend it)");
  EXPECT_EQ(document.locate([] { return 5; }), 5);
}

TEST(JsonDocument, FailsWithTheErrorOfItsKind) {
  EXPECT_THROW(JsonDocument("{}", "w.json", SCHEMA, ExitCode::USAGE), UsageError);
  EXPECT_THROW(JsonDocument("{}", "w.json", SCHEMA, ExitCode::INPUT_DATA), InputError);
  const JsonDocument document(TEXT, "w.json", SCHEMA, ExitCode::USAGE);
  EXPECT_THROW(document.fail("/name", "is odd", "mend it"), UsageError);
}

}  // namespace
}  // namespace lmdbench

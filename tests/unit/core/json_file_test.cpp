#include "engine/core/json_file.h"

#include <gtest/gtest.h>

#include "engine/core/error.h"

namespace spia {
namespace {

std::string fault(std::string_view text, bool comments = false)
{
    try {
        parse_json(text, "own.json", comments);
    } catch (const InputError& error) {
        return error.what();
    }
    return "none";
}

} // namespace

TEST(JsonFile, AMemberThatIsThereTwiceIsNamedWithItsPlaceAndFile)
{
    EXPECT_EQ(fault(R"({"a": 1, "b": 2, "a": 1})"), "own.json: /a is there twice; leave one of them");
    EXPECT_EQ(fault(R"({"steps": [7, {"x": 0}, [], {"freed": {"y": 1, "y": [1, 2]}}]})"),
              "own.json: /steps/3/freed/y is there twice; leave one of them");
    EXPECT_EQ(fault(R"([[1, {"p": {}, "p": 2}]])"), "own.json: /0/1/p is there twice; leave one of them");
    EXPECT_EQ(fault(R"({"a": {"b": 1}, /* {"a" */ "b": {"a": [{"a": 1}, {"a": 2}], "b": 3}, "\u0061": 0})", true),
              "own.json: /a is there twice; leave one of them")
        << "however it is written";
}

TEST(JsonFile, TheSameNameInOtherObjectsIsNoDouble)
{
    const std::string text = R"({"a":{"a":[{"a":1},{"a":2}],"b":[]},"b":{"a":null,"c":[[{}],"a"]},"c":{}})";
    EXPECT_EQ(parse_json(text, "own.json").dump(), text);
    EXPECT_EQ(parse_json("7", "own.json").dump(), "7");
}

TEST(JsonFile, WhatIsNoJsonOrNoNumberIsToldWithTheFile)
{
    EXPECT_EQ(fault(R"({"a": 1e400})"), "own.json: number overflow parsing '1e400'");
    EXPECT_EQ(fault(R"({"a": 1,, })").substr(0, 40), "own.json: parse error at line 1, column ");
    EXPECT_EQ(fault("").substr(0, 8), "own.json");
}

TEST(JsonFile, ThatWasCutOffIsSaidToBe)
{
    const std::string text = "{\"a\": [1, true,\n\"text\"], \"b\": null}";
    for (size_t length = 1; length < text.size(); ++length)
        EXPECT_NE(fault(text.substr(0, length)).find("it was cut off"), std::string::npos) << text.substr(0, length);
    EXPECT_NE(fault(text.substr(0, 20)).find("at line 2"), std::string::npos);
    EXPECT_EQ(fault("{]").find("it was cut off"), std::string::npos);
}

} // namespace spia

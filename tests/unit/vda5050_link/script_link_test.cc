// Messages out of a file, each in its time, and messages into one.
#include "tools/kbc/vda5050/link/script_link.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

#include "compiler/diagnostics/consumers.h"
#include "tests/unit/whole_file.h"

namespace kb::vda5050 {
namespace {

/// A file of messages, read; `said` is what was wrong with it.
struct Script {
  explicit Script(std::string bytes, const std::string& name = "orders.jsonl") {
    source::MemoryFileSystem files;
    files.add("orders.jsonl", std::move(bytes));
    source::Sources sources;
    diagnostics::ErrorLines lines(sources, said);
    diagnostics::Diagnostics messages(sources, lines);
    read = read_script(name, files, sources, messages);
  }
  std::string said;
  std::optional<std::vector<ScriptMessage>> read;
};

TEST(ScriptLink, GivesEachMessageWhenItsTimeHasCome) {
  const Script script("{\"t\": 1.5, \"topic\": \"order\", \"message\": {\"headerId\": 1}}\n"
                      "{\"t\": 1.5, \"topic\": \"instantActions\", \"message\": {}}\n"
                      "{\"t\": 2, \"topic\": \"order\", \"message\": {\"headerId\": 2}}\n");
  ASSERT_TRUE(script.read) << script.said;
  ScriptLink link(*script.read);
  EXPECT_FALSE(link.next(1'499'999));
  auto first = link.next(1'500'000), second = link.next(1'500'000);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->topic, "order");
  EXPECT_EQ(first->payload, "{\"headerId\": 1}");
  EXPECT_EQ(second->topic, "instantActions");
  EXPECT_FALSE(link.next(1'999'999));
  EXPECT_EQ(link.next(60'000'000)->payload, "{\"headerId\": 2}") << "a robot that was away hears it when it is back";
  EXPECT_FALSE(link.next(60'000'000));
  EXPECT_EQ(link.utc_us(1'500'000), 1'500'000);
  EXPECT_EQ(link.news(), "");
}

TEST(ScriptLink, HasNothingForARobotThatIsSilent) {
  trace::OutputFile file;
  EXPECT_FALSE(ScriptLink({}).live()) << "its messages come by the robot's clock";
  EXPECT_FALSE(Recorder(std::make_unique<ScriptLink>(std::vector<ScriptMessage>()), file).live());
}

TEST(ScriptLink, GivesTheTextOfAMessageAsItStandsInItsLine) {
  const Script script("\xEF\xBB\xBF\r\n"
                      "{\"message\":{ \"a\" : [\"}\\\"\", 1.0e0 ] } ,\"topic\":\"order\",\"t\":0,\"from\":null}\r\n"
                      "\n"
                      "{\"t\":0,\"topic\":\"order\",\"message\":\"{\\\"cut\"}");
  ASSERT_FALSE(script.read) << "a byte order mark is no blank";
  const Script plain("{\"message\":{ \"a\" : [\"}\\\"\", 1.0e0 ] } ,\"topic\":\"order\",\"t\":0,\"from\":null}\r\n"
                     "\n"
                     "{\"t\":0,\"topic\":\"order\",\"message\":\"{\\\"cut\"}");
  ASSERT_TRUE(plain.read) << plain.said;
  ASSERT_EQ(plain.read->size(), 2u);
  EXPECT_EQ((*plain.read)[0].message.payload, "{ \"a\" : [\"}\\\"\", 1.0e0 ] }");
  EXPECT_EQ((*plain.read)[1].message.payload, "{\"cut") << "a string is what comes, which may be no JSON";
}

TEST(ScriptLink, PassesOverWhatTheVehicleSaid) {
  const Script script("{\"t\":0,\"from\":\"vehicle\",\"topic\":\"connection\",\"message\":{}}\n"
                      "{\"t\":1,\"from\":\"master\",\"topic\":\"order\",\"message\":{}}\n"
                      "{\"t\":2,\"from\":\"vehicle\",\"topic\":\"state\",\"message\":{}}\n");
  ASSERT_TRUE(script.read) << script.said;
  ASSERT_EQ(script.read->size(), 1u);
  EXPECT_EQ(script.read->front().t_us, 1'000'000);
}

TEST(ScriptLink, ShowsWhereALineIsWrong) {
  const Script script("{\"t\":1,\"topic\":\"order\",\"message\":{}}\n"
                      "{\"t\":0.5,\"topic\":\"order\",\"message\":{}}\n"
                      "{\"t\":2,\"topic\":\"ordre\",\"message\":{}}\n"
                      "{\"t\":2,\"topic\":\"state\",\"message\":{}}\n"
                      "{\"t\":2,\"topic\":\"order\",\"massage\":{}}\n"
                      "{\"t\":2,\"topic\":\"order\",\"message\":[1]}\n"
                      "{\"topic\":\"order\",\"message\":{}}\n"
                      "{\"t\":2,\"message\":{}}\n"
                      "{\"t\":2,\"topic\":\"order\",\"message\":null}\n"
                      "{\"t\":-2,\"topic\":\"order\",\"message\":{}}\n"
                      "{\"t\":2,\"from\":\"agv\",\"topic\":\"order\",\"message\":{}}\n"
                      "{\"t\":2,\"topic\":\"order\",\"message\":{}\n"
                      "{\"t\":2,\"t\":2,\"topic\":\"order\",\"message\":{}}\n");
  EXPECT_FALSE(script.read);
  EXPECT_EQ(script.said,
            "orders.jsonl:2:6: this message is of 0.5 s, and the one before of 1 s; they stand in the order of their times\n"
            "orders.jsonl:3:16: `topic` is `ordre`; one of `order`, `instantActions` is wanted\n"
            "orders.jsonl:4:16: `topic` is `state`; one of `order`, `instantActions` is wanted\n"
            "orders.jsonl:5:24: there is no field `massage`; there are `t`, `from`, `topic`, `message`\n"
            "orders.jsonl:6:34: `message` is a list of 1; an object is wanted\n"
            "orders.jsonl:7:1: `t` is missing; each line says when its message comes, in s of the robot's clock\n"
            "orders.jsonl:8:1: `topic` is missing; a master writes an `order` or `instantActions`\n"
            "orders.jsonl:9:1: `message` is missing; what comes is an object, or a string where it is no JSON\n"
            "orders.jsonl:10:6: `t` is -2; a number from 0 to 1e+11 is wanted\n"
            "orders.jsonl:11:15: `from` is `agv`; one of `master`, `vehicle` is wanted\n"
            "orders.jsonl:12:36: this is no line of JSON: syntax error while parsing object - unexpected end of input; expected '}'\n"
            "orders.jsonl:13:8: `t` is there twice\n");
}

TEST(ScriptLink, IsToldOfAFileThatThereIsNot) {
  const Script script("", "order.jsonl");
  EXPECT_FALSE(script.read);
  EXPECT_NE(script.said.find("order.jsonl"), std::string::npos) << script.said;
  EXPECT_TRUE(Script("").read) << "a file without a message is one";
}

TEST(Script, ReadsBackWhateverCame) {
  const std::vector<Message> sent{{"order", "{\"a\":\n {\"b\":[]}}\r\n"}, {"order", ""}, {"order", "{\"a\":1},{}"}, {"instantActions", "{} , \"topic\":\"order\""},
                                  {"order", "[1]"}, {"order", "7"}, {"instantActions", "\"x\""}, {"order", std::string(64, '[') + std::string(64, ']')},
                                  {"order", "{\"a\":" + std::string(63, '[') + std::string(63, ']') + "}"}, {"order", std::string("{\"a\0\":1}", 8)}};
  std::string bytes;
  for (const Message& message : sent) bytes += print_script_line(250'000, "master", message);
  const Script script(bytes);
  ASSERT_TRUE(script.read) << script.said;
  ASSERT_EQ(script.read->size(), sent.size());
  for (std::size_t i = 1; i < sent.size(); ++i) {
    EXPECT_EQ((*script.read)[i].t_us, 250'000);
    EXPECT_EQ((*script.read)[i].message.topic, sent[i].topic);
    EXPECT_EQ((*script.read)[i].message.payload, sent[i].payload) << i;
  }
  EXPECT_EQ(script.read->front().message.payload, "{\"a\":  {\"b\":[]}}") << "a line break becomes a blank, and what follows the object is left out";
  EXPECT_EQ(print_script_line(0, "master", {"order", "\xFF"}), "{\"t\":0,\"from\":\"master\",\"topic\":\"order\",\"message\":\"\xEF\xBF\xBD\"}\n") << "what is no UTF-8 cannot stand in JSON";
}

TEST(Recorder, WritesWhatPassesAsAScript) {
  const std::string path = (std::filesystem::temp_directory_path() / ("waymark_script_link_test." + std::to_string(::getpid()))).string();
  {
    trace::OutputFile file;
    ASSERT_TRUE(file.open(path)) << file.error();
    Recorder link(std::make_unique<ScriptLink>(std::vector<ScriptMessage>{{500'000, {"order", "{\"headerId\":1}"}}}), file);
    EXPECT_FALSE(link.next(0));
    link.send({"connection", "{\"connectionState\":\"ONLINE\"}", true}, 0);
    ASSERT_TRUE(link.next(520'000));
    EXPECT_FALSE(link.next(520'000));
    link.send({"state", "{}"}, 520'000);
    EXPECT_EQ(link.utc_us(7), 7);
    ASSERT_TRUE(file.commit()) << file.error();
  }
  const std::string written = whole_file(path);
  std::filesystem::remove(path);
  EXPECT_EQ(written,
            "{\"t\":0,\"from\":\"vehicle\",\"topic\":\"connection\",\"message\":{\"connectionState\":\"ONLINE\"}}\n"
            "{\"t\":0.52,\"from\":\"master\",\"topic\":\"order\",\"message\":{\"headerId\":1}}\n"
            "{\"t\":0.52,\"from\":\"vehicle\",\"topic\":\"state\",\"message\":{}}\n");
  const Script again(written);
  ASSERT_TRUE(again.read) << again.said;
  ASSERT_EQ(again.read->size(), 1u);
  EXPECT_EQ(again.read->front().t_us, 520'000) << "when it was heard, which is when a replay has to give it";
}

}  // namespace
}  // namespace kb::vda5050

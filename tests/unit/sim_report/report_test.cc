// What sim/report writes is well-formed whatever the recording holds, and says what the recording says.
#include "compiler/source/utf8.h"
#include "sim/report/report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "sim/report/text.h"
#include "tests/unit/sim_report/small_drive.h"
#include "tests/unit/stride.h"

namespace kb::sim {
namespace {

using nlohmann::json;

struct Case { std::string name; Recording recording; };
const std::vector<Case>& cases() {
  static const std::vector<Case> kCases = {{"empty", {}}, {"one frame", testing::one_frame()}, {"a drive", testing::small_drive()}, {"nasty names", testing::nasty_drive()}, {"numbers that are not finite", testing::not_finite()}};
  return kCases;
}

/// Empty if `text` is one well-formed element with its content: tags nest, attributes are quoted, no bare `<` or `&`.
std::string xml_fault(std::string_view text) {
  std::vector<std::string> open;
  std::size_t roots = 0;
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == '&') {
      const std::string_view entity = text.substr(i, text.find(';', i) - i);
      if (entity != "&lt" && entity != "&gt" && entity != "&amp" && entity != "&quot") return "entity " + std::string(entity.substr(0, 12));
    }
    if (text[i] != '<') {
      if (static_cast<unsigned char>(text[i]) < 0x20 && text[i] != '\n' && text[i] != '\t') return "control character";
      if (open.empty() && text[i] != '\n') return "text outside";
      ++i;
      continue;
    }
    std::size_t end = i + 1;
    for (bool quoted = false; end < text.size() && (quoted || text[end] != '>'); ++end) {
      if (text[end] == '"') quoted = !quoted;
      if (text[end] == '<') return "< inside a tag";
    }
    if (end == text.size()) return "open tag";
    const std::string_view tag = text.substr(i + 1, end - i - 1);
    const std::string name(tag.substr(tag[0] == '/' ? 1 : 0, tag.find_first_of(" /", 1) - (tag[0] == '/' ? 1 : 0)));
    if (tag[0] == '/') {
      if (open.empty() || open.back() != name) return "</" + name;
      open.pop_back();
    } else {
      if (open.empty() && roots++ > 0) return "two roots";
      if (tag.back() != '/') open.push_back(name);
    }
    i = end + 1;
  }
  return open.empty() && roots == 1 ? "" : "not closed";
}

/// The JSON inside of a page.
json data_of(const std::string& page) {
  const std::string begin = "<script type=\"application/json\" id=\"recording\">";
  const std::size_t from = page.find(begin) + begin.size();
  return json::parse(page.substr(from, page.find("</script>", from) - from));
}
std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++n;
  return n;
}
std::vector<double> sums(const json& column, double unit) {
  std::vector<double> out;
  std::int64_t sum = 0;
  for (const json& step : column) out.push_back(step.is_null() ? NAN : static_cast<double>(sum += step.get<std::int64_t>()) * unit);
  return out;
}

TEST(Html, IsOnePageWithJsonInsideWhateverTheRecording) {
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.name);
    const std::string page = report::html(one.recording);
    EXPECT_EQ(count(page, "</script>"), 2U);
    EXPECT_EQ(count(page, "<script"), 2U);
    EXPECT_EQ(page.find("{{"), page.find("{{data}}"));   // only as the data of the nasty one, or nowhere
    EXPECT_EQ(data_of(page)["frames"]["count"], one.recording.frames.size());
    EXPECT_EQ(source::valid_utf8(page), page);
  }
}

TEST(Html, AsksTheNetworkForNothing) {
  const std::string page = report::html(testing::small_drive());
  EXPECT_EQ(count(page, "http://"), count(page, "http://www.w3.org/2000/svg"));
  EXPECT_EQ(count(page, "https://"), 0U);
  EXPECT_EQ(count(page, " src="), 0U);
  EXPECT_NE(page.find("default-src 'none'"), page.npos);
}

TEST(Html, HoldsThePathOfTheRobotToTheMillimetre) {
  const Recording drive = testing::small_drive();
  const json frames = data_of(report::html(drive))["frames"];
  const std::vector<double> x = sums(frames["x"], 1e-3), t = sums(frames["t"], 1e-4);
  ASSERT_EQ(x.size(), drive.frames.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_NEAR(x[i], drive.frames[i].pose.x_m, 0.0006);
    EXPECT_NEAR(t[i], drive.frames[i].t_s, 0.0001);
  }
}

TEST(Html, HoldsEveryChangeOfEveryCell) {
  const Recording drive = testing::small_drive();
  const json frames = data_of(report::html(drive))["frames"];
  std::vector<std::vector<float>> values(drive.frames.size());
  for (const json& cell : frames["changes"]) {
    const std::vector<double> at = sums(cell[1], 1.0), to = sums(cell[2], 1e-4);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const auto& changed = drive.frames[static_cast<std::size_t>(at[i])].changed;
      const auto found = std::find_if(changed.begin(), changed.end(), [&](const auto& one) { return one.cell == cell[0]; });
      ASSERT_NE(found, changed.end());
      EXPECT_NEAR(static_cast<double>(found->value), to[i], 0.0001);
      values[static_cast<std::size_t>(at[i])].push_back(found->value);
    }
  }
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(values[i].size(), drive.frames[i].changed.size());
}

TEST(Html, HoldsTheStatusOfEveryFrame) {
  const Recording drive = testing::small_drive();
  const json status = data_of(report::html(drive))["frames"]["status"];
  const std::vector<double> at = sums(status[0], 1.0);
  std::size_t change = 0;
  for (std::size_t i = 0; i < drive.frames.size(); ++i) {
    if (change + 1 < at.size() && at[change + 1] <= static_cast<double>(i)) ++change;
    ASSERT_EQ(status[1][change], drive.frames[i].status) << i;
  }
  EXPECT_EQ(change + 1, at.size());
}

TEST(Html, SaysUnknownForWhatIsNotFinite) {
  const json frames = data_of(report::html(testing::not_finite()))["frames"];
  EXPECT_TRUE(frames["x"][10].is_null());
  EXPECT_FALSE(frames["x"][11].is_null());
  EXPECT_TRUE(frames["t"].back().is_null());
}

TEST(Html, TakesLessThanAMegabyteForTenMinutes) {
  const Recording drive = testing::small_drive(1, 27);
  ASSERT_GT(drive.frames.size(), 6000U);
  EXPECT_LT(report::html(drive).size(), 1'000'000U);
}

TEST(AllForms, AreTheSameBytesForTheSameRecording) {
  const Recording a = testing::small_drive(7), b = testing::small_drive(7);
  EXPECT_EQ(report::html(a), report::html(b));
  EXPECT_EQ(report::svg(a), report::svg(b));
  EXPECT_EQ(report::chrome_trace(a), report::chrome_trace(b));
  EXPECT_EQ(report::csv(a), report::csv(b));
  EXPECT_NE(report::csv(a), report::csv(testing::small_drive(8)));
}

TEST(AllForms, TakeTenThousandFrames) {
  const Recording drive = testing::small_drive(1, 45 / static_cast<int>(kb::testing::stride()));
  ASSERT_GT(drive.frames.size() * kb::testing::stride(), 10'000U);
  EXPECT_EQ(data_of(report::html(drive))["frames"]["count"], drive.frames.size());
  EXPECT_EQ(xml_fault(report::svg(drive)), "");
  EXPECT_TRUE(json::accept(report::chrome_trace(drive)));
  EXPECT_EQ(count(report::csv(drive), "\n"), drive.frames.size() + 1);
}

TEST(Svg, IsWellFormedWhateverTheRecording) {
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.name);
    const std::string picture = report::svg(one.recording);
    EXPECT_EQ(xml_fault(picture), "");
    EXPECT_EQ(picture.find("nan"), picture.npos);
    EXPECT_EQ(picture.find("inf"), picture.npos);
  }
}

TEST(Svg, ShowsNotesAndTheKindsThatRan) {
  const std::string picture = report::svg(testing::small_drive());
  for (const char* words : {">LM15<", ">Move<", ">Cross<", ">Avoid<", ">no strategy<", "road LM7.E closed", ">arrived<", ">3\u20134</text>"}) EXPECT_NE(picture.find(words), picture.npos) << words;
}

TEST(XmlFault, SeesWhatIsWrong) {
  EXPECT_EQ(xml_fault("<a b=\"&lt;\"><c/>x</a>\n"), "");
  for (const char* wrong : {"<a>", "<a></b>", "<a>&x;</a>", "<a/><b/>", "<a><b></a></b>", "", "<a>\x01</a>"}) EXPECT_NE(xml_fault(wrong), "") << wrong;
}

TEST(ChromeTrace, IsJsonWhateverTheRecording) {
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.name);
    const json trace = json::parse(report::chrome_trace(one.recording));
    for (const json& event : trace["traceEvents"]) {
      EXPECT_TRUE(event.contains("ph") && event.contains("pid") && event.contains("name"));
      EXPECT_TRUE(event["ph"] != "X" || event["ts"].get<std::int64_t>() >= 0);
      EXPECT_TRUE(event["ph"] != "C" || event["args"]["certainty"].is_number());
    }
  }
}

TEST(ChromeTrace, HasStrategiesAsSlicesThatTouch) {
  const Recording drive = testing::small_drive();
  const json trace = json::parse(report::chrome_trace(drive));
  std::vector<std::string> names;
  std::int64_t end = -1;
  for (const json& event : trace["traceEvents"]) {
    if (event["ph"] != "X" || event["tid"] != 1) continue;
    EXPECT_TRUE(end < 0 || event["ts"] >= end);
    end = event["ts"].get<std::int64_t>() + event["dur"].get<std::int64_t>();
    names.push_back(event["name"]);
  }
  ASSERT_GT(names.size(), 8U);
  EXPECT_EQ(names[0], "Move.mark");
  EXPECT_EQ(names[1], "Cross[right,mark]");
  EXPECT_NE(std::find(names.begin(), names.end(), "Avoid"), names.end());
  EXPECT_NEAR(static_cast<double>(end), drive.frames.back().t_s * 1e6, 3e6) << "in microseconds; at the end it stands, without a strategy";
}

TEST(Csv, HasAsManyFieldsInEachRowAsInTheHeader) {
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.name);
    std::istringstream rows(report::csv(one.recording));
    std::size_t expected = 0, lines = 0;
    for (std::string row; std::getline(rows, row); ++lines) {
      std::size_t fields = 1;
      bool quoted = false;
      for (const char c : row) {
        if (c == '"') quoted = !quoted;
        if (c == ',' && !quoted) ++fields;
      }
      EXPECT_FALSE(quoted);
      if (lines == 0) expected = fields;
      EXPECT_EQ(fields, expected);
    }
    EXPECT_EQ(lines, one.recording.frames.size() + 1);
  }
}

TEST(Csv, LeavesTheFieldsOfSilentSensorsEmpty) {
  Recording recording = testing::one_frame();
  recording.frames[0].senses.heading_known = true;
  recording.frames[0].senses.heading_rad = 1.5f;
  const std::string table = report::csv(recording);
  EXPECT_EQ(table.substr(table.find('\n') + 1), "0,0,0,0,,,,,,,,,,,,,,1.5,,,,,0,,,,,\n");
}

TEST(Csv, NumbersTheDecisionsAndNotTheTimeInWhichTheMindRests) {
  Recording recording;
  recording.frames.resize(5);
  const char* const statuses[] = {"ok", "off", "waits", "no_strategy", "ok"};
  for (std::size_t i = 0; i < 5; ++i) recording.frames[i].status = statuses[i];
  std::istringstream rows(report::csv(recording));
  std::string line, ticks;
  std::getline(rows, line);
  EXPECT_TRUE(line.ends_with(",tick")) << line;
  while (std::getline(rows, line)) ticks += line.substr(line.rfind(',')) + ";";
  EXPECT_EQ(ticks, ",1;,;,;,2;,3;");
}

TEST(Csv, HasNoTwoColumnsOfOneName) {
  Recording recording;
  for (const char* name : {"status", "t", "line_3", "Line", "tick"}) recording.names.cells.push_back({name, MindNames::Cell::Kind::kFact, 0.0f});
  const std::string table = report::csv(recording);
  EXPECT_NE(table.find(",touched,fact:status,fact:t,fact:line_3,Line,fact:tick,strategy,leg,status,notes,tick\n"), std::string::npos) << table;
}

TEST(Facts, AreThoseThatWereToldWithAllTheirDigits) {
  Recording recording;
  using Kind = MindNames::Cell::Kind;
  recording.names.cells = {{"Line", Kind::kFact, 0.0f}, {"Never", Kind::kFact, 0.0f}, {"Cross[left,mark]", Kind::kFact, 0.0f}, {"Going", Kind::kSatellite}};
  recording.frames.resize(3);
  recording.frames[1].t_s = 0.1;
  recording.frames[1].changed = {{0, 0.1234567f}, {3, 1.0f}};
  recording.frames[2].t_s = 0.2;
  recording.frames[2].changed = {{0, 0.0f}, {2, std::nanf("")}, {9, 1.0f}};
  EXPECT_EQ(report::facts(recording), "t,Line,\"Cross[left,mark]\"\n0,,\n0.1,0.1234567,\n0.2,,nan\n");
  EXPECT_EQ(report::facts({}), "t\n");
}

TEST(Text, WritesNumbersShort) {
  EXPECT_EQ(report::fixed(0.30000000000000004, 6), "0.3");
  EXPECT_EQ(report::fixed(-0.0000001, 6), "0");
  EXPECT_EQ(report::fixed(1200.0, 6), "1200");
}

}  // namespace
}  // namespace kb::sim

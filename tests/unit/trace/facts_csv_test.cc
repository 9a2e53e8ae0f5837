#include "tools/kbc/trace/facts_csv.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/unit/trace/sample.h"

namespace kb::trace {

std::vector<std::string> testing::Reading::rows() {
  std::vector<std::string> out;
  while (const FactsRow* row = reader.next()) {
    std::string text = fmt::format("{}us", row->dt_us);
    for (std::uint32_t i = 0; i < program.facts; ++i)
      if (row->facts[i] != 0.0f) text += fmt::format(" {}={}", program.cells[i].name, row->facts[i]);
    out.push_back(text);
  }
  return out;
}

namespace {

using testing::Reading;
using Lines = std::vector<std::string>;

Lines rows_of(std::string_view bytes) {
  Reading reading(bytes);
  EXPECT_TRUE(reading.reader.open()) << fmt::format("{}", fmt::join(reading.said.all, "\n"));
  const Lines rows = reading.rows();
  EXPECT_EQ(reading.said.all, Lines{});
  return rows;
}

Lines complaints_of(std::string_view bytes) {
  Reading reading(bytes);
  if (reading.reader.open()) reading.rows();
  EXPECT_TRUE(reading.reader.failed());
  return reading.said.all;
}

TEST(FactsCsv, reads_a_row_a_tick_and_takes_an_empty_field_for_no_data) {
  EXPECT_EQ(rows_of("Line,Safe\n1,-0.5\n,0.25\n0,\n"),
            (Lines{"0us Line=1 Safe=-0.5", "100000us Safe=0.25", "100000us"}));
}

TEST(FactsCsv, takes_times_from_the_column_t_whose_first_value_is_free) {
  EXPECT_EQ(rows_of("Line,t\n1,-3.5\n1,-3.25\n0,10\n"), (Lines{"0us Line=1", "250000us Line=1", "13250000us"}));
}

TEST(FactsCsv, takes_the_length_of_ticks_from_a_comment_unless_the_caller_says_otherwise) {
  const std::string_view file = "# dt: 20 ms\nLine\n1\n1\n";
  EXPECT_EQ(rows_of(file).back(), "20000us Line=1");
  Reading reading(file);
  ASSERT_TRUE(reading.reader.open(5000));
  EXPECT_EQ(reading.rows().back(), "5000us Line=1");
}

TEST(FactsCsv, knows_names_in_either_spelling_quoted_or_not) {
  const Lines want{"0us In.N=1 Near[left,far]=-1"};
  EXPECT_EQ(rows_of("In.N,Near.left.far\n1,-1\n"), want);
  EXPECT_EQ(rows_of("In[N],\"Near[left,far]\"\n1,-1\n"), want);
  EXPECT_EQ(rows_of(" In.N , Near[left, far]\n1,-1\n"), want);
}

TEST(FactsCsv, passes_over_comments_blank_lines_byte_order_mark_and_carriage_returns) {
  EXPECT_EQ(rows_of("\xEF\xBB\xBF# recorded on the bench\r\n\r\n\"Line\",Safe\r\n# the first\r\n1,1\r\n\r\n  # "
                    "quiet\r\n0,\"0.5\"\r\n"),
            (Lines{"0us Line=1 Safe=1", "100000us Safe=0.5"}));
}

TEST(FactsCsv, reads_numbers_in_all_their_forms) {
  EXPECT_EQ(rows_of("Line\n+0.5\n1e-1\n.5\n 1 \n1e-60\n-1E0\n").size(), 6u);
  Reading reading("Line,Safe\nnan,inf\n-inf,1e300\n");
  ASSERT_TRUE(reading.reader.open());
  const FactsRow* row = reading.reader.next();
  ASSERT_NE(row, nullptr);
  EXPECT_TRUE(std::isnan(row->facts[1]));
  EXPECT_TRUE(std::isinf(row->facts[2]));
  row = reading.reader.next();
  ASSERT_NE(row, nullptr);
  EXPECT_TRUE(std::isinf(row->facts[2])) << "1e300 is beyond a float";
}

TEST(FactsCsv, says_what_a_wrong_column_is_and_what_was_probably_meant) {
  EXPECT_EQ(complaints_of("Lime,sat Line,Stop,Safe,,Safe\n1,1,1,1,1,1\n"),
            (Lines{"KB0926 1:1-5 no fact is called `Lime` (Line?)",
                   "KB0927 1:6-14 `sat Line` is a satellite: rules write it, and a column gives a fact",
                   "KB0927 1:15-19 `Stop` is a strategy: rules write it, and a column gives a fact",
                   "KB0929 1:25-26 column 5 has no name", "KB0928 1:26-30 `Safe` has two columns"}));
}

TEST(FactsCsv, asks_for_a_header) {
  EXPECT_EQ(complaints_of(""),
            (Lines{"KB0925 `in.csv` has no header; its first line names the facts, separated by commas"}));
  EXPECT_EQ(complaints_of("# only\n\n"),
            (Lines{"KB0925 `in.csv` has no header; its first line names the facts, separated by commas"}));
}

TEST(FactsCsv, knows_semicolons_and_tabs_for_what_they_are) {
  EXPECT_EQ(complaints_of("Line;Safe\n1;1\n"),
            (Lines{"KB0930 1:5-6 columns are separated by commas, but `;` stands here"}));
  EXPECT_EQ(complaints_of("Line\tSafe\n"),
            (Lines{"KB0930 1:5-6 columns are separated by commas, but a tab stands here"}));
}

TEST(FactsCsv, reports_every_wrong_row_where_it_is_wrong) {
  EXPECT_EQ(
      complaints_of("Line,Safe\n1\n1,x\n1,2,3\n1,0\n0,1e999\n"),
      (Lines{"KB0931 2:2-3 1 field in this row, but the header names 2 columns", "KB0932 3:3-4 `x` is not a number",
             "KB0931 4:5-6 3 fields in this row, but the header names 2 columns",
             "KB0933 6:3-8 `1e999` is beyond the range of numbers"}));
}

TEST(FactsCsv, stops_listing_wrong_rows_where_it_becomes_an_avalanche) {
  std::string file = "Line\n";
  for (int i = 0; i < 1000; ++i) file += "x\n";
  EXPECT_EQ(complaints_of(file).size(), FactsReader::kMaxWrongRows);
}

TEST(FactsCsv, gives_no_row_after_a_wrong_one) {
  Reading reading("Line\n1\nx\n1\n");
  ASSERT_TRUE(reading.reader.open());
  EXPECT_EQ(reading.rows().size(), 1u);
}

TEST(FactsCsv, wants_times_that_do_not_go_back_and_warns_of_steps_that_no_clock_can_count) {
  EXPECT_EQ(
      complaints_of("t,Line\n0,1\n0.1,1\n0.1,1\n0.05,1\n,1\nnan,1\n9000,1\n"),
      (Lines{"KB0936 5:1-5 time 0.05 s comes before 0.1 s, the row before",
             "KB0934 6:1-2 this row has no time; where the header has `t`, every row has one",
             "KB0935 7:1-4 `nan` is not a time in seconds",
             "KB0969 8:1-5 8999.95 s lie between this row and the one before; the clock of the mind counts at most 4294.967295 s at once"}));
}

TEST(FactsCsv, refuses_two_ways_to_say_how_long_ticks_are) {
  EXPECT_EQ(complaints_of("# dt: 10 ms\nt,Line\n0,1\n"),
            (Lines{"KB0939 the column `t` says how long ticks are; the comment `# dt:` cannot say it too"}));
  EXPECT_EQ(complaints_of("# dt: 10 apples\nLine\n1\n"),
            (Lines{"KB0938 1:7-16 `10 apples` is not a length of time from 1 us to 71 min, such as `10 ms`"}));
}

TEST(FactsCsv, names_bytes_that_are_no_text) {
  EXPECT_EQ(complaints_of("Line,\xC3\x28\n1,1\n"), (Lines{"KB0921 1:6-7 these bytes are not UTF-8"}));
  EXPECT_EQ(complaints_of("Line\n\xFF\n"), (Lines{"KB0921 2:1-2 these bytes are not UTF-8"}));
  EXPECT_EQ(complaints_of("# \xF5\nLine\n1\n").front(), "KB0921 1:3-4 these bytes are not UTF-8");
  EXPECT_EQ(complaints_of(std::string_view("Line\n1\0\n", 8)), (Lines{"KB0932 2:1-3 `1\\x00` is not a number"}));
}

TEST(FactsCsv, names_quotes_that_do_not_fit) {
  EXPECT_EQ(complaints_of("Line,\"Safe\n1,1\n"), (Lines{"KB0923 1:6-7 this quote is not closed on its line"}));
  EXPECT_EQ(complaints_of("Line,Safe\n1,\"1\"2\n"),
            (Lines{"KB0924 2:6-7 `2` stands between a closing quote and the next comma"}));
}

TEST(FactsCsv, refuses_a_line_without_end) {
  std::string file = "Line\n1\n" + std::string(LineReader::kMaxLineBytes + 1, '1') + "\n1\n";
  EXPECT_EQ(complaints_of(file),
            (Lines{"KB0922 3:1-2 a line of more than 1048576 bytes; a row ends with a line break"}));
  file.erase(7, 1);
  EXPECT_EQ(complaints_of(file).front().substr(0, 6), "KB0933") << "a line of exactly the limit is read";
}

TEST(FactsCsv, gives_the_same_rows_however_the_bytes_arrive) {
  std::string file = "t,Line,Safe\n";
  for (int i = 0; i < 500; ++i) file += fmt::format("{},{},{}\r\n", i * 0.1, i % 3 - 1, (i % 7) / 7.0);
  const Lines want = rows_of(file);
  ASSERT_EQ(want.size(), 500u);
  for (const std::size_t chunk : {1u, 2u, 3u, 7u, 100u, 4096u}) {
    Reading reading(file, chunk);
    ASSERT_TRUE(reading.reader.open());
    EXPECT_EQ(reading.rows(), want) << chunk;
  }
}

TEST(FactsCsv, survives_any_bytes) {
  constexpr unsigned kSeed = 20240917;
  std::mt19937 random(kSeed);
  const std::string alphabet = "\n\r,\"#-+.019e tLineSaf[]\xC3\xA9\xFF;";
  for (int round = 0; round < 3000; ++round) {
    std::string file = round % 2 == 0 ? "t,Line,Safe\n" : "";
    for (std::size_t i = random() % 60; i > 0; --i) file += alphabet[random() % alphabet.size()];
    Reading reading(file, 1 + random() % 9);
    const bool opened = reading.reader.open();
    if (opened) reading.rows();
    EXPECT_EQ(reading.reader.failed(), !reading.said.all.empty()) << "seed " << kSeed << ", round " << round << ":\n"
                                                                  << file;
  }
}

TEST(Duration, needs_a_number_and_a_unit_of_time) {
  EXPECT_EQ(parse_duration("10ms"), 10'000u);
  EXPECT_EQ(parse_duration(" 0.5 s "), 500'000u);
  EXPECT_EQ(parse_duration("2 min"), 120'000'000u);
  EXPECT_EQ(parse_duration("7us"), 7u);
  for (const char* wrong : {"", "10", "ms", "-1 s", "0 s", "nan s", "inf s", "2 h", "1e9 s", "1 s s"})
    EXPECT_EQ(parse_duration(wrong), std::nullopt) << wrong;
}

}  // namespace
}  // namespace kb::trace

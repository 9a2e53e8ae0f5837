#include "planners/maps/maps.h"

#include <gtest/gtest.h>

#include "compiler/diagnostics/consumers.h"
#include "tests/unit/planners/planning.h"

namespace kb::planners {
namespace {

// Reads a file of these bytes, and keeps what is said of it.
struct Reading {
  source::Sources sources;
  diagnostics::CollectingConsumer consumer;
  diagnostics::Diagnostics messages{sources, consumer};

  std::optional<MapFile> map(const std::string& path, const source::MemoryFileSystem& files) {
    return read_map(path, files, sources, messages);
  }
  std::optional<Grid> movingai(std::string bytes) {
    return read_movingai_map(sources.add("a.map", std::move(bytes)), messages);
  }
  // Code and place of the first message.
  std::string said() const {
    if (consumer.all.empty()) return "nothing";
    const auto& first = consumer.all.front();
    return diagnostics::code_text(first.kind) + " " + sources.describe(first.span);
  }
};

TEST(MovingAiMap, is_turned_so_that_y_goes_up) {
  Reading reading;
  const auto grid = reading.movingai("type octile\r\nheight 2\r\nwidth 3\r\nmap\r\n.G@\r\nSTW\r\n");
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->width(), 3);
  EXPECT_EQ(grid->height(), 2);
  EXPECT_TRUE(grid->free({0, 1}));
  EXPECT_TRUE(grid->free({1, 1}));
  EXPECT_TRUE(grid->blocked({2, 1}));
  EXPECT_TRUE(grid->free({0, 0})) << "a swamp";
  EXPECT_TRUE(grid->blocked({1, 0}));
  EXPECT_TRUE(grid->blocked({2, 0})) << "water";
}

TEST(MovingAiMap, may_begin_with_a_byte_order_mark) {
  Reading reading;
  EXPECT_TRUE(reading.movingai("\xEF\xBB\xBFtype octile\nheight 1\nwidth 1\nmap\n.\n")) << reading.said();
}

TEST(MovingAiMap, has_its_mistakes_told_where_they_stand) {
  const auto said = [](std::string bytes) {
    Reading reading;
    EXPECT_FALSE(reading.movingai(std::move(bytes)));
    return reading.said();
  };
  const std::string head = "type octile\nheight 2\nwidth 3\nmap\n";
  EXPECT_EQ(said(""), "KB1201 a.map:1:1");
  EXPECT_EQ(said("type tile\n"), "KB1202 a.map:1:6");
  EXPECT_EQ(said("type octile\nwidth 2\n"), "KB1201 a.map:2:1");
  EXPECT_EQ(said("type octile\nheight two\n"), "KB1203 a.map:2:8");
  EXPECT_EQ(said("type octile\nheight 0\n"), "KB1203 a.map:2:8");
  EXPECT_EQ(said("type octile\nheight 32766\nwidth 32766\nmap\n..."), "KB1206 a.map:5:4");
  EXPECT_EQ(said(head + "...\n..x\n"), "KB1205 a.map:6:3");
  EXPECT_EQ(said(head + "...\n....\n"), "KB1204 a.map:6:1");
  EXPECT_EQ(said(head + "...\n"), "KB1206 a.map:6:1");
  EXPECT_EQ(said(head + "...\n...\n\n..."), "KB1207 a.map:8:1");
}

TEST(Scenarios, have_their_rows_turned_and_checked) {
  Reading reading;
  const Grid grid = testing::draw({"..#",
                                   "..."});
  const auto read = [&](const std::string& row) {
    return read_scenarios(reading.sources.add("a.scen", "version 1\n" + row), grid, reading.messages);
  };
  const auto rows = read("3\ta.map\t3\t2\t0\t0\t2\t1\t2.41421356\n");
  ASSERT_TRUE(rows);
  ASSERT_EQ(rows->size(), 1u);
  EXPECT_EQ(rows->front().start, (Cell{0, 1}));
  EXPECT_EQ(rows->front().goal, (Cell{2, 0}));
  EXPECT_EQ(rows->front().bucket, 3u);
  EXPECT_EQ(rows->front().line, 2u);
  EXPECT_FALSE(read("3\ta.map\t3\t2\t0\t0\t2\t0\t2\n")) << "the goal is blocked";
  EXPECT_EQ(reading.said(), "KB1214 a.scen:2:17");
}

TEST(Scenarios, have_all_their_mistakes_told_at_once) {
  Reading reading;
  const Grid grid(3, 2);
  const auto file = reading.sources.add("a.scen",
                                        "version 1\n0\ta\t3\t2\t0\t0\t2\t1\n0\ta\t4\t2\t0\t0\t2\t1\t2\n"
                                        "0\ta\t3\t2\t0\t-1\t2\t1\t2\n0\ta\t3\t2\t0\t0\t2\t9\t2\n0\ta\t3\t2\t0\t0\t2\t1\tnan\n");
  EXPECT_FALSE(read_scenarios(file, grid, reading.messages));
  std::vector<unsigned> codes;
  for (const auto& message : reading.consumer.all) codes.push_back(diagnostics::info(message.kind).code);
  EXPECT_EQ(codes, (std::vector<unsigned>{1211, 1213, 1212, 1214, 1212}));
}

constexpr std::string_view kYaml = "image: hall.pgm\nresolution: 0.5\norigin: [-1.0, 2.0, 0]\n";

TEST(RosMap, is_read_with_its_image_beside_it) {
  source::MemoryFileSystem files;
  files.add("maps/hall.yaml", std::string(kYaml) + "negate: 0 # black is blocked\noccupied_thresh: 0.65\n");
  files.add("maps/hall.pgm", std::string("P5\n# made by hand\n3 2\n255\n") + "\xFE\xCD\x01" + "\xFE\xFE\xFE");
  Reading reading;
  const auto map = reading.map("maps/hall.yaml", files);
  ASSERT_TRUE(map) << reading.said();
  EXPECT_FALSE(map->in_cells);
  EXPECT_EQ(map->grid.cell_m(), 0.5);
  EXPECT_EQ(map->grid.origin_m(), (Point{-1.0, 2.0}));
  EXPECT_TRUE(map->grid.free({0, 1}));
  EXPECT_TRUE(map->grid.free({1, 1})) << "0.196 occupied is below the threshold for free";
  EXPECT_TRUE(map->grid.blocked({2, 1}));
  EXPECT_TRUE(map->grid.free({2, 0}));
}

TEST(RosMap, blocks_what_is_unknown) {
  source::MemoryFileSystem files;
  files.add("hall.yaml", std::string(kYaml) + "free_thresh: 0.1\n");
  files.add("hall.pgm", "P2 3 1 100  100 50 0 ");
  Reading reading;
  const auto map = reading.map("hall.yaml", files);
  ASSERT_TRUE(map) << reading.said();
  EXPECT_TRUE(map->grid.free({0, 0}));
  EXPECT_TRUE(map->grid.blocked({1, 0}));
  EXPECT_TRUE(map->grid.blocked({2, 0}));
}

TEST(RosMap, can_be_negated_and_raw_and_of_two_bytes_a_pixel) {
  source::MemoryFileSystem files;
  files.add("n.yaml", "image: n.pgm\nresolution: 1\norigin:\n- 0\n- 0\n- 0\nnegate: 1\n");
  files.add("true.yaml", "image: n.pgm\nresolution: 1\norigin: [0,0,0]\nnegate: true\n");
  files.add("n.pgm", std::string("P5 2 1 65535 ") + std::string("\x00\x01\xFF\xFF", 4));
  files.add("r.yaml", "image: 'r.pgm'\nresolution: 1\norigin: [0,0,0]\nmode: raw\n");
  files.add("r.pgm", "P2 3 1 255 0 100 255");
  Reading reading;
  for (const char* const path : {"n.yaml", "true.yaml"}) {
    const auto negated = reading.map(path, files);
    ASSERT_TRUE(negated) << reading.said();
    EXPECT_TRUE(negated->grid.free({0, 0}));
    EXPECT_TRUE(negated->grid.blocked({1, 0}));
  }
  const auto raw = reading.map("r.yaml", files);
  ASSERT_TRUE(raw) << reading.said();
  EXPECT_EQ(raw->grid.free_cells(), 1u);
}

// What other tools write: JSON, lists that are broken into lines, a directive.
TEST(RosMap, may_be_in_braces_and_have_lists_over_several_lines) {
  source::MemoryFileSystem files;
  files.add("hall.pgm", "P2 2 1 255 254 0");
  files.add("dumped.yaml", "{image: hall.pgm, negate: 0, origin: [-1.0,\n    2.0, 0.0], resolution: 0.5}\n");
  files.add("json.yaml", "{\n  \"image\": \"hall.pgm\", # of today\n  \"origin\": [-1.0, 2.0, 0],\n  \"resolution\": 0.5\n}\n");
  files.add("lines.yaml", "%YAML 1.2\n---\nimage: hall.pgm\norigin: [ -1.0,   # x\n  2.0,\n  0 ]  # turned by\nresolution: 0.5\n");
  Reading reading;
  for (const char* const path : {"dumped.yaml", "json.yaml", "lines.yaml"}) {
    const auto map = reading.map(path, files);
    ASSERT_TRUE(map) << path << reading.said();
    EXPECT_EQ(map->grid.cell_m(), 0.5);
    EXPECT_EQ(map->grid.origin_m(), (Point{-1.0, 2.0}));
    EXPECT_TRUE(map->grid.free({0, 0}));
    EXPECT_TRUE(map->grid.blocked({1, 0}));
  }
}

// As map_server does: raw percents are of a white of 255, and what is occupied is not free, whichever threshold is the higher.
TEST(RosMap, sees_what_map_server_sees) {
  source::MemoryFileSystem files;
  files.add("raw.yaml", "image: raw.pgm\nresolution: 1\norigin: [0,0,0]\nmode: raw\n");
  files.add("raw.pgm", "P2 4 1 65535 0 5140 10280 30000");   // 0, 20, 40, 117
  files.add("low.yaml", "image: low.pgm\nresolution: 1\norigin: [0,0,0]\nfree_thresh: 0.5\noccupied_thresh: 0.2\n");
  files.add("low.pgm", "P2 2 1 100 90 70");
  Reading reading;
  const auto raw = reading.map("raw.yaml", files);
  ASSERT_TRUE(raw) << reading.said();
  for (const std::int32_t x : {0, 1, 2, 3}) EXPECT_EQ(raw->grid.free({x, 0}), x < 2) << x;
  const auto low = reading.map("low.yaml", files);
  ASSERT_TRUE(low) << reading.said();
  EXPECT_TRUE(low->grid.free({0, 0}));
  EXPECT_TRUE(low->grid.blocked({1, 0}));
}

TEST(RosMap, has_its_mistakes_told_where_they_stand) {
  const auto said = [](std::string yaml, std::string pgm) {
    source::MemoryFileSystem files;
    files.add("a.yaml", std::move(yaml));
    files.add("hall.pgm", std::move(pgm));
    Reading reading;
    EXPECT_FALSE(reading.map("a.yaml", files));
    return reading.said();
  };
  const std::string yaml(kYaml), image = "P2 1 1 255 0";
  EXPECT_EQ(said("image=hall.pgm\n", image), "KB1220 a.yaml:1:1");
  EXPECT_EQ(said("  nested: 1\n", image), "KB1220 a.yaml:1:3");
  EXPECT_EQ(said(yaml + "image: x\n", image), "KB1221 a.yaml:4:1");
  EXPECT_EQ(said("{image: hall.pgm, image: x}", image), "KB1221 a.yaml:1:19");
  EXPECT_EQ(said("{image: hall.pgm, origin: [0, 0\n", image), "KB1220 a.yaml:1:1");
  EXPECT_EQ(said("origin: [0, 0, 0] 1\nimage: hall.pgm\n", image), "KB1220 a.yaml:1:19");
  EXPECT_EQ(said("image: hall.pgm\nresolution: 1\n", image), "KB1222 -");
  EXPECT_EQ(said("image: hall.pgm\nresolution: fine\norigin: [0,0,0]\n", image), "KB1223 a.yaml:2:13");
  EXPECT_EQ(said("image: hall.pgm\nresolution: 1\norigin: [0,0]\n", image), "KB1223 a.yaml:3:1");
  EXPECT_EQ(said("image: hall.pgm\nresolution: 1\norigin: [0,0,0.3]\n", image), "KB1224 a.yaml:3:14");
  EXPECT_EQ(said("image: no.pgm\nresolution: 1\norigin: [0,0,0]\n", image), "KB0901 a.yaml:1:8");
  EXPECT_EQ(said(yaml + "mode: cubic\n", image), "KB1223 a.yaml:4:7");
  EXPECT_EQ(said(yaml + "negate: 0.5\n", image), "KB1223 a.yaml:4:9");
  EXPECT_EQ(said(yaml, "P6 1 1 255 0"), "KB1230 hall.pgm:1:1");
  EXPECT_EQ(said(yaml, "P5 1 x 255 0"), "KB1231 hall.pgm:1:6");
  EXPECT_EQ(said(yaml, "P5 1 99999999999999999999 255 0"), "KB1231 hall.pgm:1:6");
  EXPECT_EQ(said(yaml, "P5 20 20 255 abc"), "KB1232 hall.pgm:1:17");
  EXPECT_EQ(said(yaml, "P5 32766 32766 255 abc"), "KB1232 hall.pgm:1:23");
  EXPECT_EQ(said(yaml, "P5 1 1 50 z"), "KB1233 hall.pgm:1:11");
  EXPECT_EQ(said(yaml, "P2 2 1 255 100 "), "KB1232 hall.pgm:1:16");
  EXPECT_EQ(said(yaml, "P2 1 1 255 0\n# white\n 0"), "KB1234 hall.pgm:3:2");
  EXPECT_EQ(said(yaml, "P5 1 1 255 zz"), "KB1234 hall.pgm:1:13");
  EXPECT_EQ(said(yaml, "P5 1 1 65535 zzz"), "KB1234 hall.pgm:1:16");
}

TEST(Map, of_a_name_that_says_nothing_is_refused) {
  Reading reading;
  EXPECT_FALSE(reading.map("hall.png", source::MemoryFileSystem()));
  EXPECT_EQ(reading.said(), "KB1200 -");
}

TEST(Place, is_told_in_the_file_s_own_frame) {
  const Grid grid(4, 3, 0.5, {10.0, 20.0});
  EXPECT_EQ(grid.cell_at(*parse_place("1,0", grid, true)), (Cell{1, 2})) << "rows count from the top";
  EXPECT_EQ(*parse_place("10.7, 21.2", grid, false), (Point{10.7, 21.2}));
  EXPECT_FALSE(parse_place("1;2", grid, true));
  EXPECT_FALSE(parse_place("1,two", grid, true));
  EXPECT_FALSE(parse_place("nan,1", grid, false));
}

}  // namespace
}  // namespace kb::planners

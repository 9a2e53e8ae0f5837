// Writes the pages that the browser tests open, and what is true of them.
//
//   page_samples FOLDER
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "sim/report/report.h"
#include "tests/unit/sim_report/small_drive.h"

namespace {

using kb::sim::Recording;

void write(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
  std::printf("%s: %zu bytes\n", path.c_str(), text.size());
}

// The recording's own word, frame by frame, straight from the recording: nothing of sim/report is between.
std::string truth(const Recording& recording) {
  nlohmann::json frames = nlohmann::json::array();
  std::vector<float> values;
  for (const auto& cell : recording.names.cells) values.push_back(cell.initial);
  for (const auto& frame : recording.frames) {
    for (const auto& change : frame.changed) values[change.cell] = change.value;
    const std::string strategy = frame.strategy < 0 ? "" : recording.names.cells[static_cast<std::size_t>(frame.strategy)].name;
    nlohmann::json fired = nlohmann::json::array(), by_name = nlohmann::json::object();
    for (const auto rule : frame.fired) fired.push_back(recording.names.rules[rule].name);
    for (std::size_t i = 0; i < values.size(); ++i) by_name[recording.names.cells[i].name] = values[i];
    frames.push_back({{"t", frame.t_s}, {"strategy", strategy}, {"leg", frame.leg}, {"status", frame.status}, {"fired", fired}, {"values", by_name}, {"notes", frame.notes}});
  }
  return frames.dump();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::string folder = std::string(argv[1]) + "/";
  namespace report = kb::sim::report;
  namespace testing = kb::sim::testing;
  const Recording drive = testing::small_drive();
  write(folder + "drive.html", report::html(drive));
  write(folder + "drive.json", truth(drive));
  write(folder + "drive.svg", report::svg(drive));
  write(folder + "drive.trace.json", report::chrome_trace(drive));
  write(folder + "drive.csv", report::csv(drive));
  Recording floorless = drive;
  floorless.picture = {};
  floorless.legs.clear();
  write(folder + "floorless.html", report::html(floorless));
  write(folder + "long.html", report::html(testing::small_drive(1, 27)));
  write(folder + "nasty.html", report::html(testing::nasty_drive()));
  write(folder + "not_finite.html", report::html(testing::not_finite()));
  write(folder + "one.html", report::html(testing::one_frame()));
  write(folder + "empty.html", report::html({}));
}

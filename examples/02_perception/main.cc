// Route1's mind, fed by sensors: readings become facts, facts become decisions. The readings come from a recording here; on a
// robot they come from drivers, each whenever it has something new.
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "senses.kb.h"

namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line + ',');
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

/// A field is a new reading, nothing new (empty), or the end of all readings (`-`).
template <class Slot>
void take_number(Slot&& slot, const std::string& field, mts::Instant now) {
  if (field == "-") slot.forget();
  else if (!field.empty()) slot = mts::Reading{std::strtof(field.c_str(), nullptr), now};
}
template <class Slot>
void take_text(Slot&& slot, const std::string& field, mts::Instant now) {
  if (field == "-") slot.forget();
  else if (!field.empty()) slot = mts::TextReading{field.c_str(), now};
}

}  // namespace

int main(int argc, char** argv) {
  std::ifstream recording(argc > 1 ? argv[1] : EXAMPLE_FOLDER "/drive.readings.csv");
  std::string line;
  if (!std::getline(recording, line)) return std::cerr << "cannot read the recording\n", 1;

  senses::Readings readings;
  senses::Perception perception;
  senses::Mind mind;
  std::uint64_t ticks = 0, fits = 0;
  mts::Sight worst = mts::Sight::kClear;
  while (std::getline(recording, line)) {
    const std::vector<std::string> fields = split(line);
    const mts::Instant now{static_cast<std::int64_t>(std::strtod(fields[0].c_str(), nullptr) * 1e6 + 0.5)};
    for (std::uint32_t i = 0; i < 5; ++i) take_number(readings.line[i], fields[3 + i], now);
    for (std::uint32_t i = 0; i < 8; ++i) take_number(readings.range[i], fields[8 + i], now);
    take_number(readings.compass, fields[16], now);
    take_text(readings.tag, fields[17], now);
    take_text(readings.memory, fields[18], now);

    senses::Facts& facts = perception.facts();
    facts.Start1 = std::strtof(fields[1].c_str(), nullptr);        // a button is no matter of perception
    facts.Track.azimuth = std::strtof(fields[2].c_str(), nullptr);
    perception.look(readings, now, mind);                          // after what is given: perceived facts may be defined by it
    const bool drove = mind.decision().drives();
    const auto before = drove ? mind.decision().strategy() : senses::Strategy{};
    const senses::Decision decision = mind.tick(facts, mts::milliseconds(200));

    ++ticks;
    fits += perception.report().fits;
    if (perception.report().sight > worst) worst = perception.report().sight;
    if (decision.drives() == drove && (!drove || decision.strategy() == before)) continue;
    std::cout << fields[0] << " s  " << (decision.drives() ? senses::name(decision.strategy()) : "stop") << '\n';
  }
  std::cout << ticks << " ticks, " << fits << " readings held against a prototype, the worst of them: " << mts::text(worst) << '\n';
}

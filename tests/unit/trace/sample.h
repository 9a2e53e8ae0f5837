// A small knowledge base, by hand, and what is said about facts that are read for it.
#pragma once

#include <string>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "tests/unit/program/program_builder.h"
#include "tools/kbc/trace/facts_csv.h"

namespace kb::trace::testing {

/// A robot that goes from a start button to a gate, and stands there until it is safe.
inline program::Program sample_program() {
  using namespace program::testing;
  ProgramBuilder b({"goal", "drive", "control"});
  b.fact("Start", 1.0f).fact("Line").fact("Safe").fact("In.N").fact("In.S").fact("Near[left,far]").fact("Abort");
  b.satellite("Driving").satellite("Gate").satellite("Far");
  b.exclusive({"Driving", "Gate"});
  b.strategy("Stop").strategy("Move").of("Gate", "Stop").of("Driving", "Move");
  b.when("obey", "goal", all({event("Start"), no(high("Driving"))}), {raise("Driving"), lower("sat Start")});
  b.while_true("abort", "goal", high("Abort"), {reset_all()});
  b.when("wait", "drive", all({seen("Line"), high("Driving"), no(high("Safe"))}), {raise("Gate")});
  b.when("pass[N]", "drive", all({high("Gate"), high("Safe"), held(high("In.N"), 200'000)}), {raise("Driving")});
  b.when("pass[S]", "drive", all({high("Gate"), high("Safe"), any({high("In.S"), low("Near[left,far]")})}),
         {raise("Driving"), raise("Far")});
  return b.build();
}

/// Keeps what is reported, as `KB0926 4:7-10 text`.
class Said final : public diagnostics::Consumer {
 public:
  explicit Said(const source::Sources& sources) : sources_(sources) {}
  void consume(const diagnostics::Diagnostic& d) override {
    std::string text = diagnostics::code_text(d.kind) + " ";
    if (d.span.known()) {
      const auto place = sources_.locate(d.span.file, d.span.begin);
      text += std::to_string(place.line) + ":" + std::to_string(place.column) + "-" +
              std::to_string(place.column + d.span.end - d.span.begin) + " ";
    }
    text += d.message;
    if (!d.suggestion.empty()) text += " (" + d.suggestion + "?)";
    all.push_back(text);
  }
  std::vector<std::string> all;

 private:
  const source::Sources& sources_;
};

/// A reader over bytes in memory.
struct Reading {
  explicit Reading(std::string_view bytes, std::size_t chunk = SIZE_MAX)
      : stream(bytes, chunk),
        said(sources),
        diagnostics(sources, said),
        reader("in.csv", stream, program, sources, diagnostics) {}
  Reading(const Reading&) = delete;
  /// The facts of every row, only the named ones that are not 0: "Line=0.9 Safe=1".
  std::vector<std::string> rows();

  program::Program program = sample_program();
  MemoryStream stream;
  source::Sources sources;
  Said said;
  diagnostics::Diagnostics diagnostics;
  FactsReader reader;
};

}  // namespace kb::trace::testing

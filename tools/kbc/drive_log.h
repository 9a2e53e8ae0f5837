// What `kbc drive` writes down.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "compiler/program/program.h"
#include "compiler/program/tick.h"
#include "tools/kbc/support.h"
#include "tools/kbc/trace/output_file.h"

namespace kb::cli {

/// `# kb: FILE` as `kbc test` reads it at the head of facts: the knowledge base, seen from where they will lie. Empty where that cannot be said.
[[nodiscard]] std::string knowledge_comment(const std::string& facts, const std::string& knowledge);

/// note [files that grow]
/// A drive may take hours, and end with the battery. So its files grow beside their places, line by line, and get their names when the drive ends: what
/// stood there before stays until then, and of a drive that did not end so the file beside is left. One that cannot be written any more is told of
/// at once; what it has is left, and the robot drives on.
class DriveLog {
 public:
  struct Names { std::string record, facts, trace; };   ///< empty: not wanted

  /// All must outlive it.
  DriveLog(const Names& names, const program::Program& program, Session& session)
      : program_(program), session_(session), record_{names.record}, facts_{names.facts}, trace_{names.trace} {}
  DriveLog(const DriveLog&) = delete;
  DriveLog& operator=(const DriveLog&) = delete;
  /// False if one of the files cannot be made (reported). `knowledge`: the file of the knowledge base.
  [[nodiscard]] bool open(const std::string& knowledge);

  /// A tick, as the trace has it too, and the facts that it was told.
  void ticked(const program::Tick& tick, std::string_view json, std::span<const float> facts);
  /// A line and the answer to it. What was not understood stays as it was heard. Writes to the disk, which may be slow: to be called when the
  /// answer is on its way.
  void heard(std::string_view line, std::string_view answer, bool understood);
  /// Gives the files their names. False if anything could not be written (reported).
  [[nodiscard]] bool end();

 private:
  struct Part {
    const std::string& name;
    std::unique_ptr<trace::OutputFile> file{};
  };
  [[nodiscard]] bool open(Part& part);
  void report(const Part& part);

  const program::Program& program_;
  Session& session_;
  Part record_, facts_, trace_;
  Part* const parts_[3] = {&record_, &facts_, &trace_};
  bool good_ = true;
};

}  // namespace kb::cli

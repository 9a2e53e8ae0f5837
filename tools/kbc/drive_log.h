// The files that `kbc drive` writes.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "compiler/program/program.h"
#include "compiler/program/tick.h"
#include "tools/kbc/support.h"
#include "tools/kbc/trace/output_file.h"

namespace kb::cli {

/// `# kb: FILE` as `kbc test` reads it at the head of a file of facts: the path of the knowledge base relative to that file. Empty if
/// there is no such path.
[[nodiscard]] std::string knowledge_comment(const std::string& facts, const std::string& knowledge);

/// note [files that grow]
/// A drive may take hours, and end when the battery does. So its files grow under temporary names, line by line, and get their names
/// when the drive ends. Older files stay until then, and if the drive ends otherwise, the temporary files are left. A file that can no
/// longer be written is reported at once; its contents are left, and the robot drives on. Who rotates logs sends SIGHUP: then they grow under
/// their names, and each time are opened anew.
class DriveLog {
 public:
  struct Names { std::string record, facts, trace, messages; };   ///< empty: not wanted

  /// All must outlive it.
  DriveLog(const Names& names, const program::Program& program, Session& session)
      : program_(program), session_(session), record_{names.record}, facts_{names.facts}, trace_{names.trace}, messages_{names.messages} {}
  DriveLog(const DriveLog&) = delete;
  DriveLog& operator=(const DriveLog&) = delete;
  /// False if one of the files cannot be made (reported). `knowledge`: the file of the knowledge base.
  [[nodiscard]] bool open(const std::string& knowledge);

  /// Where what passes between a master and the vehicle is written to; null if that is not wanted.
  [[nodiscard]] trace::OutputFile* messages() const { return messages_.file.get(); }
  /// Records a tick, `json` being its line of the trace, and the facts that it was given.
  void ticked(const program::Tick& tick, std::string_view json, std::span<const float> facts);
  /// Records a line and the answer to it. A line that was not understood is kept as it came. Keeps everything.
  void heard(std::string_view line, std::string_view answer, bool understood);
  /// Writes to the disk, which may be slow: call it when the answer has been sent. A file that cannot be written is reported.
  void keep();
  /// Opens the files anew under their names. What cannot be opened is reported.
  void reopen();
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
  Part record_, facts_, trace_, messages_;
  Part* const parts_[4] = {&record_, &facts_, &trace_, &messages_};
  std::string head_;   // of the facts
  bool good_ = true;
};

}  // namespace kb::cli

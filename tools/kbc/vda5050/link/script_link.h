// Messages of a master that somebody has written down before, and writing down those that pass.
//
// note [a script of messages]
// A file of lines, each an object: `{"t": 12.5, "topic": "order", "message": {...}}`. `t` is in seconds of the robot's clock and does not fall.
// `message` is what comes, just as it stands there; a string is what comes where that is no JSON. `from` says who sent it, `master` or `vehicle`:
// a recording has both, and is a script as it is, because what a vehicle said is passed over.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/source/source.h"
#include "tools/kbc/trace/output_file.h"
#include "tools/kbc/vda5050/message.h"

namespace kb::vda5050 {

/// A message, and when it comes, by the robot's clock.
struct ScriptMessage {
  std::int64_t t_us = 0;
  Message message;
};

/// The master's messages of `path`, in its order. Nothing if it cannot be read, or a line of it is wrong (reported, each line). O(bytes).
[[nodiscard]] std::optional<std::vector<ScriptMessage>> read_script(const std::string& path, const source::FileSystem& files, source::Sources& sources,
                                                                    diagnostics::Diagnostics& diagnostics);

/// Gives each message when its time has come. What is sent nobody hears. UTC is the robot's clock, counted from 1970, so that a drive prints the same
/// bytes on every day.
class ScriptLink final : public Link {
 public:
  /// By time, ascending.
  explicit ScriptLink(std::vector<ScriptMessage> messages) : messages_(std::move(messages)) {}

  [[nodiscard]] std::optional<Message> next(std::int64_t t_us) override;
  void send(const Message& /*message*/, std::int64_t /*t_us*/) override {}
  [[nodiscard]] std::int64_t utc_us(std::int64_t t_us) override { return t_us; }
  [[nodiscard]] bool live() const override { return false; }

 private:
  std::vector<ScriptMessage> messages_;
  std::size_t given_ = 0;
};

/// A line of a script, with line break. `from`: `master` or `vehicle`.
[[nodiscard]] std::string print_script_line(std::int64_t t_us, std::string_view from, const Message& message);

/// A link whose messages are written down as well, both ways, when they pass.
class Recorder final : public Link {
 public:
  /// `file` is open, and must outlive it. It is written to, neither flushed nor committed.
  Recorder(std::unique_ptr<Link> link, trace::OutputFile& file) : link_(std::move(link)), file_(file) {}

  [[nodiscard]] std::optional<Message> next(std::int64_t t_us) override;
  void send(const Message& message, std::int64_t t_us) override;
  [[nodiscard]] std::int64_t utc_us(std::int64_t t_us) override { return link_->utc_us(t_us); }
  [[nodiscard]] bool live() const override { return link_->live(); }
  [[nodiscard]] std::string news() override { return link_->news(); }

 private:
  std::unique_ptr<Link> link_;
  trace::OutputFile& file_;
};

}  // namespace kb::vda5050

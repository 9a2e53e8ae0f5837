// A master's messages from a script file, and the recording of messages that pass.
//
// note [a script of messages]
// A file of lines, each an object: `{"t": 12.5, "topic": "order", "message": {...}}`. `t` is in seconds of the robot's clock and does not
// fall. `message` is the message as it stands there; a string stands for a message that is not JSON. `from` is the sender, `master` or
// `vehicle`. A recording has messages of both and can serve as a script, because those of the vehicle are ignored.
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

/// A message and the time of its arrival by the robot's clock.
struct ScriptMessage {
  std::int64_t t_us = 0;
  Message message;
};

/// The master's messages in the file `path`, in order. Nothing if it cannot be read, or a line of it is wrong (reported, each line).
/// O(bytes).
[[nodiscard]] std::optional<std::vector<ScriptMessage>> read_script(const std::string& path, const source::FileSystem& files, source::Sources& sources,
                                                                    diagnostics::Diagnostics& diagnostics);

/// Gives each message when its time has come, and discards what is sent. UTC is the robot's clock, counted from 1970, so that a drive prints
/// the same bytes on every day.
class ScriptLink final : public Link {
 public:
  /// `messages` must be ascending by time.
  explicit ScriptLink(std::vector<ScriptMessage> messages) : messages_(std::move(messages)) {}

  [[nodiscard]] std::optional<Message> next(std::int64_t t_us) override;
  void send(const Message& /*message*/, std::int64_t /*t_us*/) override {}
  [[nodiscard]] std::int64_t utc_us(std::int64_t t_us) override { return t_us; }
  [[nodiscard]] bool live() const override { return false; }

 private:
  std::vector<ScriptMessage> messages_;
  std::size_t given_ = 0;
};

/// A line of a script with its line break. `from`: `master` or `vehicle`.
[[nodiscard]] std::string print_script_line(std::int64_t t_us, std::string_view from, const Message& message);

/// A link that records its messages in both directions as they pass.
class Recorder final : public Link {
 public:
  /// `file` must be open and outlive it. It is written to, but neither flushed nor committed.
  Recorder(std::unique_ptr<Link> link, trace::OutputFile& file) : link_(std::move(link)), file_(file) {}

  [[nodiscard]] std::optional<Message> next(std::int64_t t_us) override;
  void send(const Message& message, std::int64_t t_us) override;
  [[nodiscard]] std::int64_t utc_us(std::int64_t t_us) override { return link_->utc_us(t_us); }
  [[nodiscard]] bool live() const override { return link_->live(); }
  [[nodiscard]] bool connected_anew() override { return link_->connected_anew(); }
  [[nodiscard]] std::string news() override { return link_->news(); }

 private:
  std::unique_ptr<Link> link_;
  trace::OutputFile& file_;
};

}  // namespace kb::vda5050

// A program that drives: started by the shell, connected by pipes, and ended by the destructor.
#pragma once

#include <sys/types.h>

#include <memory>
#include <string>

#include "tools/kbc/wire/line_channel.h"

namespace kb::wire {

class DriverProcess {
 public:
  /// Starts `/bin/sh -c command` in a process group of its own; its standard error is ours. `error` says why if it cannot be started.
  /// `stop`: see LineChannel.
  static std::unique_ptr<DriverProcess> start(const std::string& command, bool (*stop)(), std::string& error);
  /// Closes its standard input, gives it five seconds to end, or one after a failure or where `stop` says so, then asks it to end, then kills it and all that it has started, except processes
  /// that have left its process group, as daemons do.
  ~DriverProcess();
  DriverProcess(const DriverProcess&) = delete;
  DriverProcess& operator=(const DriverProcess&) = delete;

  [[nodiscard]] LineChannel& channel() { return channel_; }
  /// It does not do what is expected of it.
  void fail() { failed_ = true; }
  /// `exit code 1`, `signal 9`; waits for its end as the destructor does. Use it when the process no longer answers.
  [[nodiscard]] std::string end();

 private:
  DriverProcess(::pid_t id, int in, int out, bool (*stop)()) : id_(id), in_(in), out_(out), channel_(in, out, stop) {}
  [[nodiscard]] bool ends_within(int ms) const;

  ::pid_t id_;
  int in_, out_;
  int status_ = 0;
  bool ended_ = false, failed_ = false;
  LineChannel channel_;
};

}  // namespace kb::wire

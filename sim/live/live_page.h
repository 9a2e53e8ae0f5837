// The page of a drive that is still going on, served to a browser on this machine, with sliders and buttons that act on the drive.
//
//   LivePage page(recording);                       // title, picture and names are there, frames may be
//   if (!page.start(8080)) ...;                     // http://127.0.0.1:8080/
//   while (drive.step()) {
//     page.append(recording);
//     for (const Command& command : page.commands()) obey(command);
//   }
//   page.finish(recording);
//
// Whoever may use this machine may open the page: it binds to 127.0.0.1 alone, answers only requests that name it by
// `127.0.0.1` or `localhost` (so no page from elsewhere reaches it by a name of its own), and takes commands only as JSON,
// which a form of another page cannot send. There is no other protection; do not forward the port.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/recording.h"

namespace kb::sim {

/// What somebody asked for with a slider or a button of the page.
struct Command {
  enum class What : std::uint8_t { kCloseRoad, kOpenRoad, kPress, kPause, kResume } what{};
  std::string name;   ///< a road of the picture, a command of the names; "" for kPause and kResume
};

/// Threads: `start`, `append`, `commands`, `finish` and the destructor belong to the simulation's thread; the server answers on
/// threads of its own and sees copies. What a browser has not fetched yet is kept as it was given: memory is that of the
/// recording, once more.
class LivePage {
 public:
  /// Takes what is fixed for the drive, and the frames there are.
  explicit LivePage(const Recording& recording);
  /// Stops serving; open requests are ended.
  ~LivePage();
  LivePage(const LivePage&) = delete;
  LivePage& operator=(const LivePage&) = delete;

  /// Serves from now on. `port` 0 takes one that is free. False if the port cannot be had; nothing is served then.
  [[nodiscard]] bool start(std::uint16_t port);
  /// The port that is served on, 0 if none is.
  [[nodiscard]] std::uint16_t port() const;

  /// The frames of `recording` that are new since the last call; its stays and outcome as they are. O(new frames + stays).
  void append(const Recording& recording);
  /// The same, and tells the pages that no more will come.
  void finish(const Recording& recording);

  /// What was asked for since the last call, in order. Names are those of the recording; what names nothing was refused.
  [[nodiscard]] std::vector<Command> commands();

 private:
  struct Server;
  std::unique_ptr<Server> server_;
};

}  // namespace kb::sim

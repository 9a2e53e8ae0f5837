// The page of a drive in progress, served to a browser on this machine, with sliders and buttons that act on the drive.
//
//   LivePage page(recording);                       // has title, picture and names already, perhaps frames
//   if (!page.start(8080)) ...;                     // http://127.0.0.1:8080/
//   while (drive.step()) {
//     page.append(recording);
//     for (const Command& command : page.commands()) obey(command);
//   }
//   page.finish(recording);
//
// Every user of this machine may open the page. It binds only to 127.0.0.1, answers only requests addressed to `127.0.0.1` or
// `localhost` (so no foreign page can reach it under a host name of its own), and takes commands only as JSON, which a form on
// another page cannot send. A connection that falls silent is ended after two seconds. There is no other protection: whoever sends a byte a
// second on some thirty connections keeps others from the page, though not the drive from its end. Do not forward the port.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/recording.h"

namespace kb::sim {

/// A command given with a slider or a button of the page.
struct Command {
  enum class What : std::uint8_t { kCloseRoad, kOpenRoad, kPress, kPause, kResume } what{};
  std::string name;   ///< a road of the picture, a command of the names; "" for kPause and kResume
};

/// Threads: `start`, `append`, `commands`, `finish` and the destructor belong to the simulation's thread; the server answers on
/// threads of its own and sees copies. What browsers have not fetched yet is kept as it was given, which takes as much memory
/// again as the recording.
class LivePage {
 public:
  /// Takes what is fixed for the drive, and the frames so far.
  explicit LivePage(const Recording& recording);
  /// Stops serving; open requests are ended.
  ~LivePage();
  LivePage(const LivePage&) = delete;
  LivePage& operator=(const LivePage&) = delete;

  /// Starts serving. `port` 0 takes a free one. False if the port is not available; then nothing is served.
  [[nodiscard]] bool start(std::uint16_t port);
  /// The port served on; 0 if not serving.
  [[nodiscard]] std::uint16_t port() const;

  /// The frames of `recording` that are new since the last call; its stays and outcome are sent as they now are. O(new frames + stays).
  void append(const Recording& recording);
  /// The same, and tells the pages that no more will come.
  void finish(const Recording& recording);

  /// The commands since the last call, in order. Names are those of the recording; a command with an unknown name was refused.
  [[nodiscard]] std::vector<Command> commands();

 private:
  struct Server;
  std::unique_ptr<Server> server_;
};

}  // namespace kb::sim

#include "tools/kbc/trace/graphviz.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>

extern char** environ;

namespace kb::trace {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
// Temporary files without a name, for input and output. They vanish with the last descriptor, and unlike pipes they cannot fill up.
using File = std::unique_ptr<std::FILE, CloseFile>;

std::string read_all(std::FILE* file) {
  std::string out;
  std::array<char, 65536> buffer{};
  std::rewind(file);
  while (const std::size_t got = std::fread(buffer.data(), 1, buffer.size(), file)) out.append(buffer.data(), got);
  return out;
}

}  // namespace

Drawing draw_svg(std::string_view graph) {
  const File input(std::tmpfile()), output(std::tmpfile()), errors(std::tmpfile());
  if (!input || !output || !errors)
    return {.outcome = Drawing::Outcome::kFailed, .svg = {}, .error = "no temporary file can be made"};
  std::fwrite(graph.data(), 1, graph.size(), input.get());
  if (std::fflush(input.get()) != 0)
    return {.outcome = Drawing::Outcome::kFailed, .svg = {}, .error = "no space left for a temporary file"};
  std::rewind(input.get());

  ::posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, ::fileno(input.get()), STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, ::fileno(output.get()), STDOUT_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, ::fileno(errors.get()), STDERR_FILENO);
  std::string program = "dot", format = "-Tsvg";
  std::array<char*, 3> arguments{program.data(), format.data(), nullptr};
  ::pid_t child = 0;
  const int spawned = ::posix_spawnp(&child, "dot", &actions, nullptr, arguments.data(), ::environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (spawned == ENOENT) return {.outcome = Drawing::Outcome::kNotInstalled, .svg = {}, .error = {}};
  if (spawned != 0) return {.outcome = Drawing::Outcome::kFailed, .svg = {}, .error = "it cannot be started"};

  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {}
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127)
    return {.outcome = Drawing::Outcome::kNotInstalled, .svg = {}, .error = {}};
  Drawing drawing{.outcome = Drawing::Outcome::kDrawn, .svg = read_all(output.get()), .error = read_all(errors.get())};
  drawing.error = drawing.error.substr(0, drawing.error.find('\n'));
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || drawing.svg.empty())
    drawing.outcome = Drawing::Outcome::kFailed;
  if (drawing.error.empty()) drawing.error = "it said nothing";
  return drawing;
}

}  // namespace kb::trace

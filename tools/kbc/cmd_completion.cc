// kbc completion: made from the table of commands and what CLI11 knows of their options, so that it cannot drift.
#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tools/kbc/completion.h"

namespace kb::cli {
namespace {

struct Shell {
  std::string_view name;
  std::string (*print)(const CommandLine&);
};
constexpr std::array kShells{Shell{"bash", bash_completion}, Shell{"fish", fish_completion}, Shell{"zsh", zsh_completion}};

}  // namespace

Run setup_completion(CLI::App& app) {
  auto asked = std::make_shared<std::string>();
  std::vector<std::string> names;
  for (const Shell& shell : kShells) names.emplace_back(shell.name);
  app.add_option("SHELL", *asked, "The shell that is to complete")->required()->check(CLI::IsMember(names));
  return [asked](Session& session) {
    for (const Shell& shell : kShells) {
      if (shell.name == *asked) session.print(shell.print(CommandLine()));
    }
    return session.exit_code();
  };
}

}  // namespace kb::cli

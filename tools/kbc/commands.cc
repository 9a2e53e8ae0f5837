#include "tools/kbc/commands.h"

#include <array>

namespace kb::cli {
namespace {

constexpr std::array kCommands = {
    Command{"compile", "Compile a knowledge base to C++",
            "Writes NAME.kb.h, the typed interface to include, and NAME.kb.cc, the tables. Both appear together or not at "
            "all: after an error, when the disk is full, or when one of them cannot be replaced, what was there before is untouched. Only "
            "if kbc is killed just while it moves them to their places, one may be new and the other old. In CMake, "
            "`kb_add_library(mission mission.kb)` calls this.",
            "kbc compile mission.kb                          # mission.kb.h and mission.kb.cc here\n"
            "kbc compile mission.kb --out generated          # in a folder, which is made\n"
            "kbc compile mission.kb -o gen/m --namespace m   # gen/m.h and gen/m.cc, in namespace m\n"
            "kbc compile mission.kb --fleet                  # mission.kb.fleet.h and .cc as well, for many robots at once\n"
            "kbc compile mission.kb --emit json -o -         # the program as JSON, to standard output\n"
            "kbc compile mission.kb --emit image             # mission.kbt, which a running robot can take\n",
            Shared::kCompiles, setup_compile},
    Command{"check", "Say what is wrong with knowledge bases",
            "Reads, resolves and analyses, and makes nothing. Silent if all is well. Name the main files; a file that is a part of one, and uses what others declare, "
            "is checked with it, and not by itself.",
            "kbc check mission.kb                            # errors and warnings\n"
            "kbc check -Werror -Wno-never-read mission.kb    # for a build server: warnings are errors, but for one kind\n"
            "kbc check --diagnostics-format sarif mission.kb 2> mission.sarif\n",
            Shared::kCompiles, setup_check},
    Command{"run", "Feed facts to a knowledge base and see what it decides",
            "Facts are CSV: a header of the facts' names (and perhaps `t`, a time in seconds), then one row for each tick. An empty "
            "field means \"no data\" (in a file of one column `\"\"`; an empty line is no row). After a line `# empty: as before, every: 100 ms` it repeats the row before, and ticks are filled in between "
            "rows, so a drive written by hand needs only a row for each change. With --readings an empty field of a sensor means \"nothing new\": the last reading stays and, if the sensor has "
            "`stale`, grows old, also on ticks that are filled in; after `# empty: measured again, every: 100 ms` it is measured again on each tick. Memory grows with the number of ticks only with --table.",
            "kbc run mission.kb --facts drive.csv --trace drive.jsonl   # a line of JSON a tick\n"
            "kbc run mission.kb --facts drive.csv --table               # cells by ticks, for people\n"
            "kbc run mission.kb --facts drive.csv --conflicts           # which rules contradicted each other, and how often\n"
            "kbc run mission.kb --facts - --dt 10ms < drive.csv         # from a pipe, a tick each 10 ms\n",
            Shared::kCompiles, setup_run},
    Command{"test", "Compare golden traces with what happens now",
            "A case is a file NAME.facts.csv or NAME.readings.csv beside a knowledge base; NAME.trace.jsonl holds the expected trace. "
            "If the knowledge base is elsewhere, or is one of several, the first line of the case names it, relative to the case's "
            "folder: `# kb: ../mission.kb`. `kbc sim --facts` writes that line. After `# compare: strategy status` only these keys of a trace are compared, and kept; "
            "so a rule may get another name.",
            "kbc test tests                                  # all cases in a folder and below\n"
            "kbc test tests --filter 'detour*'               # those with such names\n"
            "kbc test tests --update                         # accept what happens now, then look at the difference\n"
            "kbc test tests --coverage                       # which of your rules, landmarks, events were exercised\n"
            "kbc test tests --junit results.xml              # for a build server\n",
            Shared::kCompiles, setup_test},
    Command{"why", "Say why a rule, a cell or a strategy did what it did at a tick",
            "Without a question it lists what fired at the tick, and what ran.",
            "kbc why mission.kb --facts drive.csv --rule enter                    # when it fired; or, if never, how near it came\n"
            "kbc why mission.kb --facts drive.csv --strategy Stop                 # on which ticks it ran, and why on the first\n"
            "kbc why mission.kb --facts drive.csv --tick 14                       # the tick as a whole\n"
            "kbc why mission.kb --facts drive.csv --tick 14 --rule enter          # why it fired, or what was lacking\n"
            "kbc why mission.kb --facts drive.csv --tick 14 --cell Gate           # who wrote it last\n"
            "kbc why mission.kb --facts drive.csv --tick 14 --strategy Move.mark  # why it ran, or not\n",
            Shared::kCompiles, setup_why},
    Command{"diff", "Say which decisions change from one knowledge base to another, on a recorded drive",
            "Feeds the same facts, or readings, to both, side by side, and prints the ticks at which they decide differently: the strategy, the "
            "rules that fired in one only (-, +), and satellites that begin to differ. Then it lists where their maps differ, and whether the "
            "drive comes there. Things are matched by name. Exit code 0: all decisions are the same; 1: some differ, or there were errors (reported).",
            "kbc diff old.kb new.kb --facts drive.csv            # would the robot have driven otherwise?\n"
            "kbc diff old.kb new.kb --readings drive.csv         # the same, where sensors were recorded\n"
            "kbc diff robot.kbt new.kb --facts drive.csv --json  # the image that runs on it against what is to come\n",
            Shared::kCompiles, setup_diff},
    Command{"tidy", "Mend a recording that a robot left half written or out of order",
            "Copies facts or readings (CSV), or JSON lines of `kbc drive`, and leaves out, or moves, rows that `kbc run` would refuse: a last row that "
            "was half written when the power went, rows of a clock that was set back. Says which rows it has changed. What is wrong in another way stays as it is.",
            "kbc tidy drive.csv -o whole.csv                     # without a half last row, and without rows that go back in time\n"
            "kbc tidy drive.csv -o whole.csv --clock shift       # after a restart of the recorder, time goes on\n"
            "kbc tidy drive.csv -o whole.csv --clock sort        # rows that overtook one another\n",
            Shared::kWarns, setup_tidy},
    Command{"explain", "Describe a message at length, with a wrong and a right example",
            "Takes a code from the end of a message, or the name of a warning.",
            "kbc explain KB0101                              # one message\n"
            "kbc explain never-read                          # a warning by its name\n"
            "kbc explain -Wnever-read                        # the same, as messages have it\n"
            "kbc explain --list                              # all of them, a line each\n"
            "kbc explain --markdown > diagnostics.md         # all of them, as a page\n",
            Shared::kMessages, setup_explain},
    Command{"expand", "Print the core rules that a knowledge base becomes",
            "Shows what the engine does, in the notation of the language: every rule for each of its instances, with names in "
            "full. Exclusive groups and `reset` stand as they are written. It is to be read, and cannot be compiled again.",
            "kbc expand mission.kb                           # everything\n"
            "kbc expand mission.kb --rule enter              # the instances of one rule\n"
            "kbc expand mission.kb --level passage           # one level\n"
            "kbc expand mission.kb --cell Gate               # the rules that write a cell, then those that read it\n"
            "kbc expand mission.kb --cell 'Say.* Gate'       # of several cells; a group means all of its members\n",
            Shared::kCompiles, setup_expand},
    Command{"dump", "Print what the compiler holds after each phase",
            "Prints one item on each line, in an order that does not change from run to run.",
            "kbc dump tokens mission.kb                      # of this file alone, as is `tree`\n"
            "kbc dump names mission.kb                       # every name: what it is, and where it is declared\n"
            "kbc dump model mission.kb                       # names resolved, imports included\n"
            "kbc dump program --json mission.kb              # for other tools; see docs/program_json.md\n",
            Shared::kCompiles, setup_dump},
    Command{"budget", "Say what a knowledge base costs on the robot",
            "Prints the sizes of tables and state in bytes, and how many rules one tick can touch at most.",
            "kbc budget mission.kb                           # for people\n"
            "kbc budget --json mission.kb                    # for programs\n",
            Shared::kCompiles, setup_budget},
    Command{"graph", "Draw the map, or the levels of rules",
            "Writes the DOT language of Graphviz, or SVG if `dot` is installed.",
            "kbc graph mission.kb > map.dot                  # landmarks, roads, routes, detours\n"
            "kbc graph mission.kb --format svg -o map.svg    # drawn\n"
            "kbc graph mission.kb --levels > levels.dot      # which level writes what, and which reads it\n",
            Shared::kCompiles, setup_graph},
    Command{"plot", "Draw a fuzzy controller, or a prototype",
            "Writes SVG. `fuzzy` draws the membership functions of a controller, and one of its outputs over one or two inputs; the other "
            "inputs have the values that --at gives them, or the middle of their ranges. `prototype` draws how well readings fit a "
            "prototype, and which certainty a fact gets from that.",
            "kbc plot fuzzy mission.kb -o fuzzy.svg          # the only controller, its first inputs, its first output\n"
            "kbc plot fuzzy mission.kb GoToGoal --x bearing --y 'free[0]' --of turn --at 'free[1]=1' -o turn.svg\n"
            "kbc plot prototype senses.kb near -o near.svg   # fresh and old readings against the word `near`\n",
            Shared::kCompiles, setup_plot},
    Command{"import", "Take over a layout or a fuzzy controller written for another program",
            "Layouts of plants become maps: LIF of the VDMA, route graphs of Nav2 (GeoJSON), plant models of openTCS. With --route "
            "or --order the map gets a mission, which the simulator can drive; with --trim it has only the mission's roads. FLL, the "
            "language of fuzzylite 6, becomes a fuzzy controller. What cannot be converted is reported; if that is an error, nothing is written.",
            "kbc import nav2 graph.geojson -o plant.kb        # a map: a landmark for each node, a road for each edge\n"
            "kbc import lif plant.json --layout Ground --route Dock,Press -o mission.kb && kbc sim mission.kb --html drive.html\n"
            "kbc import lif plant.json --order order.json -o order.kb   # what is released of an order of VDA 5050\n"
            "kbc import opentcs plant.xml --by azimuth        # its roads are not painted\n"
            "kbc import fll engine.fll -o engine.kb\n",
            Shared::kCompiles, setup_import},
    Command{"export", "Write a fuzzy controller or a map for another program",
            "Writes FLL, the language of fuzzylite 6: if FLL cannot express something, that is reported and nothing is written. Or a map as LIF 1.0, "
            "the Layout Interchange Format of the VDMA: landmarks are nodes, roads are edges by the names that orders of a master use, `Mill.N`.",
            "kbc export fll mission.kb -o engine.fll\n"
            "kbc export fll mission.kb GoToGoal -o engine.fll\n"
            "kbc export lif plant.kb --vehicle Acme.Tug -o plant.json        # for a fleet's master\n",
            Shared::kCompiles, setup_export},
    Command{"plan", "Find paths on a map, by any of the planners",
            "Reads a MovingAI .map or the .yaml of a ROS map. Prints whether the goal was reached and how long the path is. A separate "
            "check walks along each path before it counts as reached. The same map, question and seed give the same answer.",
            "kbc plan hall.map --from 3,4 --to 40,21                                # one path, by the neural map\n"
            "kbc plan hall.map --from 3,4 --to 40,21 --method fairway --svg way.svg  # with a picture\n"
            "kbc plan hall.map --scen hall.map.scen --method neural --csv out.csv   # all rows of a benchmark\n"
            "kbc plan hall.map --from 3,4 --to 40,21 --compare --svg all.svg        # all methods side by side\n"
            "kbc plan --list                                                        # what there is\n",
            Shared::kWarns, setup_plan},
    Command{"sim", "Let a knowledge base drive a robot through its own map",
            "The map becomes a floor with lines, walls and tags; a robot with noisy sensors drives on it, and the compiled "
            "knowledge base decides. A scenario says where it begins and what goes wrong. Says how it ended, how long it "
            "took, and whether the robot hit anything or was lost without knowing it.",
            "kbc sim mission.kb                                              # presses the first command\n"
            "kbc sim mission.kb --scenario closed.toml --trace drive.jsonl   # a line of JSON a tick, as `kbc run` writes it\n"
            "kbc sim mission.kb --facts drive.facts.csv                      # what it was told, for `kbc why`, `kbc test`, `kbc diff`\n"
            "kbc sim mission.kb --seed 7                                     # other noise\n"
            "kbc sim mission.kb --scenario closed.toml --expect arrived      # exit code 1 if it does not\n"
            "kbc sim mission.kb --html drive.html                            # a page that plays the drive\n"
            "kbc sim mission.kb --driver \"python3 follow.py\"                # a program of your own at the wheel\n",
            Shared::kCompiles, setup_sim},
    Command{"drive", "Let a knowledge base drive a robot of your own, line by line",
            "Reads a line of JSON with senses for each control period, answers each with one line: `speed` in m/s and `turn` in rad/s, and "
            "what the mind decided. Perception, controllers and mind are those of `kbc sim`. A line that cannot be read is answered with wheels 0 and "
            "an error, and the mission goes on; the exit code is then 1. After a pause longer than --pause the robot stands until a button is pressed. "
            "Until the drive ends, files are written under the name FILE with six letters appended. docs/driving.md explains each field and what a robot needs.",
            "kbc drive mission.kb --describe                                 # what it wants to hear, and what it knows\n"
            "kbc drive mission.kb < senses > wheels                          # from a pipe to a pipe\n"
            "kbc drive mission.kb --scale 1 --robot robot.toml               # the map is in metres; this is your robot\n"
            "kbc drive mission.kb --record drive.jsonl                       # what was heard and answered\n"
            "kbc drive mission.kb < drive.jsonl                              # the same again\n"
            "kbc sim mission.kb --driver \"kbc drive mission.kb\"              # over the simulator's floor\n"
            "kbc drive plant.kb --orders mqtt://broker --serial 7            # the master of a fleet says where: docs/orders.md\n",
            Shared::kCompiles, setup_drive},
    Command{"fleet", "Drive a knowledge base through many scenarios, with many seeds, on all cores or many machines",
            "Every scenario, seed and robot is one drive of `kbc sim`; runs.csv gets a row for each, summary.md says how often the robot "
            "arrives, how long it takes, and what else happens. Runs are done in shards, files in DIR/shards: an interrupt loses "
            "only the shards in hand, and the same command continues. The same options give the same bytes, however the work is shared out. "
            "docs/batches.md tells more.",
            "kbc fleet mission.kb --seeds 1-100 --out results                               # all cores\n"
            "kbc fleet mission.kb --scenario a.toml --scenario b.toml --seeds 1-50 --out r  # 100 runs, two scenarios\n"
            "mpirun -n 4 kbc fleet mission.kb --seeds 1-1000 --out r                        # four processes, on one machine or many\n"
            "kbc fleet mission.kb --seeds 1-1000 --out r --shard 2/8                        # the second of eight shares\n"
            "kbc fleet mission.kb --seeds 1-1000 --out r --merge                            # puts the shares together\n"
            "kbc fleet mission.kb --seeds 1-20 --out r --set sensors.range.noise=0.01,0.1   # with each of two noises\n",
            Shared::kCompiles, setup_fleet},
    Command{"compare", "Say which runs end otherwise after a change",
            "Reads the results of two batches or experiments, pairs their runs (the same scenario, settings, seed and robot), and says how many arrive in one "
            "of the two only, and how likely so uneven a division is by chance (p: McNemar's exact test). Below the table stand the runs that end otherwise. "
            "With --between the two sides are values of one column: methods of an experiment, or settings of a batch.",
            "kbc compare before after                                        # two folders of kbc fleet, from before and after a change\n"
            "kbc compare before after --expect lost=0,collisions=0           # for a build server: nothing has become worse\n"
            "kbc compare results --between method=mts,quick                  # two minds of one experiment\n"
            "kbc compare sweep --between robot.speed=0.4,0.6 --csv pairs.csv # two settings of one batch, and all pairs as a table\n",
            Shared::kMessages, setup_compare},
    Command{"experiment", "Compare a knowledge base with programmed control and with Bug2",
            "Generates labyrinths, routes and disturbances, lets all three, and rules of your own, drive through them, and says how often they arrive. "
            "An interrupt loses nothing: the same command continues. The same options give the same bytes.",
            "kbc experiment --out results                                    # 1,000 scenarios on 20 labyrinths\n"
            "kbc experiment --out results --maze maze.map                    # five of them are windows of a maze\n"
            "kbc experiment --out try --scenarios 40 --labyrinths 4 --seed 7 # a smaller one\n"
            "kbc experiment --out try --show 17                              # scenario 17 as files for kbc sim\n"
            "kbc experiment --out try --mind careful.kb                      # and rules of your own, as one method more\n",
            Shared::kCompiles, setup_experiment},
    Command{"fmt", "Lay out knowledge bases in the one canonical way",
            "Only white space changes, and a byte order mark goes; comments stay where they are. A folder stands for all .kb files in it and below. A file "
            "with errors is left as it is.",
            "kbc fmt mission.kb                              # to standard output\n"
            "kbc fmt -i mission.kb maps                      # in place, a file and a folder\n"
            "kbc fmt --check .                               # for a build server: fails if a file would change\n"
            "kbc fmt - < mission.kb                          # from an editor\n",
            Shared::kMessages, setup_fmt},
    Command{"lsp", "Serve an editor: messages while you type, names, layout, colours",
            "A language server (Language Server Protocol 3.17) over standard input and output, which an editor starts by itself. "
            "docs/editors.md says how to tell yours.",
            "kbc lsp                                         # what an editor runs\n"
            "kbc lsp --library ~/waymark/share/waymark/stdlib_rules -Wno-never-read\n",
            Shared::kCompiles, setup_lsp},
    Command{"new", "Make a project that builds",
            "A small map, a mission, a program with its controllers bound, CMakeLists.txt, and a golden trace for `kbc test`. "
            "The folder must be new or empty.",
            "kbc new robot                                   # then: cmake -S robot -B robot/build\n",
            Shared::kMessages, setup_new},
    Command{"completion", "Print the completion for a shell",
            "A script for bash, fish or zsh, which then completes commands, options, their values and the files that a command reads. "
            "`cmake --install` and the Debian package install all three. In ~/.zshrc, `source <(kbc completion zsh)` after compinit does as well.",
            "kbc completion bash > ~/.local/share/bash-completion/completions/kbc\n"
            "kbc completion fish > ~/.config/fish/completions/kbc.fish\n"
            "kbc completion zsh > ~/.zfunc/_kbc              # a folder in $fpath\n",
            Shared::kNone, setup_completion},
    Command{"man", "Print the man pages", "kbc.1 to standard output, or kbc.1 and a page for each command to a folder.",
            "kbc man | man -l -                              # read it\n"
            "kbc man --out man1                              # for a package\n",
            Shared::kMessages, setup_man},
};

}  // namespace

std::span<const Command> commands() { return kCommands; }

}  // namespace kb::cli

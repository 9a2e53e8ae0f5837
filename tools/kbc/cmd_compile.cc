// kbc compile: a knowledge base as C++ (or JSON, or an image).
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <future>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compiler/emit/emit.h"
#include "compiler/emit/names.h"
#include "compiler/model/ground.h"
#include "compiler/tables/compact.h"
#include "compiler/tables/fleet.h"
#include "compiler/tables/fleet_rest.h"
#include "tools/kbc/named_files.h"
#include "tools/kbc/recorded_input.h"
#include "sim/mind/control_words.h"
#include "tools/kbc/support.h"
#include "tools/kbc/trace/output_file.h"
#include "tools/kbc/trace/stream.h"

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace kb::cli {
namespace {

using diagnostics::Kind;
using Files = std::vector<Session::OutputFile>;

struct CompileOptions {
  std::string file;
  std::string prefix, folder;
  std::string name_space;
  std::string depfile;
  std::string form = "cpp";
  std::vector<std::string> profile;
  bool compact = false;
  bool fleet = false;
  bool map = false;
};

std::vector<std::string> output_endings(const CompileOptions& options) {
  if (options.form == "json") return {".json"};
  if (options.form == "image") return {".kbt"};
  std::vector<std::string> endings = {".h", ".cc"};
  if (options.fleet) endings.insert(endings.end(), {".fleet.h", ".fleet.cc"});
  if (options.map) endings.emplace_back(".map.h");
  return endings;
}

// A prefix that already has the ending of an output is the name of the output: the ending is not added again.
std::string without_ending(const std::string& prefix, const CompileOptions& options) {
  std::string_view longest;
  const std::vector<std::string> endings = output_endings(options);
  for (const std::string& ending : endings) {
    if (ending.size() > longest.size() && std::filesystem::path(prefix).filename().string().size() > ending.size() && prefix.ends_with(ending)) longest = ending;
  }
  return prefix.substr(0, prefix.size() - longest.size());
}

// The names of the outputs without their endings: that of the file, as in `route1.kb.h`, whatever its ending, or as in `route1.kbt`.
std::string output_prefix(const CompileOptions& options) {
  if (!options.prefix.empty()) return without_ending(options.prefix, options);
  std::filesystem::path name = std::filesystem::path(options.file).filename();
  if (options.form == "image" && name.extension() == ".kb") name = name.stem();
  return (std::filesystem::path(options.folder) / name).string();
}

// Whether PREFIX is no beginning of a name but itself what is written to: - or a device, a pipe, a socket.
bool is_whole(const std::string& prefix) {
  if (is_standard_output(prefix) || prefix.starts_with("/dev/fd/") || prefix.starts_with("/proc/")) return true;   // to whatever they lead
  std::error_code missing;
  const std::filesystem::file_status status = std::filesystem::status(prefix, missing);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) && !std::filesystem::is_directory(status);
}

// The files to write, without the dependency file, in the order of `emit_files`.
std::vector<std::string> output_names(const CompileOptions& options) {
  if (is_whole(options.prefix)) return {is_standard_output(options.prefix) ? "-" : options.prefix};
  const std::string prefix = output_prefix(options);
  std::vector<std::string> names;
  for (const std::string& ending : output_endings(options)) names.push_back(prefix + ending);
  return names;
}

bool make_folder_of(const std::string& output, Session& session) {
  const std::string folder = std::filesystem::path(output).parent_path().string();
  if (folder.empty()) return true;
  const auto refused = trace::make_folders(folder);
  if (refused) session.report(Kind::kCannotMakeFolder, {folder, *refused});
  return !refused;
}

// The namespace asked for, or the file's name as one; empty if it cannot be one (reported).
std::string choose_namespace(const CompileOptions& options, Session& session) {
  const bool asked = !options.name_space.empty();
  std::string name = asked ? options.name_space : emit::name_space_for(options.file);
  if (is_namespace(name)) return name;
  session.report(Kind::kBadNamespace,
                 {asked ? options.name_space : std::filesystem::path(options.file).stem().string()});
  return {};
}

// Why C++ cannot include a file of this name; empty if it can. For g++ and clang++ a backslash is a character like any other.
std::string_view against_include(std::string_view name) {
  if (name.find('"') != std::string_view::npos) return "a quotation mark";
  const bool control = std::any_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; });
  return control ? "a control character" : "";
}

// False (reported) if an output has to name a file that it cannot name.
bool can_name_files(const CompileOptions& options, const std::vector<std::string>& outputs, Session& session) {
  if (options.form != "cpp") return true;
  const std::string name = std::filesystem::path(outputs[0]).filename().string();
  const std::string_view against = against_include(name);
  if (!against.empty()) session.report(Kind::kNameNotSayable, {"`#include`", name, against});
  return against.empty();
}

// What the outputs are made of: the knowledge base, its imports, and recordings.
std::vector<std::string> files_read(const CompileOptions& options, const Session& session) {
  std::vector<std::string> read = session.files_read();
  std::copy_if(options.profile.begin(), options.profile.end(), std::back_inserter(read), [](const std::string& path) { return path != "-"; });
  return read;
}

// The same for the dependency file.
bool can_list_files(std::initializer_list<const std::vector<std::string>*> lists, Session& session) {
  for (const auto* list : lists) {
    for (const std::string& path : *list) {
      if (path.find_first_of("\r\n") == std::string::npos) continue;
      session.report(Kind::kNameNotSayable, {"a dependency file", path, "a line break"});
      return false;
    }
  }
  return true;
}

// As g++ does: a backslash is one of a name unless it stands before what it could escape.
std::string escape_for_make(const std::string& path) {
  std::string out;
  std::size_t backslashes = 0;   // just before
  for (const char c : path) {
    if (c == ' ' || c == '\t' || c == '#') out.append(backslashes + 1, '\\');
    if (c == '$') out += '$';
    out += c;
    backslashes = c == '\\' ? backslashes + 1 : 0;
  }
  return out;
}

std::string print_depfile(const Files& made, const std::vector<std::string>& read) {
  std::string out;
  for (const auto& file : made) out += (out.empty() ? "" : " ") + escape_for_make(file.path);
  out += ":";
  for (const std::string& file : read) out += " \\\n  " + escape_for_make(file);
  out += "\n";
  // A rule for each file that was read: else make stops where an import is gone that the knowledge base no longer names.
  for (const std::string& file : std::span(read).subspan(1)) out += escape_for_make(file) + ":\n";
  return out;
}

// Warns about what an image leaves out, at its declaration.
void diagnose_left_out(const driver::Compilation& compiled, Session& session) {
  auto diagnostics = session.diagnostics(compiled.sources);
  for (const program::Sensor& sensor : compiled.program.perception.sensors) {
    diagnostics.report(Kind::kNotInImage, sensor.declared, {"the sensor", sensor.name});
  }
  for (const fuzzy::Controller& controller : compiled.program.fuzzy) diagnostics.report(Kind::kNotInImage, controller.declared, {"the fuzzy controller", controller.name});
}

/// Why there is nothing for `--map` to write.
std::string roads_lacking(const model::Model& model) {
  for (const model::Map& map : model.maps) {
    if (!model::ground_roads(model, map)) return model::ground_lacking(model, map);
  }
  return "route that leads along a road of a map";
}

/// The planes that the profile leaves at rest, none without a profile; nothing if a recording cannot be read (reported).
std::optional<tables::FleetRest> planes_at_rest(const CompileOptions& options, driver::Compilation& compiled, Session& session) {
  std::vector<tables::FleetMission> missions;
  auto messages = session.diagnostics(compiled.sources);
  for (const std::string& path : options.profile) {
    const RecordedInput input = open_recorded({.facts = path, .readings = "", .dt = ""}, compiled.program, compiled.sources, messages);
    if (input.reader == nullptr) return std::nullopt;
    tables::FleetMission& mission = missions.emplace_back();
    while (const trace::FactsRow* row = input.reader->next()) {
      mission.dt_us.push_back(row->dt_us);
      mission.facts.insert(mission.facts.end(), row->facts.begin(), row->facts.end());
    }
    if (input.reader->failed()) return std::nullopt;
  }
  if (missions.empty()) return tables::FleetRest{};
  return tables::planes_at_rest(tables::build_fleet(compiled.program, compiled.tables), compiled.tables, missions);
}

/// Nothing if an error was reported. An image is taken from `compiled`.
Files emit_files(const CompileOptions& options, driver::Compilation& compiled, const std::vector<std::string>& names,
                 const std::string& name_space, Session& session) {
  if (options.form == "json") return {{names[0], program::print_json(compiled.program)}};
  if (options.form == "image") {
    diagnose_left_out(compiled, session);
    if (session.refuse_image(compiled.image_bytes)) return {};
    Files files;
    files.push_back({names[0], std::move(compiled.image_bytes), Session::require_sound_image});
    return files;   // not in an initializer list, which would copy the image
  }
  const auto file_name = [&names](std::size_t i) { return std::filesystem::path(names[i]).filename().string(); };
  const std::string map = options.map ? emit::map_body(compiled.model, compiled.program, compiled.tables) : "";
  if (options.map && map.empty()) {
    session.report(Kind::kGraphNothing, {options.file, roads_lacking(compiled.model)});
    return {};
  }
  const emit::CppOptions how = {.name_space = name_space, .header_name = file_name(0), .compact = options.compact, .map_print = options.map ? emit::print_of_map(map) : 0};
  emit::Cpp cpp = emit::cpp(compiled.program, compiled.tables, how);
  if (cpp.source.empty()) {
    session.report(Kind::kCppTooLarge, {options.file, fmt::format("{}", emit::kMaxCppBytes >> 20)});
    return {};
  }
  Files files = {{names[0], std::move(cpp.header)}, {names[1], std::move(cpp.source)}};
  if (options.fleet) {
    const std::optional<tables::FleetRest> rest = planes_at_rest(options, compiled, session);
    if (!rest) return {};
    emit::Cpp fleet = emit::cpp_fleet(compiled.program, compiled.tables, {.name_space = name_space, .header_name = file_name(2)},
                                      {.plain_header = file_name(0), .source_name = file_name(3), .mind_print = cpp.print}, *rest);
    files.push_back({names[2], std::move(fleet.header)});
    files.push_back({names[3], std::move(fleet.source)});
  }
  if (options.map) files.push_back({names.back(), emit::cpp_map(map, how, cpp.print)});
  return files;
}

// True (reported) if the knowledge base cannot be emitted in the form that was asked for.
bool refuse_form(const CompileOptions& options, const driver::Compilation& compiled, Session& session) {
  const std::string compact = options.compact ? tables::against_compact(compiled.tables, compiled.program) : "";
  const std::string fleet = options.fleet ? tables::against_fleet(compiled.tables) : "";
  if (!compact.empty()) session.report(Kind::kNotCompact, {options.file, compact});
  if (!fleet.empty()) session.report(Kind::kNoFleet, {options.file, fleet});
  return !compact.empty() || !fleet.empty();
}

/// Keeps memory that a phase frees for the next phase. Returning it to the kernel and asking for it again would take a second or two for
/// a million roads. Large blocks are returned: the gaps that they leave would be too much to keep.
void keep_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, 64 << 20);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_ARENA_MAX, 1);   // one heap for all threads
#endif
}

/// Warns if files beside the knowledge base would include another header than the one that is written elsewhere.
void diagnose_hidden(const CompileOptions& options, const Session::OutputFile& header, Session& session) {
  const std::filesystem::path written = header.path, beside = std::filesystem::path(options.file).parent_path() / written.filename();
  std::error_code missing;
  if (!std::filesystem::is_regular_file(beside, missing) || std::filesystem::equivalent(beside, written, missing)) return;
  std::string error;
  const auto bytes = trace::read_all(beside.string(), header.bytes.size(), error);   // of a longer file nothing
  if (bytes != header.bytes) session.report(Kind::kHiddenHeader, {beside.string(), header.path});
}

int compile(const CompileOptions& options, Session& session) {
  keep_memory();
  const std::string name_space = options.form == "cpp" ? choose_namespace(options, session) : "-";
  const std::vector<std::string> names = output_names(options);
  if (name_space.empty() || !can_name_files(options, names, session)) return kErrors;
  auto compiled = session.compile(options.file, options.form == "image" ? driver::Stage::kImage : driver::Stage::kTables, true, options.map);
  if (!compiled->ok()) return kErrors;
  auto messages = session.diagnostics(compiled->sources);
  sim::check_controls(compiled->program, messages);
  if (refuse_form(options, *compiled, session)) return kErrors;
  const std::vector<std::string> read = files_read(options, session);
  if (!options.depfile.empty() && !can_list_files({&names, &read}, session)) return kErrors;
  if (!make_folder_of(names[0], session)) return kErrors;
  Files files = emit_files(options, *compiled, names, name_space, session);
  if (files.empty()) return kErrors;
  if (options.form == "cpp") diagnose_hidden(options, files.front(), session);
  if (!options.depfile.empty()) files.push_back({options.depfile, print_depfile(files, read)});
  const bool large = compiled->program.rules.size() >= tables::kWorthAThread;
  const auto freed = std::async(large ? std::launch::async : std::launch::deferred, [&compiled] { compiled.reset(); });
  return session.write_files(files) ? session.exit_code() : kErrors;
}

}  // namespace

Run setup_compile(CLI::App& app) {
  auto options = std::make_shared<CompileOptions>();
  app.add_option("FILE", options->file, "The knowledge base")->required();
  auto* prefix = app.add_option("-o,--output", options->prefix,
                                "Write PREFIX.h and PREFIX.cc (or PREFIX.json, PREFIX.kbt; these also to -, standard output, or to a device); an ending that PREFIX has is not added again")
                     ->type_name("PREFIX");
  app.add_option("--out,--out-dir", options->folder, "Write to this folder, which is made if need be")
      ->type_name("DIR")
      ->excludes(prefix);
  app.add_option("--namespace", options->name_space, "The C++ namespace, as a or a::b; by default the file's name")
      ->type_name("NAME");
  app.add_option("--depfile", options->depfile, "Write the files that were read, for make and ninja")
      ->type_name("FILE");
  auto* compact = app.add_flag("--compact", options->compact, "For small microcontrollers: about a third of the tables and of the memory, more instructions");
  auto* fleet = app.add_flag("--fleet", options->fleet, "Also PREFIX.fleet.h and PREFIX.fleet.cc, for many robots at once")->excludes(compact);
  app.add_option("--profile", options->profile, "With --fleet: recorded facts of usual missions, CSV. The fleet decides the same, and is faster where robots do what was usual there")
      ->type_name("FILE")
      ->allow_extra_args(false)
      ->needs(fleet);
  app.add_flag("--map", options->map, "Also PREFIX.map.h, the roads that routes lead along, for the tasks of controllers");
  app.add_option("--emit", options->form, "What to write: C++, the program as JSON, or an image (.kbt) that a running robot can take")
      ->check(CLI::IsMember({"cpp", "json", "image"}))
      ->capture_default_str();
  app.callback([options, &app] {
    if (const std::string twice = named_twice(app, output_names(*options)); !twice.empty()) throw CLI::ValidationError(twice);
    const bool cpp = options->form == "cpp";
    if (!cpp && (options->compact || options->fleet || options->map)) {
      throw CLI::ValidationError(options->compact ? "--compact" : options->fleet ? "--fleet" : "--map", "this is a form of C++, and --emit " + options->form + " writes none");
    }
    const std::string last = std::filesystem::path(options->prefix).filename().string();
    if (!options->prefix.empty() && (last.empty() || last == "." || last == "..")) {
      throw CLI::ValidationError("--output", "`" + options->prefix + "` is a folder, and no beginning of a name; --out " + options->prefix + " writes into it");
    }
    if (!is_whole(options->prefix)) return;
    if (cpp) throw CLI::ValidationError("--output", options->prefix + " takes one file, and C++ is two; name a prefix, or --emit json or image");
    if (!options->depfile.empty()) throw CLI::ValidationError("--depfile", "it says what the outputs are made of, and " + options->prefix + " is the name of none; name a prefix");
  });
  return [options](Session& session) { return compile(*options, session); };
}

}  // namespace kb::cli

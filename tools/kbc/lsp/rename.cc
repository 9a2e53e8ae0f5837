// Renames a thing in all texts that name it. Nothing else may change by that.
#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <iterator>
#include <map>
#include <set>

#include <waymark/controllers/registry.h>
#include "compiler/syntax/syntax.h"
#include "tools/kbc/lsp/answers.h"
#include "tools/kbc/lsp/everywhere.h"
#include "tools/kbc/lsp/names.h"

namespace kb::lsp {
namespace {

/// The places of a name: for the path of each file, the bytes at which the name begins.
using Occurrences = std::map<std::string, std::set<std::uint32_t>>;

[[noreturn]] void refuse(const std::string& why) { throw Refused(why); }

Occurrences places(const Knowledge& knowledge, const std::vector<Use>& of) {
  Occurrences out;
  for (const Use& use : of) out[knowledge.path(use.span.file)].insert(use.span.begin);
  return out;
}

std::string told(const Knowledge& knowledge, const diagnostics::Diagnostic& message) {
  return fmt::format("{}: {}", knowledge.compiled->sources.describe(message.span), message.message);
}

/// Refuses if there are errors (other than by -Werror), because then it is uncertain what a name stands for.
void need_sound(const Knowledge& knowledge) {
  const auto error = std::ranges::find_if(knowledge.messages, [](const auto& message) { return diagnostics::info(message.kind).severity == diagnostics::Severity::kError; });
  if (error != knowledge.messages.end()) refuse("nothing can be renamed while there are errors: " + told(knowledge, *error));
}

bool is_word(const std::string& name) { return std::ranges::find(syntax::words(), name) != syntax::words().end(); }

void need_own(const Knowledge& knowledge, const std::vector<Use>& found, std::string_view name) {
  const source::Sources& sources = knowledge.compiled->sources;
  const auto standard = [&](const Use& use) { return sources.standard(use.span.file); };
  const auto declared = std::ranges::find_if(found, &Use::declares);
  if (declared != found.end() && standard(*declared)) refuse(fmt::format("`{}` is a name of the standard library ({})", name, sources.origin(declared->span)));
  const auto asked = std::ranges::find_if(found, standard);
  if (asked != found.end()) refuse(fmt::format("the standard library asks for `{}` by this name ({})", name, sources.origin(asked->span)));
}

// ---- all that is to be changed

class Renaming {
 public:
  Renaming(const Workspace& workspace, std::string_view old_name, std::string_view new_name) : workspace_(workspace), old_(old_name), new_(new_name) {}

  /// Finds all places, beginning with one of them.
  void collect(const std::string& path, std::uint32_t begin) {
    bases_ = everywhere(workspace_, path, begin, true);
    for (const Standing& base : bases_) {
      need_sound(*base.knowledge);
      if (base.uses.empty()) refuse(fmt::format("it is not certain what `{}` means in {}", old_, base.root));
      need_own(*base.knowledge, base.uses, old_);
      for (const Use& use : base.uses) {
        const std::string& file = base.knowledge->path(use.span.file);
        texts_.emplace(file, base.knowledge->compiled->sources.bytes(use.span.file));
        places_[file].insert(use.span.begin);
      }
    }
  }

  /// Compiles the result: there must be the same messages, and it must mean the same.
  void verify() const {
    OpenFiles edited = workspace_.files();
    for (const auto& [file, text] : texts_) edited.put(file, edit(file));
    for (const Standing& base : bases_) verify(base, workspace_.compiled(base.root, edited));
  }

  [[nodiscard]] Json edits(const OpenFile& asked) const {
    Json changes = Json::object(), documents = Json::array();
    for (const auto& [file, begins] : places_) {
      const auto base = std::ranges::find_if(bases_, [&path = file](const Standing& one) { return one.knowledge->file(path).has_value(); });
      const source::FileId id = *base->knowledge->file(file);
      Json all = Json::array();
      for (const std::uint32_t begin : begins) {
        const source::Span span{id, begin, static_cast<std::uint32_t>(begin + old_.size())};
        all.push_back({{"range", range_of(*base->knowledge, span, asked.encoding)}, {"newText", new_}});
      }
      const auto version = workspace_.version(file);
      documents.push_back({{"textDocument", {{"uri", workspace_.uri(file)}, {"version", version ? Json(*version) : Json()}}}, {"edits", all}});
      changes[workspace_.uri(file)] = std::move(all);
    }
    return asked.versioned ? Json{{"documentChanges", documents}} : Json{{"changes", changes}};
  }

 private:
  /// Where the name at `begin` is after all names before it have been renamed.
  [[nodiscard]] std::uint32_t moved(const std::string& file, std::uint32_t begin) const {
    const std::set<std::uint32_t>& begins = places_.at(file);
    const auto before = static_cast<std::size_t>(std::distance(begins.begin(), begins.lower_bound(begin)));
    return static_cast<std::uint32_t>(begin + before * new_.size() - before * old_.size());
  }

  [[nodiscard]] std::string edit(const std::string& file) const {
    std::string out;
    std::size_t done = 0;
    const std::string& text = texts_.at(file);
    for (const std::uint32_t begin : places_.at(file)) {
      out.append(text, done, begin - done).append(new_);
      done = begin + old_.size();
    }
    return out.append(text, done);
  }

  void verify(const Standing& base, const Knowledge& after) const {
    check_messages(*base.knowledge, after);
    check_words(base.knowledge->compiled->model, after.compiled->model);
    Occurrences expected;
    for (const auto& [file, begins] : places(*base.knowledge, base.uses)) {
      for (const std::uint32_t begin : begins) expected[file].insert(moved(file, begin));
    }
    const std::vector<Use> found = same_at(after, base.path, moved(base.path, base.begin));
    if (places(after, found) != expected || !same_model(*base.knowledge, after)) refuse(fmt::format("`{}` means something else already where `{}` stands, or would be taken for it", new_, old_));
  }

  void check_messages(const Knowledge& before, const Knowledge& after) const {
    std::map<diagnostics::Kind, std::size_t> said;
    for (const auto& message : before.messages) ++said[message.kind];
    for (const auto& message : after.messages) {
      if (said[message.kind]-- > 0) continue;
      if (is_word(new_)) refuse(fmt::format("`{}` is a word of the language", new_));
      refuse(fmt::format("with the name `{}` there is a new message: {}", new_, told(after, message)));
    }
  }

  /// A member may be what a variable hands to a controller as a word. Refuses the new name if the controller is told the old one elsewhere, or
  /// is one of Waymark's, which knows its words.
  void check_words(const model::Model& before, const model::Model& after) const {
    for (std::size_t i = 0; i < std::min(before.controls.size(), after.controls.size()); ++i) {
      const model::Control &was = before.controls[i], &is = after.controls[i];
      for (std::size_t k = 0; k < std::min(was.arguments.size(), is.arguments.size()); ++k) {
        const auto& argument = is.arguments[k];
        if (was.arguments[k].word == argument.word) continue;
        const mts::ControllerEntry* known = mts::find_controller(is.controller.c_str());
        const mts::Parameter* parameter = known == nullptr ? nullptr : mts::find_parameter(known->id, argument.name.c_str());
        const bool taken = parameter != nullptr && mts::number_of_word(*parameter, old_.c_str()) >= 0.0f;
        if (taken || is_told(after, is.controller, argument.name)) refuse(fmt::format("`{}` is also the word that `{}` takes for its `{}`", old_, is.controller, argument.name));
      }
    }
  }

  /// Whether some line tells the controller the old name.
  [[nodiscard]] bool is_told(const model::Model& model, std::string_view controller, std::string_view argument) const {
    return std::ranges::any_of(model.controls, [&](const model::Control& control) {
      return control.controller == controller && std::ranges::any_of(control.arguments, [&](const auto& one) { return one.name == argument && one.word == old_; });
    });
  }

  /// Whether both mean the same except for the name.
  [[nodiscard]] bool same_model(const Knowledge& before, const Knowledge& after) const;

  const Workspace& workspace_;
  std::string old_, new_;
  std::deque<Standing> bases_;
  std::map<std::string, std::string> texts_;   // by file that contains the name
  Occurrences places_;
};

/// The next name, number or sign of a printed model. Places, at the ends of lines, are left out.
std::string_view next_word(std::string_view& rest) {
  if (rest.starts_with("  # ")) rest.remove_prefix(std::min(rest.find('\n'), rest.size()));
  const auto end = std::ranges::find_if_not(rest, in_name);
  const std::string_view word = rest.substr(0, std::max<std::size_t>(static_cast<std::size_t>(end - rest.begin()), rest.empty() ? 0 : 1));
  rest.remove_prefix(word.size());
  return word;
}

bool Renaming::same_model(const Knowledge& before, const Knowledge& after) const {
  const std::string old_text = model::print(before.compiled->model, before.compiled->sources), new_text = model::print(after.compiled->model, after.compiled->sources);
  std::string_view old_rest = old_text, new_rest = new_text;
  while (!old_rest.empty() || !new_rest.empty()) {
    const std::string_view was = next_word(old_rest), is = next_word(new_rest);
    if (was != is && (was != old_ || is != new_)) return false;
  }
  return true;
}

// ---- before it

/// All places of the name at `at`; none if it is not declared.
std::vector<Use> found_at(const OpenFile& file, Position at) {
  for (const auto& [root, knowledge] : file.workspace.all()) {
    if (knowledge.file(file.path)) need_sound(knowledge);
  }
  const Use* const here = file.use_at(at);
  const std::vector<Use> found = here == nullptr ? std::vector<Use>() : file.knowledge.same(*here);
  if (std::ranges::none_of(found, &Use::declares)) return {};
  need_own(file.knowledge, found, file.sources().text(here->span));
  return found;
}

void need_name(const std::string& name) {
  if (name.size() > syntax::kMaxIdentifierBytes) refuse(fmt::format("a name has {} bytes at most", syntax::kMaxIdentifierBytes));
  if (!syntax::is_name(name) && !is_word(name)) refuse(fmt::format("`{}` is no name: letters, digits and `_`, no digit first", name));
}

/// Refuses a name that is taken, and says by what.
void need_free(const Knowledge& knowledge, Meaning::Space space, const std::string& name) {
  for (const model::KnownName& known : knowledge.names) {
    if (known.name != name || known.kind == "control" || space_of(known.kind) != space || !known.declared.known()) continue;
    refuse(fmt::format("`{0}` is taken: {1} `{0}` is declared at {2}", name, known.kind, knowledge.compiled->sources.origin(known.declared)));
  }
}

}  // namespace

Json prepare_rename(const OpenFile& file, Position at) {
  if (found_at(file, at).empty()) return nullptr;
  const source::Span span = file.use_at(at)->span;
  return {{"range", file.range(span)}, {"placeholder", file.sources().text(span)}};
}

Json rename(const OpenFile& file, Position at, const std::string& new_name) {
  const std::vector<Use> found = found_at(file, at);
  if (found.empty()) refuse("nothing stands here that can be renamed");
  const source::Span here = file.use_at(at)->span;
  const std::string_view old_name = file.sources().text(here);
  if (new_name == old_name) return nullptr;
  need_name(new_name);
  need_free(file.knowledge, found.front().meaning.space, new_name);
  Renaming renaming(file.workspace, old_name, new_name);
  renaming.collect(file.path, here.begin);
  renaming.verify();
  return renaming.edits(file);
}

}  // namespace kb::lsp

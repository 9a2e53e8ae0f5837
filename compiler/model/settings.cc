// Levels and settings.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "compiler/model/draft.h"
#include "compiler/model/references.h"
#include "compiler/model/standard_names.h"
#include "compiler/model/units.h"
#include "compiler/syntax/tree_text.h"

namespace kb::model {
namespace {

using diagnostics::Kind;

constexpr std::size_t kLevelsNamed = 8;   // in the advice to declare levels

// ---- settings
//
// note [whose setting counts]
// What the standard library sets is a default: a file of the user may set it to something else. Two files of the user, or
// two of the library, must agree.
class SettingsReader {
 public:
  explicit SettingsReader(Draft& draft) : draft_(draft) {}

  void run() {
    draft_.each<syntax::Set>([&](const syntax::Tree& tree, const auto&, const syntax::Set& set) {
      for (const syntax::Setting& setting : set.settings) note_setting(tree, setting);
    });
    for (const Chosen& chosen : chosen_) {
      if (chosen.setting != nullptr) apply(*chosen.tree, *chosen.setting);
    }
    check_thresholds();
  }

 private:
  struct Chosen { const syntax::Setting* setting = nullptr; const syntax::Tree* tree = nullptr; };

  static bool same(const syntax::Setting& a, const syntax::Setting& b) {
    if (a.number.has_value() != b.number.has_value()) return false;
    if (!a.number) return a.word.text == b.word.text;
    return same_quantity(*a.number, *b.number);
  }

  static std::string written(const syntax::Setting& setting) {
    return fmt::format("{} = {}", setting.key.text, setting.number ? syntax::number_text(*setting.number) : std::string(setting.word.text));
  }

  /// Whether a is below b by so much that the difference is not zero in float, in which the runtime compares them.
  static bool below(double a, double b) { return b - a >= static_cast<double>(std::numeric_limits<float>::denorm_min()); }

  void note_setting(const syntax::Tree& tree, const syntax::Setting& setting) {
    const auto key = std::find(kSettingNames.begin(), kSettingNames.end(), setting.key.text);
    if (key == kSettingNames.end()) {
      draft_.diagnostics.report(Kind::kUnknownSetting, setting.key.span, {setting.key.text})
          .suggest(diagnostics::closest(setting.key.text, kSettingNames));
      return;
    }
    Chosen& chosen = chosen_[static_cast<std::size_t>(key - kSettingNames.begin())];
    const bool old_is_default = chosen.setting != nullptr && draft_.standard(chosen.setting->key.span);
    if (chosen.setting == nullptr || same(*chosen.setting, setting)) {
      if (chosen.setting == nullptr || old_is_default) chosen = {&setting, &tree};   // if library and user agree, it counts as the user's
      return;
    }
    if (old_is_default == draft_.standard(setting.key.span)) {
      draft_.diagnostics.report(Kind::kSettingTwice, setting.key.span, {setting.key.text})
          .note(Kind::kFirstSetHere, chosen.setting->key.span, {written(*chosen.setting)});
    } else if (old_is_default) {
      chosen = {&setting, &tree};
    }
  }

  void apply(const syntax::Tree& tree, const syntax::Setting& setting) {
    Settings& settings = draft_.model.settings;
    const std::string_view key = setting.key.text;
    if (key == "idle") return apply_idle(tree, setting);
    if (!setting.number) {
      draft_.diagnostics.report(Kind::kSettingKind, setting.word.span, {key, key == "hold_limit" ? "a time" : "a number"});
      return;
    }
    if (key == "hold_limit") {
      const auto limit = to_microseconds(*setting.number, draft_.diagnostics);
      if (limit == 0u) range(setting, "hold_limit > 0");
      if (limit) settings.hold_limit_us = *limit;
      return;
    }
    if (!setting.number->unit.text.empty()) {
      draft_.diagnostics.report(Kind::kSettingKind, setting.number->unit.span, {key, "a number without a unit"});
      return;
    }
    const double value = setting.number->value;
    if (key == "event") event_ = &setting, settings.event = value;
    if (key == "attention") attention_ = &setting, settings.attention = value;
    if (key == "firing") settings.firing = value;
    if (key != "attention" && !(below(0.0, value) && value <= 1.0)) range(setting, fmt::format("0 < {} <= 1", key));
    if (key == "attention" && !(value >= 0.0)) range(setting, "0 <= attention < event");
  }

  void range(const syntax::Setting& setting, std::string_view rule) {
    draft_.diagnostics.report(Kind::kSettingRange, setting.number->span,
                              {setting.key.text, fmt::format("{}", setting.number->value), rule});
    ranges_ok_ = false;
  }

  void apply_idle(const syntax::Tree& tree, const syntax::Setting& setting) {
    Settings& settings = draft_.model.settings;
    if (setting.number) {
      draft_.diagnostics.report(Kind::kSettingKind, setting.number->span, {"idle", "`stop`, `hold` or a strategy"});
      return;
    }
    const std::string_view word = setting.word.text;
    if (word == "stop") {
      settings.idle = Idle::kStop;
    } else if (word == "hold") {
      settings.idle = Idle::kHold;
    } else if (const Entity* entity = draft_.names.find(word); entity && entity->kind == Entity::Kind::kStrategy) {
      settings.idle = Idle::kStrategy;
      settings.idle_strategy = CellId{entity->id};
    } else if (word.find_first_of(".[(") != std::string_view::npos) {
      apply_idle_member(tree, setting);
    } else {
      draft_.diagnostics.report(Kind::kIdleUnknown, setting.word.span, {word})
          .suggest(draft_.names.nearest(word, Entity::Kind::kStrategy, draft_.diagnostics));
    }
  }

  /// A strategy of a group.
  void apply_idle_member(const syntax::Tree& tree, const syntax::Setting& setting) {
    std::vector<Binder> binders;
    References references(draft_, tree, binders);
    const Operand operand = references.evaluate(references.compile(setting.ref), {});
    if (operand.kind == Operand::Kind::kBroken) return;
    const std::optional<CellId> cell = references.cell_of(operand);
    if (!cell || draft_.model[*cell].kind != CellKind::kStrategy) {
      draft_.diagnostics.report(Kind::kIdleUnknown, setting.word.span, {setting.word.text});
      return;
    }
    draft_.model.settings.idle = Idle::kStrategy;
    draft_.model.settings.idle_strategy = *cell;
  }

  /// Facts without thresholds of their own have the general ones.
  void check_thresholds() {
    const Settings& settings = draft_.model.settings;
    if (ranges_ok_ && !below(settings.attention, settings.event)) {
      if (const syntax::Setting* at = attention_ != nullptr ? attention_ : event_) range(*at, "0 <= attention < event");
    }
    for (Cell& cell : draft_.model.cells) {
      if (cell.kind != CellKind::kFact) continue;
      if (std::isnan(cell.event)) cell.event = settings.event;
      if (std::isnan(cell.attention)) cell.attention = settings.attention;
    }
    for (const OwnThreshold& own : draft_.own_thresholds) check_own(own);
  }

  /// Reported at the number that the user wrote.
  void check_own(const OwnThreshold& own) {
    const Cell& cell = draft_.model[own.fact];
    const bool event_ok = below(0.0, cell.event) && cell.event <= 1.0;
    if (event_ok && cell.attention >= 0.0 && below(cell.attention, cell.event)) return;
    const bool event = own.event && (!event_ok || !own.attention);
    draft_.diagnostics.report(Kind::kThresholdRange, event ? *own.event : own.attention.value_or(cell.declared),
                              {event ? "event" : "attention", fmt::format("{}", event ? cell.event : cell.attention), cell.name,
                               event ? "attention" : "event", fmt::format("{}", event ? cell.attention : cell.event)});
  }

  Draft& draft_;
  std::array<Chosen, kSettingNames.size()> chosen_{};
  const syntax::Setting* event_ = nullptr;
  const syntax::Setting* attention_ = nullptr;
  bool ranges_ok_ = true;
};

}  // namespace

void report_no_levels(Draft& draft, source::Span at) {
  std::vector<std::string_view> used;
  draft.each<syntax::Rule>([&](const auto&, const auto&, const syntax::Rule& rule) {
    const bool known = std::find(used.begin(), used.end(), rule.level.text) != used.end();
    if (!known && rule.level.text != "control" && used.size() < kLevelsNamed) used.push_back(rule.level.text);
  });
  const bool standard = !used.empty() && std::all_of(used.begin(), used.end(), [&](std::string_view level) {
    return draft.library != nullptr && draft.library->file_with_member(StandardNames::kLevels, level);
  });
  if (used.empty()) used.emplace_back("plan");
  const std::string line = fmt::format("`levels {} > control`{}", fmt::join(used, " > "), used.size() > 1 ? ", or these in another order, the highest first" : "");
  draft.diagnostics.report(Kind::kNoLevels, at, {standard ? "`import std.basics`, or " + line : line});
}

namespace {

/// Whether `all` has each of `some`, in their order, and ends with the same one: whoever inserts levels says the whole order.
bool contains(const std::vector<syntax::Name>& all, const std::vector<syntax::Name>& some) {
  auto next = some.begin();
  for (const syntax::Name& name : all) {
    if (next != some.end() && name.text == next->text) ++next;
  }
  return next == some.end() && all.back().text == some.back().text;
}

/// Where a level was declared first: one of the library's belongs to it, whoever repeats its name.
source::Span first_place(const std::vector<std::pair<const syntax::Levels*, source::Span>>& lines, const syntax::Name& level, const source::Sources& sources) {
  for (const auto& [levels, span] : lines) {
    if (!sources.standard(span.file)) continue;
    const auto found = std::find_if(levels->names.begin(), levels->names.end(), [&](const syntax::Name& name) { return name.text == level.text; });
    if (found != levels->names.end()) return found->span;
  }
  return level.span;
}

}  // namespace

void declare_levels(Draft& draft) {
  std::vector<std::pair<const syntax::Levels*, source::Span>> lines;
  draft.each<syntax::Levels>([&](const auto&, const syntax::Statement& statement, const syntax::Levels& levels) {
    if (!levels.names.empty()) lines.emplace_back(&levels, statement.span);
  });
  if (lines.empty()) return;
  // Only the line with the most levels can have all levels of each other line.
  const auto& [whole, whole_span] = *std::max_element(lines.begin(), lines.end(), [](const auto& a, const auto& b) { return a.first->names.size() < b.first->names.size(); });
  for (const auto& [levels, span] : lines) {
    if (contains(whole->names, levels->names)) continue;
    const bool library = draft.diagnostics.sources().standard(span.file);   // which cannot be wrong
    draft.diagnostics.report(Kind::kLevelsTwice, library ? whole_span : span)
        .note(Kind::kFirstDeclaredHere, (library ? levels : whole)->names.front().span)
        .note(Kind::kLevelsOnce, {});
  }
  std::unordered_map<std::string_view, source::Span> known;
  for (const syntax::Name& name : whole->names) {
    const auto [before, fresh] = known.emplace(name.text, name.span);
    if (!fresh) {
      draft.diagnostics.report(Kind::kLevelTwice, name.span, {name.text}).note(Kind::kFirstDeclaredHere, before->second);
      continue;
    }
    draft.model.levels.emplace_back(name.text);
    draft.model.level_spans.push_back(first_place(lines, name, draft.diagnostics.sources()));
  }
}

void apply_settings(Draft& draft) { SettingsReader(draft).run(); }

}  // namespace kb::model

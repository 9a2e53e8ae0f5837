// The emitted `Facts`: see runtime/facts.h.
#include <fmt/format.h>

#include <map>

#include "compiler/emit/cpp.h"

namespace kb::emit {
namespace {

using Out = std::back_insert_iterator<std::string>;

/// Group and member: `In` and `N` for `In.N`, `G` and `left,mark` for `G[left,mark]`; only the name for a fact without a group.
std::pair<std::string_view, std::string_view> split(std::string_view name) {
  const std::size_t at = name.find_first_of(".[");
  if (at == std::string_view::npos) return {name, {}};
  std::string_view member = name.substr(at + 1);
  if (name[at] == '[') member.remove_suffix(1);
  return {name.substr(0, at), member};
}

struct Group {
  std::string name;
  std::vector<std::pair<std::string, std::size_t>> members;   ///< identifier, fact
};

/// Facts by the names that they have in C++. None if there are so many that none gets a name.
struct Named {
  std::vector<std::pair<std::string, std::size_t>> plain;
  std::vector<Group> groups;   ///< in order of first appearance
};

Named name_facts(const CppInput& in) {
  Named named;
  const std::uint32_t count = in.program.facts;
  std::map<std::string_view, std::size_t> known;
  Scope scope{"store_", "store", "set", "get", "clear", "Fact", "Facts", "Store"};
  std::vector<Scope> scopes;
  for (std::size_t f = 0; f < count && count <= kMaxNamedFacts; ++f) {
    const auto [base, member] = split(in.program.cells[f].name);
    if (member.empty()) {
      named.plain.emplace_back(scope.make(base), f);
      continue;
    }
    const auto [at, fresh] = known.try_emplace(base, named.groups.size());
    if (fresh) {
      named.groups.push_back({scope.make(base), {}});
      scopes.emplace_back(std::initializer_list<std::string_view>{"Store"});
    }
    named.groups[at->second].members.emplace_back(scopes[at->second].make(member), f);
  }
  return named;
}

}  // namespace

void emit_facts(const CppInput& in, std::string& out) {
  const std::uint32_t count = in.program.facts;
  const Named named = name_facts(in);
  // These names cannot clash with the group's type or a parameter: names made from those of the knowledge base do not end in an underscore,
  // except for words of C++.
  fmt::format_to(Out(out),
                 "/// What is known at a tick: a certainty factor in [-1, 1] for each fact, 0 for no data. Values stay until they "
                 "are\n/// set again.\nstruct Facts {{\n  using Store = mts::FactStore<{}>;\n\n",
                 count);
  for (const Group& group : named.groups) {
    fmt::format_to(Out(out), "  union {}Group_ {{\n", group.name);
    for (const auto& [name, fact] : group.members) {
      fmt::format_to(Out(out), "    mts::FactSlot<Store, {}> {};\n", fact, name);
    }
    out += "  };\n";
  }
  out += "  union {\n    Store store_;\n";
  for (const auto& [name, fact] : named.plain) fmt::format_to(Out(out), "    mts::FactSlot<Store, {}> {};\n", fact, name);
  for (const Group& group : named.groups) fmt::format_to(Out(out), "    {0}Group_ {0};\n", group.name);
  fmt::format_to(Out(out),
                 "  }};\n\n"
                 "  Facts() : store_() {{}}\n"
                 "  Facts(const Facts& other_) : store_(other_.store_) {{}}\n"
                 "  Facts& operator=(const Facts& other_) {{\n"
                 "    store_ = other_.store_;\n"
                 "    return *this;\n"
                 "  }}\n"
                 "  void set(Fact fact_, float certainty_) {{ store_.set(static_cast<std::uint32_t>(fact_), certainty_); }}\n"
                 "  [[nodiscard]] float get(Fact fact_) const {{ return store_.value[static_cast<std::uint32_t>(fact_)]; }}\n"
                 "  /// Every fact to 0: no data.\n"
                 "  void clear() {{\n"
                 "    for (std::uint32_t f_ = 0; f_ != {}; ++f_) {{\n"
                 "      if (store_.value[f_] != 0.0f) store_.set(f_, 0.0f);\n"
                 "    }}\n"
                 "  }}\n"
                 "  [[nodiscard]] Store& store() {{ return store_; }}\n"
                 "}};\n\n",
                 count);
}

}  // namespace kb::emit

#include "tools/kbc/lsp/uses_fuzzy.h"

#include <unordered_map>
#include <unordered_set>

namespace kb::lsp {
namespace {

using Space = Meaning::Space;

class FuzzyUses {
 public:
  FuzzyUses(std::uint32_t number, std::vector<Use>& to) : number_(number), out_(to) {}

  void read(const syntax::Fuzzy& fuzzy) {
    for (const auto& input : fuzzy.inputs) declare(input, Space::kInput);
    for (const auto& output : fuzzy.outputs) {
      declare(output, Space::kOutput);
      if (output.default_term) term(*output.default_term, output.name.text);
    }
    for (const syntax::FuzzyCond& cond : fuzzy.conds) {
      if (cond.kind != syntax::FuzzyCond::Kind::kIs) continue;
      quantity(cond.ref.name);
      term(cond.words.back(), cond.ref.name.text);
    }
    for (const syntax::Fuzzy::Rule& rule : fuzzy.rules) {
      for (const syntax::Fuzzy::Consequent& consequent : rule.consequents) read(consequent);
    }
  }

 private:
  /// An input or an output.
  struct Quantity {
    Meaning meaning, of_terms;
    std::unordered_set<std::string_view> terms;
  };

  template <class Declared>
  void declare(const Declared& declared, Space space) {
    const Meaning of_terms{Space::kTerm, (std::uint64_t{number_} << 32u) | quantities_.size()};
    Quantity& quantity = quantities_.try_emplace(declared.name.text, Quantity{{space, number_}, of_terms, {}}).first->second;
    out_.push_back({declared.name.span, quantity.meaning, true});
    for (const auto& term : declared.terms) {
      quantity.terms.insert(term.name.text);
      out_.push_back({term.name.span, quantity.of_terms, true});
    }
  }
  void read(const syntax::Fuzzy::Consequent& consequent) {
    quantity(consequent.output);
    for (const syntax::Fuzzy::Part& part : consequent.sum) {
      if (!part.ref) continue;
      const bool alone = !part.number && !part.ref->element;
      if (!alone || !term(part.ref->name, consequent.output.text)) quantity(part.ref->name);   // if it is not a term, it is an input
    }
  }
  void quantity(const syntax::Name& written) {
    if (const auto at = quantities_.find(written.text); at != quantities_.end()) out_.push_back({written.span, at->second.meaning});
  }
  /// Whether the name is a term of `of`; then it is noted.
  bool term(const syntax::Name& written, std::string_view of) {
    const auto at = quantities_.find(of);
    if (at == quantities_.end() || !at->second.terms.contains(written.text)) return false;
    out_.push_back({written.span, at->second.of_terms});
    return true;
  }

  std::uint32_t number_;
  std::vector<Use>& out_;
  std::unordered_map<std::string_view, Quantity> quantities_;   // looked up, never iterated
};

}  // namespace

void add_uses(const syntax::Fuzzy& fuzzy, std::uint32_t number, std::vector<Use>& to) { FuzzyUses(number, to).read(fuzzy); }

}  // namespace kb::lsp

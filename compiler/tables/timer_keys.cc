#include "compiler/tables/timer_keys.h"

#include <string_view>

#include "compiler/tables/lists.h"

namespace kb::tables {
namespace {

using Hash = std::uint64_t;

/// The finalizer of SplitMix64 (Steele, Lea and Flood 2014): each bit of the input changes half of the output's bits on average.
constexpr Hash stir(Hash x) {
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}
constexpr Hash join(Hash a, Hash b) { return stir(stir(a) ^ b); }
constexpr Hash of_text(std::string_view text) {
  Hash hash = text.size();
  for (const char c : text) hash = join(hash, static_cast<unsigned char>(c));
  return hash;
}

class Keys {
 public:
  Keys(const Tables& t, const program::Program& p)
      : t_(t), p_(p), known_(t.shape.atoms, 0), level_of_(t.shape.timers, 0), parts_(parts_of_nodes(t)) {
    for (std::size_t l = 0; l < t.levels.size(); ++l) {
      for (I g = t.levels[l].first_stage; g < t.levels[l].end_stage; ++g) {
        for (I i = t.stages[g].first_timer; i < t.stages[g].end_timer; ++i) level_of_[i] = l;
      }
    }
  }

  /// Recurses as deep as conditions nest, which the parser limits.
  Hash of_atom(I atom) {
    Hash& known = known_[atom];
    if (known != 0) return known;
    const I first_node = t_.shape.first_node(), first_timer = t_.shape.first_timer();
    if (atom >= first_node) return known = of_node(atom - first_node);
    if (atom >= first_timer) return known = of_timer(atom - first_timer);
    const AtomOrigin& o = t_.origins[atom];
    const Hash what = join(static_cast<Hash>(o.kind), static_cast<Hash>(o.term));
    if (o.cell == program::CellId::kNone) return known = what;
    return known = join(join(what, static_cast<Hash>(p_[o.cell].kind)), of_text(p_[o.cell].name));
  }
  Hash of_timer(I timer) {
    const Hash when = join(of_text(p_.levels[level_of_[timer]]), t_.queue_us[t_.timers[timer].queue]);
    return join(when, of_literal(t_.timers[timer].input));
  }

 private:
  Hash of_literal(I literal) { return join(of_atom(literal >> 1), literal & 1u); }
  Hash of_node(I node) {
    Hash sum = 0;
    for (const I part : parts_[node]) sum += stir(of_literal(part));
    return join(join(t_.nodes[node].need, parts_[node].size()), sum);
  }

  const Tables& t_;
  const program::Program& p_;
  std::vector<Hash> known_;
  std::vector<std::size_t> level_of_;
  std::vector<std::vector<I>> parts_;   // by node
};

}  // namespace

std::vector<mts::TimerKey> timer_keys(const Tables& tables, const program::Program& program) {
  Keys keys(tables, program);
  std::vector<mts::TimerKey> out;
  for (I i = 0; i < tables.shape.timers; ++i) {
    const Hash hash = keys.of_timer(i);
    out.push_back({static_cast<std::uint32_t>(hash >> 32), static_cast<std::uint32_t>(hash)});
  }
  return out;
}

}  // namespace kb::tables

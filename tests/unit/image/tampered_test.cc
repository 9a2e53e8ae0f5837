// Images whose checksum is right and whose tables are not: what is wrong is found, whatever made it.
#include <waymark/runtime/image.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "compiler/tables/image.h"
#include "compiler/tables/tables.h"
#include "tests/unit/program/program_builder.h"

namespace kb::tables {
namespace {

using mts::ImageStatus;
using mts::Word;

/// Something of every table: two words of rules, nodes, timers in timers, a large group, attention, rules that contradict each other.
program::Program something_of_all() {
  using namespace program::testing;
  ProgramBuilder b({"goal", "control"});
  for (int i = 0; i < 40; ++i) b.fact("F" + std::to_string(i));
  b.satellite("A").satellite("B").satellite("C").exclusive({"A", "B", "C"}).satellite("Near").of("Near", "F3").of("Near", "F5");
  b.strategy("Go").strategy("Wait");
  for (int i = 0; i < 40; ++i) {
    const std::string name = "F" + std::to_string(i);
    b.when("note " + name, "goal", all({seen(name), no(high("sat " + name)), no(high("Near"))}), {raise("sat " + name), raise(i % 2 == 0 ? "A" : "B")});
  }
  b.when("any", "goal", all({event("F1"), any({high("F2"), high("F3"), low("F4")})}), {raise("C"), raise("Near"), raise("sat Go")});
  b.when("long", "goal", held(all({seen("F5"), held(seen("F6"), 100'000)}), 200'000), {lower("Near"), raise("sat Wait")});
  b.when("longer", "goal", held(seen("F6"), 300'000), {reset_all()});
  return b.build();
}

using View = mts::Image<std::uint16_t>;

/// An image of `something_of_all` that is being changed where it lies.
struct Opened {
  mts::ImageHead& head;
  const mts::Tables<std::uint16_t>& t;
  const View& view;
};

struct Damage {
  const char* what;
  ImageStatus found;
  std::function<void(Opened&)> make;
};

/// The view is of bytes that may be changed, though it does not let one.
template <class T>
void set(const T& place, auto value) { const_cast<T&>(place) = static_cast<T>(value); }
template <class T>
void exchange(const T& a, const T& b) { std::swap(const_cast<T&>(a), const_cast<T&>(b)); }

void expect_found(const Limits& limits, const std::vector<Damage>& all) {
  const program::Program program = something_of_all();
  const std::string bytes = write_image(build(program, limits), program);
  std::vector<std::uint64_t> memory((bytes.size() + 7) / 8);
  for (const Damage& damage : all) {
    std::memcpy(memory.data(), bytes.data(), bytes.size());
    mts::ImageInfo info;
    ASSERT_EQ(mts::peek_image(memory.data(), bytes.size(), info), ImageStatus::kOk);
    std::vector<Word> scratch(info.scratch_words);
    View view;
    const auto open = [&] { return mts::open_image(memory.data(), bytes.size(), scratch.data(), scratch.size(), view, mts::Checksum::kTrust); };
    ASSERT_EQ(open(), ImageStatus::kOk);
    Opened opened{*reinterpret_cast<mts::ImageHead*>(memory.data()), view.tables, view};
    damage.make(opened);
    const ImageStatus status = open();
    EXPECT_EQ(status, damage.found) << damage.what << ": " << mts::text(status);
  }
}

/// The first row of the first atom that is read in several words.
std::size_t wide_row(const Opened& o) {
  for (std::size_t a = 0; a < o.t.shape.atoms; ++a) {
    if (o.t.atoms[a + 1].readers - o.t.atoms[a].readers > 1) return o.t.atoms[a].readers;
  }
  throw std::logic_error("no atom is read in several words");
}

/// The row of the first word under whose atom its first rule sleeps, or does not.
std::size_t row_of_key(const Opened& o, bool sleeps) {
  for (std::size_t i = 0; i < o.head.readers; ++i) {
    if (o.t.readers[i].word == 0 && ((o.t.readers[i].keyed & 1u) != 0) == sleeps) return i;
  }
  throw std::logic_error("there is no such row");
}

constexpr std::uint32_t kLast = 1u << 31;

TEST(TamperedImage, WhoseRulesAreWrongIsRefused) {
  const auto last = [](const Opened& o) -> const std::uint16_t& { return o.t.conditions[o.t.rules[1].conditions - 1]; };   // of the first rule
  expect_found({.large_group = 2}, {
      {"a threshold that nothing is below", ImageStatus::kSettings, [](Opened& o) { o.head.firing = 0.0f; }},
      {"an idle strategy that nobody asks for", ImageStatus::kSettings, [](Opened& o) { o.head.idle_strategy = 1; }},
      {"a word that is not full, though another follows", ImageStatus::kLevels, [](Opened& o) { set(o.t.word_rule[1], o.t.word_rule[1] - 1); }},
      {"a word of more rules than it has bits", ImageStatus::kLevels, [](Opened& o) { set(o.t.word_rule[1], o.t.word_rule[1] + 1); }},
      {"words that begin with another rule than the first", ImageStatus::kLevels, [](Opened& o) { set(o.t.word_rule[0], 1); }},
      {"a level that begins in the one before", ImageStatus::kLevels, [](Opened& o) { set(o.t.levels[1].first_word, o.t.levels[1].first_word - 1); }},
      {"a level that ends before it begins", ImageStatus::kLevels, [](Opened& o) { set(o.t.levels[1].end_word, 0); }},
      {"a `while` rule where no rule is", ImageStatus::kLevels, [](Opened& o) { set(o.t.while_rules[1], kLast); }},
      {"a `reset` where no rule is", ImageStatus::kLevels, [](Opened& o) { set(o.t.reset_rules[1], kLast); }},
      {"a condition that stands there twice", ImageStatus::kRules, [&](Opened& o) { set(last(o), o.t.conditions[0]); }},
      {"the true atom as a condition", ImageStatus::kRules, [&](Opened& o) { set(last(o), mts::kTrueAtom << 1); }},
      {"a condition that is no atom", ImageStatus::kRules, [&](Opened& o) { set(last(o), o.t.shape.atoms << 1); }},
      {"a rule that ends before it begins", ImageStatus::kRules, [](Opened& o) { exchange(o.t.rules[1].conditions, o.t.rules[2].conditions); }},
      {"rules that do not have all conditions", ImageStatus::kRules, [](Opened& o) { set(o.t.rules[o.t.shape.rules].conditions, o.head.conditions - 1); }},
  });
}

TEST(TamperedImage, WhoseReadersAreNotThoseThatReadIsRefused) {
  expect_found({.large_group = 2}, {
      {"lists that run backwards", ImageStatus::kReaders, [](Opened& o) { exchange(o.t.atoms[2].readers, o.t.atoms[3].readers); }},
      {"words that do not ascend", ImageStatus::kReaders, [](Opened& o) { exchange(o.t.readers[wide_row(o)], o.t.readers[wide_row(o) + 1]); }},
      {"a word twice", ImageStatus::kReaders, [](Opened& o) { set(o.t.readers[wide_row(o) + 1].word, o.t.readers[wide_row(o)].word); }},
      {"a word that is not there", ImageStatus::kReaders, [](Opened& o) { set(o.t.readers[0].word, o.t.shape.words); }},
      {"a row without rules", ImageStatus::kReaders, [](Opened& o) {
         set(o.t.readers[0].good[0], 0);
         set(o.t.readers[0].good[1], 0);
         set(o.t.readers[0].keyed, 0);
       }},
      {"a reader that does not ask", ImageStatus::kReaders, [](Opened& o) { set(o.t.readers[0].good[0], o.t.readers[0].good[0] ^ 1u << 5); }},
      {"a key that is no condition of the rule", ImageStatus::kKeys, [](Opened& o) { set(o.t.readers[row_of_key(o, false)].keyed, o.t.readers[row_of_key(o, false)].keyed | 1u); }},
      {"a rule without a key", ImageStatus::kReaders, [](Opened& o) {
         const auto& row = o.t.readers[row_of_key(o, true)];
         set(row.good[1], row.good[1] | 1u);
         set(row.keyed, row.keyed & ~1u);
       }},
  });
  expect_found({.large_group = 2, .broad = 1}, {
      {"an atom that is broad for a value that there is not", ImageStatus::kReaders, [](Opened& o) { set(o.t.broad[0], 4); }},
      {"broad atoms, of which there are none", ImageStatus::kReaders, [](Opened& o) { for (std::size_t a = 0; a < o.t.shape.atoms; ++a) set(o.t.broad[a], 0); }},
      {"a broad atom that lists its readers all the same", ImageStatus::kReaders, [](Opened& o) { for (std::size_t a = 0; a < o.t.shape.atoms; ++a) set(o.t.broad[a], 3); }},
  });
}

TEST(TamperedImage, WhoseEffectsAreWrongIsRefused) {
  expect_found({.large_group = 2}, {
      {"a fact that is written", ImageStatus::kWrites, [](Opened& o) { set(o.t.writes[0].cell, 0); }},
      {"a cell that is written twice", ImageStatus::kWrites, [](Opened& o) { set(o.t.writes[1].cell, o.t.writes[0].cell); }},
      {"a value that is not there", ImageStatus::kWrites, [](Opened& o) { set(o.t.writes[0].value, o.head.values); }},
      {"a value twice", ImageStatus::kWrites, [](Opened& o) { set(o.t.values[1], o.t.values[0]); }},
      {"a value that is no number", ImageStatus::kWrites, [](Opened& o) { set(o.t.values[0], std::numeric_limits<float>::quiet_NaN()); }},
      {"a value above 1", ImageStatus::kWrites, [](Opened& o) { set(o.t.values[o.head.values - 1], 1.5f); }},
      {"a group that is not there", ImageStatus::kWrites, [](Opened& o) { set(o.t.clears[0], o.t.shape.groups); }},
      {"fewer contests than there are", ImageStatus::kContested, [](Opened& o) { --o.head.shape.contested; }},
      {"a group that has a member more", ImageStatus::kGroups, [](Opened& o) { set(o.t.group_of[o.t.shape.satellites - 1], 1); }},
      {"members in another order", ImageStatus::kGroups, [](Opened& o) {
         const auto first = std::find(o.t.group_of, o.t.group_of + o.t.shape.satellites, 1) - o.t.group_of;
         exchange(o.t.group_slot[first], o.t.group_slot[first + 1]);
       }},
      {"a strategy that is there twice, and one that is not", ImageStatus::kPriority, [](Opened& o) { set(o.t.priority[0], o.t.priority[1]); }},
  });
}

TEST(TamperedImage, WhoseFactsAndTimersAreWrongIsRefused) {
  expect_found({.large_group = 2}, {
      {"two cells with one atom", ImageStatus::kAtoms, [](Opened& o) { set(o.t.fact_atoms[1].seen, o.t.fact_atoms[0].seen); }},
      {"an atom that no cell has", ImageStatus::kAtoms, [](Opened& o) { set(o.t.fact_atoms[39].seen, 0); }},
      {"a fact that stays in view less easily than it comes", ImageStatus::kFacts, [](Opened& o) { set(o.t.fact_atoms[0].attended, o.t.fact_atoms[0].plain + 0.1f); }},
      {"a threshold that is no number", ImageStatus::kFacts, [](Opened& o) { set(o.t.fact_atoms[0].plain, std::numeric_limits<float>::quiet_NaN()); }},
      {"attention to what is no fact", ImageStatus::kAttention, [](Opened& o) { set(o.t.attends[0], o.t.shape.facts); }},
      {"attention to a fact twice", ImageStatus::kAttention, [](Opened& o) { set(o.t.attends[o.head.attends - 1], o.t.attends[o.head.attends - 2]); }},
      {"a timer that times no atom", ImageStatus::kTimers, [](Opened& o) { set(o.t.timers[0].input, o.t.shape.atoms << 1); }},
      {"a timer that times itself", ImageStatus::kTimers, [](Opened& o) { set(o.t.timers[0].input, o.t.shape.first_timer() << 1); }},
      {"queues of a stage in another order", ImageStatus::kTimers, [](Opened& o) { exchange(o.t.queue_us[0], o.t.queue_us[1]); }},
      {"a stage without timers", ImageStatus::kTimers, [](Opened& o) { set(o.t.stages[0].end_timer, o.t.stages[0].first_timer); }},
      {"a timer that no atom lists", ImageStatus::kTimers, [](Opened& o) { set(o.t.timer_inputs[0], o.t.timer_inputs[1]); }},
  });
}

TEST(TamperedImage, WhoseStartUpOrPartsAreWrongIsRefused) {
  expect_found({.large_group = 2}, {
      {"a timer that is over at the beginning", ImageStatus::kInitial, [](Opened& o) {
         const std::uint32_t timer = o.t.shape.first_timer();
         set(o.t.initial_truth[timer / 32], o.t.initial_truth[timer / 32] | Word{1} << timer % 32);
       }},
      {"an atom 1 that is true", ImageStatus::kInitial, [](Opened& o) { set(o.t.initial_truth[0], o.t.initial_truth[0] | 2u); }},
      {"a satellite that begins above 1", ImageStatus::kInitial, [](Opened& o) { set(o.t.initial[0], 2.0f); }},
      {"a satellite that begins high, and an atom that says that it does not", ImageStatus::kInitial, [](Opened& o) { set(o.t.initial[0], 1.0f); }},
      {"a bit behind the last satellite", ImageStatus::kInitial, [](Opened& o) { set(o.t.keep[(o.t.shape.satellites - 1) / 32], kLast); }},
      {"a part too many that holds", ImageStatus::kInitial, [](Opened& o) { set(o.t.initial_count[0], o.t.initial_count[0] + 1); }},
      {"a node that needs neither one part nor all", ImageStatus::kNodes, [](Opened& o) {
         const auto* either = std::find_if(o.t.nodes, o.t.nodes + o.t.shape.nodes, [](const auto& node) { return node.need == 1; });
         set(either->need, 2);
       }},
      {"a part that comes after its whole", ImageStatus::kNodes, [](Opened& o) {
         const std::uint32_t last = o.t.shape.atoms - 1;   // takes the last part of the last atom that has any
         for (std::uint32_t a = last; o.t.atoms[a].parents == o.head.parents; --a) set(o.t.atoms[a].parents, o.head.parents - 1);
       }},
      {"an `or` that counts as an `and`", ImageStatus::kStrengths, [](Opened& o) { set(o.t.is_and[0], o.t.is_and[0] ^ 1); }},
      {"a term of another cell", ImageStatus::kStrengths, [](Opened& o) {
         const auto* term = std::find_if(o.t.atom_cell, o.t.atom_cell + o.t.shape.atoms, [&](std::uint32_t cell) { return cell != o.t.shape.cells(); });
         set(*term, *term + 1);
       }},
      {"parts in another order", ImageStatus::kStrengths, [](Opened& o) { exchange(o.t.children[0], o.t.children[1]); }},
      {"two names in another order", ImageStatus::kNames, [](Opened& o) { exchange(o.view.names.order[0], o.view.names.order[1]); }},
      {"a name that is not UTF-8", ImageStatus::kNames, [](Opened& o) { set(o.view.names.bytes[0], '\xFF'); }},
      {"two names that are the same", ImageStatus::kNames, [](Opened& o) { set(o.view.names.bytes[o.view.names.begin[1] + 1], o.view.names.bytes[o.view.names.begin[0] + 1]); }},
  });
}

}  // namespace
}  // namespace kb::tables

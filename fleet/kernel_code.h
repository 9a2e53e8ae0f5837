// The building blocks of emitted kernels, for words of KB_FLEET_WIDTH bits. Included several times, each time within the emitted source's
// namespace for that width: see note [one source, several widths].

#if KB_FLEET_WIDTH == 64
using V = std::uint64_t;
[[gnu::always_inline]] inline bool any(V x) { return x != 0; }
[[gnu::always_inline]] inline V all_of(bool yes) { return V{0} - V{yes}; }
#elif KB_FLEET_WIDTH == 256
typedef std::uint64_t V __attribute__((vector_size(32), may_alias));
[[gnu::always_inline]] inline bool any(V x) {
  return _mm256_testz_si256(reinterpret_cast<__m256i>(x), reinterpret_cast<__m256i>(x)) == 0;
}
[[gnu::always_inline]] inline V all_of(bool yes) {
  const std::uint64_t w = std::uint64_t{0} - std::uint64_t{yes};
  return V{w, w, w, w};
}
#else
typedef std::uint64_t V __attribute__((vector_size(64), may_alias));
[[gnu::always_inline]] inline bool any(V x) {
  return _mm512_test_epi64_mask(reinterpret_cast<__m512i>(x), reinterpret_cast<__m512i>(x)) != 0;
}
[[gnu::always_inline]] inline V all_of(bool yes) {
  const std::uint64_t w = std::uint64_t{0} - std::uint64_t{yes};
  return V{w, w, w, w, w, w, w, w};
}
#endif

constexpr std::uint32_t kWidthWords = sizeof(V) / 8;

/// One word of robots: its part of each plane of a block.
class Word {
 public:
  Word(const mts::FleetTick& tick, const mts::FleetBlock& block, std::uint32_t word)
      : tick_(tick), block_(block), word_(word), given_(block.given + word * sizeof(V)), before_(block.before + word * sizeof(V)),
        now_(block.now + word * sizeof(V)), contested_(all_of(false)) {}

  /// A plane that the host gives.
  [[gnu::always_inline]] V given(Plane plane) const { return at(given_, static_cast<std::uint32_t>(plane)); }
  /// A plane as the last tick left it.
  [[gnu::always_inline]] V before(Plane plane) const { return at(before_, made(plane)); }
  /// A plane as this tick has stored it.
  [[gnu::always_inline]] V now(Plane plane) const { return at(now_, made(plane)); }
  [[gnu::always_inline]] void put(Plane plane, V value) { at(now_, made(plane)) = value; }
  [[gnu::always_inline]] V later() const { return all_of(!tick_.first); }
  /// Makes the compiler read what has been stored again from here on: there are many more planes than registers, and a value that it kept
  /// would be spilled, that is, stored a second time.
  [[gnu::always_inline]] void settle() const {
    asm volatile("" ::: "memory");
    block_.ahead->fetch(mts::FleetAhead::kPart);
  }

  /// The robots in which the timer is over. `input`: its condition; `on`: the same on the last tick; `over`: where it was over then.
  [[gnu::always_inline]] V timer(std::uint32_t timer, std::uint32_t queue, V input, V on, V over) const {
    return run(timer, queue, tick_.stamp, input, on, over);
  }
  /// The same for how long the last strategy may be held, counted from the tick before.
  [[gnu::always_inline]] V hold(std::uint32_t timer, std::uint32_t queue, V input, V on, V over) const {
    return run(timer, queue, tick_.last_stamp, input, on, over);
  }

  /// Notes robots that need the scalar engine.
  [[gnu::always_inline]] void contest(V robots) { contested_ |= robots; }
  [[gnu::always_inline]] void fall_back() const {
    if (!any(contested_)) return;
    alignas(64) std::uint64_t words[kWidthWords];
    *reinterpret_cast<V*>(words) = contested_;
    tick_.fall_back(tick_.fleet, block_, word_ * kWidthWords, words, kWidthWords);
  }

 private:
  [[gnu::always_inline]] V run(std::uint32_t timer, std::uint32_t queue, std::uint32_t stamp, V input, V on, V over) const {
    const V still = over & input;
    const V waits = input & ~still;
    if (!any(waits)) return still;
    return still | wait(tick_, block_, word_, timer, queue, stamp, waits, input & ~on);
  }

  static constexpr std::uint32_t made(Plane plane) { return static_cast<std::uint32_t>(plane) - kGivenPlanes; }
  [[gnu::always_inline]] static V& at(std::byte* planes, std::uint32_t plane) {
    return *reinterpret_cast<V*>(planes + std::size_t{plane} * mts::kPlaneBytes);
  }
  [[gnu::always_inline]] static const V& at(const std::byte* planes, std::uint32_t plane) {
    return *reinterpret_cast<const V*>(planes + std::size_t{plane} * mts::kPlaneBytes);
  }

  /// Stamps the robots in `begin`, and returns those of `waits` whose stamp is ripe.
  [[gnu::noinline]] static V wait(const mts::FleetTick& tick, const mts::FleetBlock& block, std::uint32_t word, std::uint32_t timer,
                                  std::uint32_t queue, std::uint32_t stamp, V waits, V begin) {
    const std::uint32_t bits = tick.bits[queue], ripe = tick.ripe[queue], before = tick.ripe_before[queue];
    std::byte* const stamps = tick.stamps[timer] + (std::size_t{block.index} * bits) * mts::kPlaneBytes + word * sizeof(V);
    std::uint32_t& oldest = block.oldest[std::size_t{word} * kWidthWords * (sizeof(kTimers) / sizeof(*kTimers)) + timer];
    const bool at_once = stamp < ripe;   // `for 0 s`
    if (bits <= kShortStamp && ripe - before <= 1 && !at_once) {
      oldest = ripe;
      return wait_shortly(stamps, bits, stamp, ripe - 1, waits & all_of(ripe != before), begin);
    }
    if (oldest >= ripe && !any(begin)) return all_of(false);
    if (any(begin)) {
      for (std::uint32_t b = 0; b < bits; ++b) {
        V& plane = at(stamps, b);
        plane = (stamp >> b & 1u) != 0 ? plane | begin : plane & ~begin;
      }
      if (!any(waits & ~begin)) oldest = stamp;
    }
    if (oldest >= ripe && !at_once) return all_of(false);
    V over = at_once ? begin : all_of(false);
    for (std::uint32_t s = oldest < before ? before : oldest; s < ripe; ++s) over |= stamped(stamps, bits, s, waits);
    oldest = ripe;
    if (bits > kShortStamp && any(waits & ~over)) oldest = find_oldest(stamps, bits, ripe, stamp, waits & ~over);
    return over;
  }

  /// The same where at most one stamp has become ripe. It does not branch on whether any robot has it, which a processor would mispredict.
  static V wait_shortly(std::byte* stamps, std::uint32_t bits, std::uint32_t stamp, std::uint32_t ripe, V among, V begin) {
    for (std::uint32_t b = 0; b < bits; ++b) {
      V& plane = at(stamps, b);
      plane ^= (plane ^ all_of((stamp >> b & 1u) != 0)) & begin;
      among &= ~(plane ^ all_of((ripe >> b & 1u) != 0));
    }
    return among;
  }

  /// Those of `among` whose stamp is `s`.
  static V stamped(std::byte* stamps, std::uint32_t bits, std::uint32_t s, V among) {
    for (std::uint32_t b = 0; b < bits; ++b) among &= (s >> b & 1u) != 0 ? at(stamps, b) : ~at(stamps, b);
    return among;
  }

  /// The oldest stamp of the robots in `among`; all their stamps are from `ripe` to `newest`, and less than 2^bits apart.
  static std::uint32_t find_oldest(std::byte* stamps, std::uint32_t bits, std::uint32_t ripe, std::uint32_t newest, V among) {
    const std::uint32_t mask = (std::uint32_t{1} << bits) - 1u;
    if ((newest & mask) < (ripe & mask)) {  // the low bits have wrapped: stamps whose bits have not are older
      V above = all_of(false), equal = among;
      for (std::uint32_t b = bits; b-- > 0;) {
        const V plane = at(stamps, b);
        if ((ripe >> b & 1u) == 0) above |= equal & plane;
        equal &= (ripe >> b & 1u) != 0 ? plane : ~plane;
      }
      if (any(above | equal)) among = above | equal;
    }
    std::uint32_t low = 0;
    for (std::uint32_t b = bits; b-- > 0;) {
      const V without = among & ~at(stamps, b);
      if (any(without)) among = without;
      else low |= std::uint32_t{1} << b;
    }
    return ripe + ((low - ripe) & mask);
  }

  /// With stamps of at most so many bits it is cheaper to look at all of them than to find out which is the oldest.
  static constexpr std::uint32_t kShortStamp = 5;

  const mts::FleetTick& tick_;
  const mts::FleetBlock& block_;
  std::uint32_t word_;
  const std::byte* given_;
  const std::byte* before_;
  std::byte* now_;
  V contested_;
};

// The building blocks of emitted kernels, for words of KB_FLEET_WIDTH bits. Included several times, each time within the emitted source's
// namespace for that width: see note [one source, several widths].

#if KB_FLEET_WIDTH == 64
using V = std::uint64_t;
[[gnu::always_inline]] inline bool any(V x) { return x != 0; }
[[gnu::always_inline]] inline V spread(std::uint64_t w) { return w; }
#elif KB_FLEET_WIDTH == 256
typedef std::uint64_t V __attribute__((vector_size(32), may_alias));
[[gnu::always_inline]] inline bool any(V x) {
  return _mm256_testz_si256(reinterpret_cast<__m256i>(x), reinterpret_cast<__m256i>(x)) == 0;
}
[[gnu::always_inline]] inline V spread(std::uint64_t w) { return V{w, w, w, w}; }
#else
typedef std::uint64_t V __attribute__((vector_size(64), may_alias));
[[gnu::always_inline]] inline bool any(V x) {
  return _mm512_test_epi64_mask(reinterpret_cast<__m512i>(x), reinterpret_cast<__m512i>(x)) != 0;
}
[[gnu::always_inline]] inline V spread(std::uint64_t w) { return V{w, w, w, w, w, w, w, w}; }
#endif
[[gnu::always_inline]] inline V all_of(bool yes) { return spread(std::uint64_t{0} - std::uint64_t{yes}); }

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
    return run(timer, queue, tick_.stamp, tick_.stamp_bits, input, on, over);
  }
  /// The same for how long the last strategy may be held, counted from the tick before.
  [[gnu::always_inline]] V hold(std::uint32_t timer, std::uint32_t queue, V input, V on, V over) const {
    return run(timer, queue, tick_.last_stamp, tick_.last_bits, input, on, over);
  }

  /// What is known of the timers of this word.
  struct Oldest { std::uint32_t stamps[sizeof(kTimers) / sizeof(*kTimers)]; };
  [[nodiscard]] Oldest oldest() const {
    Oldest copy;
    std::memcpy(copy.stamps, &oldest_of(block_, word_, 0), sizeof(copy.stamps));
    return copy;
  }
  /// Of a resting kernel: whether it has to give up. Then it leaves timers as they were; stamps it has given them will be given again.
  [[gnu::always_inline]] bool wakes(V robots, const Oldest& oldest) const {
    if (!any(robots & at(reinterpret_cast<const std::byte*>(block_.robots + word_ * kWidthWords), 0))) return false;
    std::memcpy(&oldest_of(block_, word_, 0), oldest.stamps, sizeof(oldest.stamps));
    return true;
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
  [[gnu::always_inline]] V run(std::uint32_t timer, std::uint32_t queue, std::uint32_t stamp, const std::uint64_t* bits, V input, V on,
                               V over) const {
    const V still = over & input;
    const V waits = input & ~still;
    if (!any(waits)) return still;
    const mts::FleetQueue& q = tick_.queues[queue];
    if (q.short_bits != 0) return still | wait_shortly(q, timer, tick_.ripe[queue], bits, waits, input & ~on);
    if (q.long_bits != 0) return still | wait_long(q, timer, queue, stamp, bits, waits, input & ~on);
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
    std::byte* const stamps = stamps_of(tick, block, word, timer, bits);
    std::uint32_t& oldest = oldest_of(block, word, timer);
    const bool at_once = stamp < ripe;   // `for 0 s`
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
    if (bits > mts::FleetQueue::kShort && any(waits & ~over)) oldest = find_oldest(stamps, bits, ripe, stamp, waits & ~over);
    return over;
  }

  /// The same for stamps of a few bits, where at most one stamp has become ripe. It does not branch on whether any robot has it, which a
  /// processor would mispredict. Each of a few durations has its number of bits, so the way out of the loop is guessed right.
  [[gnu::always_inline]] V wait_shortly(const mts::FleetQueue& q, std::uint32_t timer, std::uint32_t ripe, const std::uint64_t* bits, V waits,
                                        V begin) const {
    std::byte* const stamps = stamps_of(tick_, block_, word_, timer, q.short_bits);
    oldest_of(block_, word_, timer) = ripe;
    V among = waits & spread(q.rises);
#pragma GCC unroll 5
    for (std::uint32_t b = 0; b < mts::FleetQueue::kShort; ++b) {
      V plane = at(stamps, b);
      plane ^= (plane ^ spread(bits[b])) & begin;
      at(stamps, b) = plane;
      among &= ~(plane ^ spread(q.ripe[b]));
      if (q.short_bits == b + 1) break;
    }
    return among;
  }

  /// The same for stamps of many bits: they are compared only where one may be ripe.
  [[gnu::always_inline]] V wait_long(const mts::FleetQueue& q, std::uint32_t timer, std::uint32_t queue, std::uint32_t stamp, const std::uint64_t* bits,
                                     V waits, V begin) const {
    std::byte* const stamps = stamps_of(tick_, block_, word_, timer, q.long_bits);
    std::uint32_t& oldest = oldest_of(block_, word_, timer);
    for (std::uint32_t b = 0; b < q.long_bits; ++b) at(stamps, b) ^= (at(stamps, b) ^ spread(bits[b])) & begin;
    if (!any(waits & ~begin)) oldest = stamp;
    if (oldest >= tick_.ripe[queue]) return all_of(false);
    return wait(tick_, block_, word_, timer, queue, stamp, waits, all_of(false));
  }

  [[nodiscard]] static std::byte* stamps_of(const mts::FleetTick& tick, const mts::FleetBlock& block, std::uint32_t word, std::uint32_t timer,
                                            std::uint32_t bits) {
    return tick.stamps[timer] + (std::size_t{block.index} * bits) * mts::kPlaneBytes + word * sizeof(V);
  }
  [[nodiscard]] static std::uint32_t& oldest_of(const mts::FleetBlock& block, std::uint32_t word, std::uint32_t timer) {
    return block.oldest[std::size_t{word} * kWidthWords * (sizeof(kTimers) / sizeof(*kTimers)) + timer];
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

  const mts::FleetTick& tick_;
  const mts::FleetBlock& block_;
  std::uint32_t word_;
  const std::byte* given_;
  const std::byte* before_;
  std::byte* now_;
  V contested_;
};

// Readings with names: `readings.range[2] = {0.31f, now}`. The generated `Readings` of a knowledge base is a union of its store and of
// empty slots at the store's address, as `Facts` is (runtime/facts.h).
#pragma once

#include <cstdint>

namespace mts {

/// A moment of the host's own clock, in microseconds from any origin; only differences count. It must never wrap: after a wrap, the
/// sensors' next readings and the clock would not be of one time. Widen a 32-bit counter: `wide.us += std::uint32_t(counter - std::uint32_t(wide.us))`.
struct Instant {
  std::int64_t us = 0;
};

/// How long before `now` something was, in microseconds; below 0: after it. Saturates if the difference does not fit 64 bits.
[[nodiscard]] constexpr std::int64_t age_at(Instant now, std::int64_t at_us) {
  std::int64_t age = 0;
  if (!__builtin_sub_overflow(now.us, at_us, &age)) return age;
  return at_us < 0 ? INT64_MAX : INT64_MIN;
}

/// What a sensor measured, and when.
struct Reading {
  float value = 0.0f;   ///< in the unit in which the sensor is kept: metres, seconds, degrees, metres a second
  Instant at;
};
struct TextReading {
  const char* value = "";   ///< ends with a zero byte; need not outlive the assignment. Null: nothing was read
  Instant at;
};

/// The last reading of every element of every sensor. A reading stays until the next one or until it is forgotten; its age decides how much
/// it still counts. Nothing is checked here: perception deals with NaN and the like.
template <std::uint32_t kCount>
struct ReadingStore {
  float value[kCount] = {};         ///< of a text: its number among those the knowledge base knows, from 1; 0 for any other
  std::int64_t at_us[kCount] = {};
  std::uint8_t there[kCount] = {};  ///< 1 if there is a reading

  constexpr void set(std::uint32_t reading, float v, Instant at) {
    value[reading] = v;
    at_us[reading] = at.us;
    there[reading] = 1;
  }
  constexpr void forget(std::uint32_t reading) { there[reading] = 0; }
};

/// The number of `text`, from 1, among `count` texts in ascending order of their bytes; 0 if it is none of them.
[[nodiscard]] constexpr std::uint32_t find_text(const char* const* texts, std::uint32_t count, const char* text) {
  std::uint32_t low = 0;
  while (count != 0) {
    const std::uint32_t half = count / 2;
    const char* a = texts[low + half];
    const char* b = text;
    for (; *a != '\0' && *a == *b; ++a) ++b;
    if (*a == *b) return low + half + 1;
    const bool below = static_cast<unsigned char>(*a) < static_cast<unsigned char>(*b);
    low = below ? low + half + 1 : low;
    count = below ? count - half - 1 : half;
  }
  return 0;
}

/// A sensor of one number. It cannot be copied, so `auto x = readings.compass` does not compile.
template <class Store, std::uint32_t kReading>
struct NumberSlot {
  NumberSlot() = default;
  NumberSlot(const NumberSlot&) = delete;
  NumberSlot& operator=(const NumberSlot&) = delete;
  NumberSlot& operator=(Reading reading) {
    static_cast<Store*>(static_cast<void*>(this))->set(kReading, reading.value, reading.at);
    return *this;
  }
  /// Forgets the reading: from now on the sensor is silent.
  void forget() { static_cast<Store*>(static_cast<void*>(this))->forget(kReading); }
};

/// One of an array of sensors, for the length of an assignment. It cannot be copied, and is no reading: nothing tells what was assigned.
template <class Store>
class NumberElement {
 public:
  NumberElement(Store* store, std::uint32_t reading) : store_(store), reading_(reading) {}
  NumberElement(const NumberElement&) = delete;
  NumberElement& operator=(const NumberElement&) = delete;
  NumberElement& operator=(Reading reading) {
    store_->set(reading_, reading.value, reading.at);
    return *this;
  }
  void forget() { store_->forget(reading_); }

 private:
  Store* store_;
  std::uint32_t reading_;
};

/// An array of `kCount` sensors, from 0. An index beyond the end selects the last one, so no memory outside the store is accessed.
template <class Store, std::uint32_t kFirst, std::uint32_t kCount>
struct NumberArray {
  NumberArray() = default;
  NumberArray(const NumberArray&) = delete;
  NumberArray& operator=(const NumberArray&) = delete;
  NumberElement<Store> operator[](std::uint32_t i) {
    return {static_cast<Store*>(static_cast<void*>(this)), kFirst + (i < kCount ? i : kCount - 1)};
  }
};

/// One sensor of text, for the length of an assignment. `Texts` has `kTexts`, those that the knowledge base knows, ascending,
/// and `kCount`.
template <class Store, class Texts>
class TextElement {
 public:
  TextElement(Store* store, std::uint32_t reading) : store_(store), reading_(reading) {}
  TextElement(const TextElement&) = delete;
  TextElement& operator=(const TextElement&) = delete;
  TextElement& operator=(TextReading reading) {
    if (reading.value == nullptr) forget();
    else store_->set(reading_, static_cast<float>(find_text(Texts::kTexts, Texts::kCount, reading.value)), reading.at);
    return *this;
  }
  void forget() { store_->forget(reading_); }

 private:
  Store* store_;
  std::uint32_t reading_;
};

/// A sensor of text, or an array of them (then the slot itself is the first).
template <class Store, std::uint32_t kFirst, std::uint32_t kCount, class Texts>
struct TextSlot {
  TextSlot() = default;
  TextSlot(const TextSlot&) = delete;
  TextSlot& operator=(const TextSlot&) = delete;
  TextSlot& operator=(TextReading reading) {
    (*this)[0] = reading;
    return *this;
  }
  void forget() { (*this)[0].forget(); }
  TextElement<Store, Texts> operator[](std::uint32_t i) {
    return {static_cast<Store*>(static_cast<void*>(this)), kFirst + (i < kCount ? i : kCount - 1)};
  }
};

}  // namespace mts

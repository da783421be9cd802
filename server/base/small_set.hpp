#pragma once

namespace fitgauge {

/// A set of up to 128 numbers or values of an enumeration from `first` on, which can be a constant.
template <class T, T first = T{}>
class SmallSet {
 public:
  constexpr SmallSet() = default;
  constexpr SmallSet(std::same_as<T> auto... values) { (insert(values), ...); }  // NOLINT: a list

  /// @pre the value is one of the 128
  constexpr void insert(T value) { words_[place(value) / 64] |= bit(value); }
  constexpr void erase(T value) { words_[place(value) / 64] &= ~bit(value); }
  constexpr bool contains(T value) const {
    if constexpr (!std::is_enum_v<T>) {
      if (place(value) >= 128) return false;
    }
    return (words_[place(value) / 64] & bit(value)) != 0;
  }
  friend constexpr SmallSet operator&(SmallSet a, SmallSet b) {
    a.words_[0] &= b.words_[0];
    a.words_[1] &= b.words_[1];
    return a;
  }
  friend constexpr SmallSet operator|(SmallSet a, SmallSet b) {
    a.words_[0] |= b.words_[0];
    a.words_[1] |= b.words_[1];
    return a;
  }

 private:
  static constexpr unsigned place(T value) {
    return static_cast<unsigned>(value) - static_cast<unsigned>(first);
  }
  static constexpr std::uint64_t bit(T value) { return std::uint64_t{1} << (place(value) % 64); }

  std::uint64_t words_[2] = {0, 0};
};

}  // namespace fitgauge

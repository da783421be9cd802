#pragma once

#include <doctest/doctest.h>

#include <random>

namespace fitgauge::store::test {

/// Reads what is left of packed bytes on a damaged disk: cut short they are refused, and with one
/// byte changed read as something, never behind their end (AddressSanitizer looks).
/// @param read whether bytes can be read
template <class Read>
void read_damaged(const std::string& whole, std::mt19937_64& random, const Read& read) {
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 40) {
    CHECK_FALSE(read(std::string(whole.data(), size)));
  }
  for (int i = 0; i < 300; ++i) {
    std::string bytes = whole;
    bytes[random() % bytes.size()] = static_cast<char>(random());
    static_cast<void>(read(bytes));
  }
}

}  // namespace fitgauge::store::test

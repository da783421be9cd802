#pragma once

#include <doctest/doctest.h>

/// doctest 2.4.9 prints the address of a text: CAPTURE(row.what) would not name its row.
template <>
struct doctest::StringMaker<const char*> {
  static String convert(const char* text) { return text != nullptr ? text : "NULL"; }
};

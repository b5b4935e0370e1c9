// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstring>
#include <ostream>
#include <string>
#include <vector>

namespace palpate::formats {

/// A small file of one format.
struct Sample {
  std::string name;  ///< For the test's name: letters, digits, "_".
  std::string extension;
  std::string bytes;
};
inline void PrintTo(const Sample& sample, std::ostream* out) { *out << sample.name; }

inline bool littleEndianHost() {
  const short one = 1;
  char first = 0;
  std::memcpy(&first, &one, 1);
  return first == 1;
}

/// Appends `value` as it lies in a file of the given byte order.
template <class T>
void put(std::string* bytes, T value, bool big_endian = false) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  const bool swap = big_endian == littleEndianHost();
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes->push_back(raw[swap ? sizeof(T) - 1 - i : i]);
}

template <class T>
std::string packed(const std::vector<double>& values, bool big_endian = false) {
  std::string bytes;
  for (const double value : values) put(&bytes, static_cast<T>(value), big_endian);
  return bytes;
}

}  // namespace palpate::formats

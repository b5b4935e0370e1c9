// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

namespace palpate::formats {

/// Type of a number in a binary file.
struct ScalarType {
  enum Kind { kSigned, kUnsigned, kFloat } kind = kFloat;
  std::size_t size = 8;  ///< [bytes] 1, 2, 4 or 8; floats 4 or 8.
};

std::optional<ScalarType> plyType(std::string_view name);  ///< "uchar", "float32", ...
std::optional<ScalarType> vtkType(std::string_view name);  ///< "vtktypeint64", "float", ...
std::optional<ScalarType> vtuType(std::string_view name);  ///< "Int64", "Float32", ...

bool hostIsLittleEndian();

/// Loads the bytes at `p` as a T, in reversed byte order if `swap`.
template <class T>
T load(const char* p, bool swap) {
  char bytes[sizeof(T)];
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes[i] = p[swap ? sizeof(T) - 1 - i : i];
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

/// Loads the number of `type` at `p` as a double. Integers beyond 2^53 are rounded; indices are
/// smaller.
double loadNumber(const char* p, ScalarType type, bool swap);

}  // namespace palpate::formats

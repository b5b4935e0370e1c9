// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace palpate {

/// Serialises state as bytes, opaque to others. Equal states give equal bytes; StateReader reads in
/// the same order. For the same machine only (byte order, size of int).
class StateWriter {
 public:
  template <class T>
  std::enable_if_t<std::is_arithmetic_v<T> || std::is_enum_v<T>> put(const T& value) {
    append(&value, sizeof(T));
  }
  template <class T, int Rows, int Cols, int Options, int MaxRows, int MaxCols>
  void put(const Eigen::Matrix<T, Rows, Cols, Options, MaxRows, MaxCols>& values) {
    put(static_cast<std::int64_t>(values.rows()));
    put(static_cast<std::int64_t>(values.cols()));
    append(values.data(), sizeof(T) * static_cast<std::size_t>(values.size()));
  }
  void put(std::string_view bytes) {
    put(static_cast<std::int64_t>(bytes.size()));
    append(bytes.data(), bytes.size());
  }
  template <class T>
  void put(const std::vector<T>& values) {
    put(static_cast<std::int64_t>(values.size()));
    for (const T& value : values) put(value);
  }

  const std::string& bytes() const { return bytes_; }
  /// Clears the bytes but keeps their buffer.
  void clear() { bytes_.clear(); }

 private:
  void append(const void* data, std::size_t size) {
    bytes_.append(static_cast<const char*>(data), size);
  }
  std::string bytes_;
};

/// Reads the bytes of a StateWriter. Functions throw std::invalid_argument for bytes that end early
/// or have another structure. Allocations are at most a few times the remaining bytes.
class StateReader {
 public:
  /// `bytes` must outlive the reader.
  explicit StateReader(std::string_view bytes) : left_(bytes) {}

  template <class T>
  std::enable_if_t<std::is_arithmetic_v<T> || std::is_enum_v<T>> get(T* value) {
    if constexpr (std::is_same_v<T, bool>) {  // other bytes are no bool
      unsigned char byte = 0;
      take(&byte, 1);
      if (byte > 1) fail();
      *value = byte == 1;
    } else {
      take(value, sizeof(T));
    }
  }
  template <class T, int Rows, int Cols, int Options, int MaxRows, int MaxCols>
  void get(Eigen::Matrix<T, Rows, Cols, Options, MaxRows, MaxCols>* values) {
    const std::int64_t rows = count(1), cols = count(1);
    const bool fits =
        (Rows == Eigen::Dynamic || rows == Rows) && (Cols == Eigen::Dynamic || cols == Cols) &&
        (rows == 0 || cols <= static_cast<std::int64_t>(left_.size() / sizeof(T)) / rows);
    if (!fits) fail();
    values->resize(rows, cols);
    take(values->data(), sizeof(T) * static_cast<std::size_t>(values->size()));
  }
  /// Reads a matrix or array of its present size; leaves it on refusal.
  template <class Values>
  void getSame(Values* values) {
    Values read;
    get(&read);
    if (read.size() != values->size()) fail();
    *values = std::move(read);
  }
  void get(std::string* bytes) {
    const std::int64_t size = count(1);
    bytes->assign(left_.substr(0, static_cast<std::size_t>(size)));
    left_.remove_prefix(static_cast<std::size_t>(size));
  }
  template <class T>
  void get(std::vector<T>* values) {
    // All types but plain numbers begin with a count.
    constexpr bool plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;
    values->clear();
    values->resize(static_cast<std::size_t>(count(plain ? sizeof(T) : sizeof(std::int64_t))));
    for (T& value : *values) get(&value);
  }
  /// Reads a count of items that take at least `least` bytes each of the remaining ones.
  std::int64_t count(std::int64_t least) {
    std::int64_t number = 0;
    get(&number);
    if (number < 0 || number > static_cast<std::int64_t>(left_.size()) / least) fail();
    return number;
  }
  /// @throws std::invalid_argument unless all bytes were read.
  void finish() const {
    if (!left_.empty()) fail();
  }

  /// @throws std::invalid_argument: the bytes belong to another object.
  [[noreturn]] static void fail() {
    throw std::invalid_argument("the state is cut off, or not one of this scene");
  }

 private:
  void take(void* data, std::size_t size) {
    if (size > left_.size()) fail();
    if (size > 0) std::memcpy(data, left_.data(), size);
    left_.remove_prefix(size);
  }
  std::string_view left_;
};

}  // namespace palpate

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scalar_type.h"

namespace tinyxml2 {
class XMLElement;
}

namespace palpate::formats {

/// How a VTK XML file keeps its numbers, and the numbers themselves. Where a DataArray has format
///
///   ascii     its text is the numbers;
///   binary    its text is base64 of a block;
///   appended  its block lies at `offset` in the file's AppendedData, raw or base64.
///
/// A block is [bytes][data], or, compressed by zlib,
/// [number of parts][bytes of a part][bytes of the last one, 0: full][compressed bytes of each]
/// and the parts; in base64 the latter's header is encoded by itself. All in the file's byte order.
class VtuData {
 public:
  /// Of the VTKFile element of a file of so many bytes; `appended` begins behind the "_".
  /// @throws InputError for a byte_order, header_type or compressor that is not known.
  VtuData(std::string file, const tinyxml2::XMLElement& root, std::size_t bytes,
          std::string_view appended, bool appended_raw);

  /// The `count` numbers of a DataArray. @throws InputError if it has not so many, or more are
  /// asked for by and by than a file of that size can have: compressed data and arrays that share a
  /// block could multiply without end.
  std::vector<double> numbers(const tinyxml2::XMLElement& array, std::size_t count);

  [[noreturn]] void fail(const tinyxml2::XMLElement& element, const std::string& value,
                         const std::string& allowed) const;

 private:
  std::string block(const tinyxml2::XMLElement& array, std::size_t size) const;
  void checkRoom(const tinyxml2::XMLElement& array, std::size_t size, std::size_t room) const;

  void take(const tinyxml2::XMLElement& array, std::size_t count);

  std::string file_;
  std::size_t most_, left_;  // numbers
  std::string_view appended_;
  bool appended_raw_;
  bool swap_ = false;
  bool compressed_ = false;
  ScalarType header_type_{ScalarType::kUnsigned, 4};
};

}  // namespace palpate::formats

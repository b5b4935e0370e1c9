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

/// Numbers of a VTK XML file. By the format of a DataArray,
///
///   ascii     its text is the numbers;
///   binary    its text is base64 of a block;
///   appended  its block lies at `offset` in the file's AppendedData, raw or base64.
///
/// A block is [bytes][data], or, compressed by zlib, [number of parts][bytes per part][bytes of the
/// last part, 0: full][compressed bytes of each part] and the parts; in base64 the header of the
/// latter is encoded separately. Byte order is the file's.
class VtuData {
 public:
  /// For the VTKFile element of a file of `bytes` bytes; `appended` begins after the "_".
  /// @throws InputError for an unknown byte_order, header_type or compressor.
  VtuData(std::string file, const tinyxml2::XMLElement& root, std::size_t bytes,
          std::string_view appended, bool appended_raw);

  /// The `count` numbers of a DataArray. @throws InputError for another count, or if the total of
  /// all calls exceeds the limit for the file's size: compressed data and shared blocks could
  /// multiply without bound.
  std::vector<double> numbers(const tinyxml2::XMLElement& array, std::size_t count);

  [[noreturn]] void fail(const tinyxml2::XMLElement& element, const std::string& value,
                         const std::string& allowed) const;

 private:
  std::string block(const tinyxml2::XMLElement& array, std::size_t size) const;
  void checkRoom(const tinyxml2::XMLElement& array, std::size_t size, std::size_t room) const;

  void take(const tinyxml2::XMLElement& array, std::size_t count);

  std::string file_;
  std::size_t most_, left_;  // limit and rest of numbers
  std::string_view appended_;
  bool appended_raw_;
  bool swap_ = false;
  bool compressed_ = false;
  ScalarType header_type_{ScalarType::kUnsigned, 4};
};

}  // namespace palpate::formats

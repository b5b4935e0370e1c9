// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace palpate::node {

/// One record of a bag [rosbag format 2.0]: its header's fields, and where its data is.
struct BagRecord {
  std::map<std::string, std::string, std::less<>> fields;
  std::uint64_t place = 0;  ///< Of the record in the file or in the chunk [byte].
  std::uint64_t data = 0;   ///< Of its data.
  std::uint32_t size = 0;   ///< Of its data [bytes].

  /// What kind it is.
  enum Op : unsigned char {
    kMessage = 2,
    kFile = 3,
    kIndex = 4,
    kChunk = 5,
    kChunkInfo = 6,
    kConnection = 7
  };

  bool is(Op op) const;
  /// A number of 4 or 8 bytes, by the field's name. @throws BagFault if it is not there or of
  /// another size.
  std::uint32_t number(std::string_view field) const;
  std::uint64_t longNumber(std::string_view field) const;
  std::uint64_t end() const { return data + size; }
};

/// What is wrong with a bag, and where.
struct BagFault {
  std::uint64_t place;
  std::string what;
};

/// Fields "name=value", each behind its length, that fill the bytes. `place` is theirs, for faults.
/// @throws BagFault
std::map<std::string, std::string, std::less<>> bagFields(std::string_view bytes,
                                                          std::uint64_t place);

/// The record that begins at `at` of the bytes; its data lies in them.
/// @throws BagFault
BagRecord bagRecord(std::string_view bytes, std::uint64_t at);

/// The number that stands there, little-endian; the bytes must be there.
std::uint32_t bagNumber(std::string_view bytes, std::uint64_t at);

}  // namespace palpate::node

// SPDX-License-Identifier: GPL-3.0-or-later
#include "bag_records.h"

#include <utility>

namespace palpate::node {
namespace {

std::uint64_t little(std::string_view bytes) {
  std::uint64_t number = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) {
    number = number << 8 | static_cast<unsigned char>(bytes[i]);
  }
  return number;
}

std::uint64_t fieldOf(const BagRecord& record, std::string_view name, std::size_t size) {
  const auto found = record.fields.find(name);
  if (found == record.fields.end() || found->second.size() != size) {
    throw BagFault{record.place, "a record has no field '" + std::string(name) + "' of " +
                                     std::to_string(size) + " bytes"};
  }
  return little(found->second);
}

}  // namespace

bool BagRecord::is(Op op) const { return fieldOf(*this, "op", 1) == op; }
std::uint32_t BagRecord::number(std::string_view field) const {
  return static_cast<std::uint32_t>(fieldOf(*this, field, 4));
}
std::uint64_t BagRecord::longNumber(std::string_view field) const {
  return fieldOf(*this, field, 8);
}

std::uint32_t bagNumber(std::string_view bytes, std::uint64_t at) {
  return static_cast<std::uint32_t>(little(bytes.substr(at, 4)));
}

std::map<std::string, std::string, std::less<>> bagFields(std::string_view bytes,
                                                          std::uint64_t place) {
  std::map<std::string, std::string, std::less<>> fields;
  std::size_t at = 0;
  while (at < bytes.size()) {
    const std::size_t left = bytes.size() - at;
    if (left < 4 || bagNumber(bytes, at) > left - 4) {
      throw BagFault{place, "a field of a header is longer than the header"};
    }
    const std::string_view field = bytes.substr(at + 4, bagNumber(bytes, at));
    const std::size_t equals = field.find('=');
    if (equals == std::string_view::npos) throw BagFault{place, "a field of a header has no '='"};
    fields[std::string(field.substr(0, equals))] = field.substr(equals + 1);
    at += 4 + field.size();
  }
  return fields;
}

BagRecord bagRecord(std::string_view bytes, std::uint64_t at) {
  BagRecord record;
  record.place = at;
  const auto lengthAt = [&](std::uint64_t place) {
    const bool there = place <= bytes.size() && bytes.size() - place >= 4;
    if (!there || bagNumber(bytes, place) > bytes.size() - place - 4) {
      throw BagFault{at, "a record is longer than what is left"};
    }
    return bagNumber(bytes, place);
  };
  const std::uint32_t header = lengthAt(at);
  record.fields = bagFields(bytes.substr(at + 4, header), at);
  record.size = lengthAt(at + 4 + header);
  record.data = at + 8 + header;
  return record;
}

}  // namespace palpate::node

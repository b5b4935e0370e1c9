// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtu_data.h"

#include <tinyxml2.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "byte_stream.h"
#include "cursor.h"
#include "palpate/base/error.h"
#include "palpate/base/number.h"

namespace palpate::formats {
namespace {

constexpr std::size_t kBestRatio = 1100;  // zlib compresses at most 1032 : 1
// Limit of numbers in all arrays: per byte of the file, plus a constant. Without compression there
// is at most one per byte; large meshes compress by less than eight. Small ones may be all zeros.
constexpr std::size_t kMostEach = 8, kMostMore = std::size_t{1} << 20;

std::string attribute(const tinyxml2::XMLElement& element, const char* name) {
  const char* value = element.Attribute(name);
  return value ? value : "";
}

/// Reads the next number of a block's header; false at the end of the data.
bool readHeaderNumber(ByteStream* in, ScalarType type, bool swap, std::size_t* number) {
  const std::string bytes = in->read(type.size);
  if (bytes.size() != type.size) return false;
  *number = type.size == 4 ? load<std::uint32_t>(bytes.data(), swap)
                           : static_cast<std::size_t>(load<std::uint64_t>(bytes.data(), swap));
  return true;
}

}  // namespace

VtuData::VtuData(std::string file, const tinyxml2::XMLElement& root, std::size_t bytes,
                 std::string_view appended, bool appended_raw)
    : file_(std::move(file)),
      most_(kMostEach * bytes + kMostMore),
      left_(most_),
      appended_(appended),
      appended_raw_(appended_raw) {
  const std::string order = attribute(root, "byte_order");
  if (!order.empty() && order != "LittleEndian" && order != "BigEndian") {
    fail(root, order, "byte_order must be LittleEndian or BigEndian");
  }
  swap_ = (order != "BigEndian") != hostIsLittleEndian();
  const std::string header = attribute(root, "header_type");
  if (!header.empty() && header != "UInt32" && header != "UInt64") {
    fail(root, header, "header_type must be UInt32 or UInt64");
  }
  if (header == "UInt64") header_type_.size = 8;
  const std::string compressor = attribute(root, "compressor");
  if (!compressor.empty() && compressor != "vtkZLibDataCompressor") {
    fail(root, compressor, "the compressor must be vtkZLibDataCompressor, or none");
  }
  compressed_ = !compressor.empty();
}

void VtuData::fail(const tinyxml2::XMLElement& element, const std::string& value,
                   const std::string& allowed) const {
  std::string where = "line " + std::to_string(element.GetLineNum()) + ", " + element.Name();
  const std::string name = attribute(element, "Name");
  if (!name.empty()) where += " '" + name + "'";
  throw InputError(file_, where, value, allowed);
}

void VtuData::checkRoom(const tinyxml2::XMLElement& array, std::size_t size,
                        std::size_t room) const {
  if (size <= room) return;
  fail(array, "",
       "truncated: " + std::to_string(size) + " bytes are needed, there are " +
           std::to_string(room) + " at most");
}

void VtuData::take(const tinyxml2::XMLElement& array, std::size_t count) {
  if (count > left_) {
    fail(array, std::to_string(count) + " numbers",
         "the arrays of this file must not have more than " + std::to_string(most_) + " in all");
  }
  left_ -= count;
}

std::string VtuData::block(const tinyxml2::XMLElement& array, std::size_t size) const {
  const bool is_appended = attribute(array, "format") == "appended";
  std::string_view text = array.GetText() ? array.GetText() : "";
  if (is_appended) {
    const std::int64_t offset = array.Int64Attribute("offset", -1);
    if (offset < 0 || static_cast<std::uint64_t>(offset) > appended_.size()) {
      fail(array, attribute(array, "offset"), "the offset must be within AppendedData");
    }
    text = appended_.substr(static_cast<std::size_t>(offset));
  }
  ByteStream in(text, !(is_appended && appended_raw_));
  const auto header = [&] {
    std::size_t number = 0;
    if (!readHeaderNumber(&in, header_type_, swap_, &number)) {
      fail(array, "", "truncated, or no base64");
    }
    return number;
  };
  const auto checkSize = [&](std::size_t found) {
    if (found == size) return;
    fail(array, std::to_string(found) + " bytes",
         "must have " + std::to_string(size) + " bytes by the number of points and cells");
  };

  if (!compressed_) {
    checkSize(header());
    checkRoom(array, size, in.room());
    std::string data = in.read(size);
    if (data.size() != size) fail(array, "", "truncated, or no base64");
    return data;
  }
  checkRoom(array, size / kBestRatio, in.room());
  const std::size_t num_parts = header(), part_size = header(), last_size = header();
  checkRoom(array, num_parts, in.room() / header_type_.size);
  if (num_parts == 0) {
    checkSize(0);
    return {};
  }
  // A single part may be smaller than announced.
  if (num_parts > 1 && (part_size > size / (num_parts - 1) || last_size > size)) {
    fail(array, "", "the parts are larger than the whole");
  }
  if (last_size > part_size) fail(array, "", "the last part must not be larger than the others");
  checkSize((num_parts - 1) * part_size + (last_size == 0 ? part_size : last_size));
  std::vector<std::size_t> compressed_sizes(num_parts);
  for (std::size_t& compressed_size : compressed_sizes) compressed_size = header();
  std::string data(size, '\0');
  std::size_t done = 0;
  for (const std::size_t compressed_size : compressed_sizes) {
    checkRoom(array, compressed_size, in.room());
    const std::string part = in.read(compressed_size);
    const std::size_t expected = std::min(part_size, size - done);
    uLongf length = expected;
    const int status = uncompress(reinterpret_cast<Bytef*>(&data[done]), &length,
                                  reinterpret_cast<const Bytef*>(part.data()), part.size());
    if (status != Z_OK || length != expected) fail(array, "", "the compressed data is damaged");
    done += expected;
  }
  return data;
}

std::vector<double> VtuData::numbers(const tinyxml2::XMLElement& array, std::size_t count) {
  const std::string type_name = attribute(array, "type");
  const auto type = vtuType(type_name);
  if (!type) fail(array, type_name, "the type must be Int8 ... UInt64, Float32 or Float64");
  const std::string format = attribute(array, "format");
  std::vector<double> values;
  if (format == "ascii") {
    const std::string_view text = array.GetText() ? array.GetText() : "";
    checkRoom(array, 2 * count, text.size() + 1);
    take(array, count);
    Cursor in(file_, text);
    values.resize(count);
    for (double& value : values) {
      const std::string_view word = in.word();
      const std::optional<double> number = parseAnyNumber(word);
      value = number.value_or(0.0);
      if (number) continue;
      fail(array, std::string(word.substr(0, 40)),
           word.empty() ? "truncated: must have " + std::to_string(count) + " numbers"
                        : "must be a number");
    }
    if (!in.atEnd()) fail(array, "", "must have " + std::to_string(count) + " numbers, not more");
    return values;
  }
  if (format != "binary" && format != "appended") {
    fail(array, format, "the format must be ascii, binary or appended");
  }
  take(array, count);
  const std::string data = block(array, count * type->size);
  values.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    values[i] = loadNumber(data.data() + i * type->size, *type, swap_);
  }
  return values;
}

}  // namespace palpate::formats

// SPDX-License-Identifier: GPL-3.0-or-later
#include "scalar_type.h"

namespace palpate::formats {
namespace {

struct Named {
  std::string_view name;
  ScalarType type;
};

constexpr ScalarType kInt8{ScalarType::kSigned, 1}, kUInt8{ScalarType::kUnsigned, 1},
    kInt16{ScalarType::kSigned, 2}, kUInt16{ScalarType::kUnsigned, 2},
    kInt32{ScalarType::kSigned, 4}, kUInt32{ScalarType::kUnsigned, 4},
    kInt64{ScalarType::kSigned, 8}, kUInt64{ScalarType::kUnsigned, 8},
    kFloat32{ScalarType::kFloat, 4}, kFloat64{ScalarType::kFloat, 8};

constexpr Named kPly[] = {
    {"char", kInt8},     {"int8", kInt8},       {"uchar", kUInt8},    {"uint8", kUInt8},
    {"short", kInt16},   {"int16", kInt16},     {"ushort", kUInt16},  {"uint16", kUInt16},
    {"int", kInt32},     {"int32", kInt32},     {"uint", kUInt32},    {"uint32", kUInt32},
    {"float", kFloat32}, {"float32", kFloat32}, {"double", kFloat64}, {"float64", kFloat64}};

// In legacy files `vtkIdType` is a 32-bit int.
constexpr Named kVtk[] = {{"char", kInt8},
                          {"signed_char", kInt8},
                          {"unsigned_char", kUInt8},
                          {"short", kInt16},
                          {"unsigned_short", kUInt16},
                          {"int", kInt32},
                          {"vtkidtype", kInt32},
                          {"unsigned_int", kUInt32},
                          {"long", kInt64},
                          {"unsigned_long", kUInt64},
                          {"vtktypeint8", kInt8},
                          {"vtktypeuint8", kUInt8},
                          {"vtktypeint16", kInt16},
                          {"vtktypeuint16", kUInt16},
                          {"vtktypeint32", kInt32},
                          {"vtktypeuint32", kUInt32},
                          {"vtktypeint64", kInt64},
                          {"vtktypeuint64", kUInt64},
                          {"float", kFloat32},
                          {"double", kFloat64}};

constexpr Named kVtu[] = {{"Int8", kInt8},      {"UInt8", kUInt8},   {"Int16", kInt16},
                          {"UInt16", kUInt16},  {"Int32", kInt32},   {"UInt32", kUInt32},
                          {"Int64", kInt64},    {"UInt64", kUInt64}, {"Float32", kFloat32},
                          {"Float64", kFloat64}};

template <std::size_t n>
std::optional<ScalarType> find(const Named (&list)[n], std::string_view name) {
  for (const Named& entry : list) {
    if (entry.name == name) return entry.type;
  }
  return std::nullopt;
}

}  // namespace

std::optional<ScalarType> plyType(std::string_view name) { return find(kPly, name); }
std::optional<ScalarType> vtkType(std::string_view name) { return find(kVtk, name); }
std::optional<ScalarType> vtuType(std::string_view name) { return find(kVtu, name); }

bool hostIsLittleEndian() {
  const std::uint16_t one = 1;
  return load<unsigned char>(reinterpret_cast<const char*>(&one), false) == 1;
}

double loadNumber(const char* p, ScalarType type, bool swap) {
  if (type.kind == ScalarType::kFloat) {
    return type.size == 4 ? static_cast<double>(load<float>(p, swap)) : load<double>(p, swap);
  }
  // `signed ? a : b` would convert both to unsigned.
  if (type.kind == ScalarType::kSigned) {
    if (type.size == 1) return load<std::int8_t>(p, swap);
    if (type.size == 2) return load<std::int16_t>(p, swap);
    if (type.size == 4) return load<std::int32_t>(p, swap);
    return static_cast<double>(load<std::int64_t>(p, swap));
  }
  if (type.size == 1) return load<std::uint8_t>(p, swap);
  if (type.size == 2) return load<std::uint16_t>(p, swap);
  if (type.size == 4) return load<std::uint32_t>(p, swap);
  return static_cast<double>(load<std::uint64_t>(p, swap));
}

}  // namespace palpate::formats

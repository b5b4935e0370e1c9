// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <zlib.h>

#include <string>
#include <vector>

#include "formats/sample.h"

namespace palpate::formats {

/// Two tetrahedra on one face, of regions 7 and 9, a triangle, and a point (the second) that no
/// tetrahedron uses. Indices from 0 in all of the file's points.
inline const std::vector<double> kXyz = {0, 0, 0, 5, 5, 5, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
inline const std::vector<double> kTetNodes = {0, 2, 3, 4, 2, 3, 4, 5};
inline const std::vector<double> kTriangle = {0, 3, 2};

inline std::string text(const std::vector<double>& values, int add = 0) {
  std::string line;
  for (const double value : values) line += std::to_string(static_cast<int>(value) + add) + ' ';
  line.back() = '\n';
  return line;
}

inline std::string base64(const std::string& bytes) {
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      out += i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63] : '=';
    }
  }
  return out;
}

// ---- Gmsh. Node tags are 10 times the index from 1.
inline std::string gmshNodes() {
  std::string nodes;
  for (int i = 0; i < 6; ++i) {
    nodes +=
        std::to_string(10 * (i + 1)) + ' ' + text({kXyz[3 * i], kXyz[3 * i + 1], kXyz[3 * i + 2]});
  }
  return nodes;
}

inline std::string msh1Sample() {
  return "$NOD\n6\n" + gmshNodes() +
         "$ENDNOD\n$ELM\n3\n1 2 1 1 3 10 40 30\n2 4 7 1 4 10 30 40 50\n3 4 0 9 4 30 40 50 60\n"
         "$ENDELM\n";
}

inline std::string msh2Sample() {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 7 \"a\"\n$EndPhysicalNames\n"
         "$Nodes\n6\n" +
         gmshNodes() +
         "$EndNodes\n$Elements\n3\n1 2 2 1 1 10 40 30\n2 4 2 7 1 10 30 40 50\n"
         "3 4 2 0 9 30 40 50 60\n$EndElements\n";
}

inline std::string msh2BinarySample(bool big) {
  std::string b = "$MeshFormat\n2.2 1 8\n";
  put(&b, 1, big);
  b += "\n$EndMeshFormat\n$Nodes\n6\n";
  for (int i = 0; i < 6; ++i) {
    put(&b, 10 * (i + 1), big);
    for (int k = 0; k < 3; ++k) put(&b, kXyz[3 * i + k], big);
  }
  b += "\n$EndNodes\n$Elements\n3\n";
  b += packed<int>({2, 1, 2, 1, 1, 1, 10, 40, 30}, big);
  b += packed<int>({4, 2, 2, 2, 7, 1, 10, 30, 40, 50, 3, 0, 9, 30, 40, 50, 60}, big);
  return b + "\n$EndElements\n";
}

inline std::string msh4Sample() {
  return "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n1 0 1 2\n"
         "1 0 0 0 0\n"              // a point
         "1 0 0 0 1 1 1 0 0\n"      // a surface
         "1 0 0 0 1 1 1 1 7 1 1\n"  // volume 1, physical 7
         "9 0 0 0 1 1 1 0 1 -1\n"   // volume 9
         "$EndEntities\n$Nodes\n2 6 10 60\n"
         "2 1 1 1\n10\n0 0 0 0.5 0.5\n"  // parametric
         "3 1 0 5\n20\n30\n40\n50\n60\n5 5 5\n1 0 0\n0 1 0\n0 0 1\n1 1 1\n$EndNodes\n"
         "$Elements\n3 3 1 3\n2 1 2 1\n1 10 40 30\n3 1 4 1\n2 10 30 40 50\n"
         "3 9 4 1\n3 30 40 50 60\n$EndElements\n";
}

inline std::string msh4BinarySample(bool big) {
  const auto ints = [big](const std::vector<double>& v) { return packed<int>(v, big); };
  const auto sizes = [big](const std::vector<double>& v) { return packed<long long>(v, big); };
  const auto reals = [big](const std::vector<double>& v) { return packed<double>(v, big); };
  const std::vector<double> box = {0, 0, 0, 1, 1, 1};
  return "$MeshFormat\n4.1 1 8\n" + ints({1}) + "\n$EndMeshFormat\n$Entities\n" +
         sizes({1, 0, 1, 2}) + ints({1}) + reals({0, 0, 0}) + sizes({0}) +  // point
         ints({1}) + reals(box) + sizes({0, 0}) +                           // surface
         ints({1}) + reals(box) + sizes({1}) + ints({7}) + sizes({1}) + ints({1}) + ints({9}) +
         reals(box) + sizes({0, 1}) + ints({-1}) + "\n$EndEntities\n$Nodes\n" +
         sizes({1, 6, 10, 60}) + ints({3, 1, 0}) + sizes({6, 10, 20, 30, 40, 50, 60}) +
         reals(kXyz) + "\n$EndNodes\n$Elements\n" + sizes({3, 3, 1, 3}) + ints({2, 1, 2}) +
         sizes({1, 1, 10, 40, 30}) + ints({3, 1, 4}) + sizes({1, 2, 10, 30, 40, 50}) +
         ints({3, 9, 4}) + sizes({1, 3, 30, 40, 50, 60}) + "\n$EndElements\n";
}

// ---- VTK legacy
inline std::string vtkSample() {
  return "# vtk DataFile Version 2.0\ntwo tetrahedra\nASCII\nDATASET UNSTRUCTURED_GRID\n"
         "POINTS 6 float\n" +
         text(kXyz) + "CELLS 3 14\n3 0 3 2\n4 0 2 3 4\n4 2 3 4 5\nCELL_TYPES 3\n5\n10\n10\n" +
         "POINT_DATA 6\nVECTORS v double\n" + text(kXyz) +
         "CELL_DATA 3\nSCALARS quality float\nLOOKUP_TABLE default\n1 nan 1\n"
         "SCALARS region int 1\nLOOKUP_TABLE default\n1 7 9\n";
}

inline std::string vtkBinarySample() {
  return "# vtk DataFile Version 4.2\ntwo tetrahedra\nBINARY\nDATASET UNSTRUCTURED_GRID\n"
         "POINTS 6 double\n" +
         packed<double>(kXyz, true) + "\nCELLS 3 14\n" +
         packed<int>({3, 0, 3, 2, 4, 0, 2, 3, 4, 4, 2, 3, 4, 5}, true) + "\nCELL_TYPES 3\n" +
         packed<int>({5, 10, 10}, true) + "\nCELL_DATA 3\nFIELD FieldData 2\nm 2 3 float\n" +
         packed<float>({1, 2, 3, 4, 5, 6}, true) + "\nMETADATA\nINFORMATION 0\n\n" +
         "gmsh:physical 1 3 int\n" + packed<int>({1, 7, 9}, true) + "\n";
}

inline std::string vtk51Sample() {
  return "# vtk DataFile Version 5.1\ntwo tetrahedra\nASCII\nDATASET UNSTRUCTURED_GRID\n"
         "POINTS 6 double\n" +
         text(kXyz) + "METADATA\nINFORMATION 0\n\nCELLS 4 11\nOFFSETS vtktypeint64\n0 3 7 11\n" +
         "CONNECTIVITY vtktypeint64\n0 3 2 0 2 3 4 2 3 4 5\nCELL_TYPES 3\n5\n10\n10\n" +
         "CELL_DATA 3\nFIELD FieldData 1\nregion 1 3 vtktypeint64\n1 7 9\n";
}

inline std::string vtk51BinarySample() {
  return "# vtk DataFile Version 5.1\ntwo tetrahedra\nBINARY\nDATASET UNSTRUCTURED_GRID\n"
         "POINTS 6 float\n" +
         packed<float>(kXyz, true) + "\nCELLS 4 11\nOFFSETS vtktypeint64\n" +
         packed<long long>({0, 3, 7, 11}, true) + "\nCONNECTIVITY vtktypeint64\n" +
         packed<long long>({0, 3, 2, 0, 2, 3, 4, 2, 3, 4, 5}, true) + "\nCELL_TYPES 3\n" +
         packed<int>({5, 10, 10}, true) + "\nCELL_DATA 3\nSCALARS region long\n" +
         "LOOKUP_TABLE default\n" + packed<long long>({1, 7, 9}, true) + "\n";
}

// ---- VTK XML
struct VtuForm {
  enum Format { kText, kBase64, kAppendedRaw, kAppendedBase64 } format = kText;
  bool big = false, long_header = false, compressed = false;
};

/// One block; compressed in parts of 32 bytes.
inline std::string vtuBlock(const std::string& data, const VtuForm& form, bool base64_text) {
  const auto header = [&](const std::vector<double>& v) {
    return form.long_header ? packed<unsigned long long>(v, form.big)
                            : packed<unsigned>(v, form.big);
  };
  const auto code = [&](const std::string& s) { return base64_text ? base64(s) : s; };
  const auto size = static_cast<double>(data.size());
  if (!form.compressed) return code(header({size}) + data);
  constexpr std::size_t kPart = 32;
  const std::size_t num_parts = (data.size() + kPart - 1) / kPart;
  std::vector<double> numbers = {double(num_parts), double(kPart), double(data.size() % kPart)};
  std::string parts;
  for (std::size_t i = 0; i < data.size(); i += kPart) {
    const std::string part = data.substr(i, kPart);
    std::vector<Bytef> out(compressBound(part.size()));
    uLongf length = out.size();
    compress(out.data(), &length, reinterpret_cast<const Bytef*>(part.data()), part.size());
    parts.append(reinterpret_cast<char*>(out.data()), length);
    numbers.push_back(static_cast<double>(length));
  }
  return code(header(numbers)) + code(parts);  // encoded apart
}

inline std::string vtuSample(const VtuForm& form) {
  std::string appended;
  const auto array = [&](const std::string& name, const std::string& type, int components,
                         const std::vector<double>& values, const std::string& data) {
    std::string xml = "<DataArray type=\"" + type + "\" Name=\"" + name +
                      "\" NumberOfComponents=\"" + std::to_string(components) + "\" format=\"";
    if (form.format == VtuForm::kText) return xml + "ascii\">\n" + text(values) + "</DataArray>\n";
    if (form.format == VtuForm::kBase64) {
      return xml + "binary\">\n  " + vtuBlock(data, form, true) + "\n</DataArray>\n";
    }
    xml += "appended\" offset=\"" + std::to_string(appended.size()) + "\"/>\n";
    appended += vtuBlock(data, form, form.format == VtuForm::kAppendedBase64);
    return xml;
  };
  const std::vector<double> connectivity = {0, 3, 2, 0, 2, 3, 4, 2, 3, 4, 5}, ends = {3, 7, 11},
                            types = {5, 10, 10}, region = {1, 7, 9};
  std::string xml = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" ";
  xml += std::string("byte_order=\"") + (form.big ? "BigEndian" : "LittleEndian") + "\"";
  if (form.long_header) xml += " header_type=\"UInt64\"";
  if (form.compressed) xml += " compressor=\"vtkZLibDataCompressor\"";
  xml += ">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"6\" NumberOfCells=\"3\">\n";
  xml += "<PointData>\n" + array("v", "Float64", 3, kXyz, packed<double>(kXyz, form.big)) +
         "</PointData>\n<CellData>\n" +
         array("region", "Int32", 1, region, packed<int>(region, form.big)) + "</CellData>\n";
  xml += "<Points>\n" + array("Points", "Float32", 3, kXyz, packed<float>(kXyz, form.big)) +
         "</Points>\n<Cells>\n";
  xml += array("connectivity", "Int64", 1, connectivity, packed<long long>(connectivity, form.big));
  xml += array("offsets", "Int32", 1, ends, packed<int>(ends, form.big));
  xml += array("types", "UInt8", 1, types, packed<unsigned char>(types, form.big));
  xml += "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
  if (!appended.empty()) {
    xml += std::string("<AppendedData encoding=\"") +
           (form.format == VtuForm::kAppendedRaw ? "raw" : "base64") + "\">\n_" + appended +
           "\n</AppendedData>\n";
  }
  return xml + "</VTKFile>\n";
}

inline std::string meditSample() {
  std::string vertices;
  for (int i = 0; i < 6; ++i) {
    vertices += text({kXyz[3 * i], kXyz[3 * i + 1], kXyz[3 * i + 2], 1});
  }
  return "MeshVersionFormatted 2\n# comment\nDimension\n3\nVertices\n6\n" + vertices +
         "Triangles 1\n1 4 3 5\nTetrahedra\n2\n1 3 4 5 7\n3 4 5 6 9\nRidges 1\n1\nEnd\n";
}

inline std::vector<Sample> tetSamples() {
  using F = VtuForm;
  return {{"msh1", ".msh", msh1Sample()},
          {"msh2", ".msh", msh2Sample()},
          {"msh2_little_endian", ".msh", msh2BinarySample(false)},
          {"msh2_big_endian", ".msh", msh2BinarySample(true)},
          {"msh4", ".msh", msh4Sample()},
          {"msh4_little_endian", ".msh", msh4BinarySample(false)},
          {"msh4_big_endian", ".msh", msh4BinarySample(true)},
          {"vtk", ".vtk", vtkSample()},
          {"vtk_binary", ".vtk", vtkBinarySample()},
          {"vtk51", ".vtk", vtk51Sample()},
          {"vtk51_binary", ".vtk", vtk51BinarySample()},
          {"vtu", ".vtu", vtuSample({})},
          {"vtu_base64", ".vtu", vtuSample({F::kBase64, false, false, false})},
          {"vtu_base64_big_long", ".vtu", vtuSample({F::kBase64, true, true, false})},
          {"vtu_base64_zlib", ".vtu", vtuSample({F::kBase64, false, false, true})},
          {"vtu_base64_zlib_long", ".vtu", vtuSample({F::kBase64, false, true, true})},
          {"vtu_raw", ".vtu", vtuSample({F::kAppendedRaw, false, true, false})},
          {"vtu_raw_big", ".vtu", vtuSample({F::kAppendedRaw, true, false, false})},
          {"vtu_raw_zlib", ".vtu", vtuSample({F::kAppendedRaw, false, true, true})},
          {"vtu_appended_base64", ".vtu", vtuSample({F::kAppendedBase64, false, false, false})},
          {"vtu_appended_base64_zlib", ".vtu", vtuSample({F::kAppendedBase64, false, true, true})},
          {"medit", ".mesh", meditSample()}};
}

}  // namespace palpate::formats

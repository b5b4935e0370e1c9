// SPDX-License-Identifier: GPL-3.0-or-later
#include <tinyxml2.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "palpate/base/error.h"
#include "tet_formats.h"
#include "vtk_cells.h"
#include "vtu_data.h"

namespace palpate::formats {
namespace {

using tinyxml2::XMLElement;

/// Parts of the file: XML, and the arbitrary bytes of AppendedData.
struct Parts {
  std::string xml;
  std::string_view appended;
  bool appended_raw = true;
};

Parts split(const std::string& file, std::string_view bytes) {
  Parts parts;
  const std::size_t tag = bytes.find("<AppendedData");
  if (tag == std::string_view::npos) {
    parts.xml = bytes;
    return parts;
  }
  const std::size_t close = std::min(bytes.find('>', tag), bytes.size());
  const std::size_t mark = std::min(bytes.find('_', close), bytes.size());
  if (mark == bytes.size()) {
    throw InputError(file, "AppendedData", "", "truncated: '_' and the data must follow");
  }
  parts.xml = std::string(bytes.substr(0, tag)) + "</VTKFile>";
  parts.appended = bytes.substr(mark + 1);
  parts.appended_raw = bytes.substr(tag, close - tag).find("\"base64\"") == std::string_view::npos;
  return parts;
}

const XMLElement& child(const XMLElement& parent, const char* name, const VtuData& data) {
  const XMLElement* found = parent.FirstChildElement(name);
  if (!found) data.fail(parent, "", std::string("must have an element ") + name);
  return *found;
}

std::size_t count(const XMLElement& piece, const char* name, const VtuData& data) {
  std::int64_t n = -1;
  if (piece.QueryInt64Attribute(name, &n) != tinyxml2::XML_SUCCESS || n < 0 ||
      n > std::numeric_limits<int>::max()) {
    data.fail(piece, piece.Attribute(name) ? piece.Attribute(name) : "",
              std::string(name) + " must be a number of 0 ... 2147483647");
  }
  return static_cast<std::size_t>(n);
}

const XMLElement& cellArray(const XMLElement& cells, const char* name, const VtuData& data) {
  for (const XMLElement* e = cells.FirstChildElement("DataArray"); e;
       e = e->NextSiblingElement("DataArray")) {
    if (e->Attribute("Name", name)) return *e;
  }
  data.fail(cells, "", std::string("must have a DataArray '") + name + "'");
}

VtkGrid readPiece(const XMLElement& piece, VtuData& data) {
  VtkGrid grid;
  const std::size_t num_points = count(piece, "NumberOfPoints", data);
  const std::size_t num_cells = count(piece, "NumberOfCells", data);
  const XMLElement& points = child(child(piece, "Points", data), "DataArray", data);
  if (points.IntAttribute("NumberOfComponents", 1) != 3) {
    data.fail(points, "", "NumberOfComponents must be 3");
  }
  grid.points = data.numbers(points, 3 * num_points);
  const XMLElement& cells = child(piece, "Cells", data);
  grid.types = data.numbers(cellArray(cells, "types", data), num_cells);
  const XMLElement& offsets = cellArray(cells, "offsets", data);
  grid.ends = data.numbers(offsets, num_cells);
  const double size = grid.ends.empty() ? 0.0 : grid.ends.back();
  if (!(size >= 0.0 && size <= std::numeric_limits<int>::max())) {
    data.fail(offsets, "", "the last offset is out of range");
  }
  grid.connectivity =
      data.numbers(cellArray(cells, "connectivity", data), static_cast<std::size_t>(size));
  const XMLElement* cell_data = piece.FirstChildElement("CellData");
  for (const XMLElement* e = cell_data ? cell_data->FirstChildElement("DataArray") : nullptr; e;
       e = e->NextSiblingElement("DataArray")) {
    const char* name = e->Attribute("Name");
    const char* type = e->Attribute("type");
    const int components = e->IntAttribute("NumberOfComponents", 1);
    if (!name || !type || !vtuType(type) || (components != 1 && components != 3)) continue;
    const auto n = static_cast<std::size_t>(components);
    grid.cell_data.push_back({name, n, data.numbers(*e, n * num_cells)});
  }
  return grid;
}

}  // namespace

mesh::TetMesh readVtu(const std::string& file, std::string_view bytes) {
  const Parts parts = split(file, bytes);
  tinyxml2::XMLDocument document;
  if (document.Parse(parts.xml.data(), parts.xml.size()) != tinyxml2::XML_SUCCESS) {
    throw InputError(file, "line " + std::to_string(document.ErrorLineNum()), "",
                     std::string("truncated, or no XML (") + document.ErrorName() + ")");
  }
  const XMLElement* root = document.FirstChildElement("VTKFile");
  if (!root || !root->Attribute("type", "UnstructuredGrid")) {
    throw InputError(file, "VTKFile", "", "there must be a VTKFile of type UnstructuredGrid");
  }
  VtuData data(file, *root, bytes.size(), parts.appended, parts.appended_raw);
  const XMLElement& grid = child(*root, "UnstructuredGrid", data);
  TetBuilder builder(file);
  for (const XMLElement* piece = &child(grid, "Piece", data); piece;
       piece = piece->NextSiblingElement("Piece")) {
    addVtkGrid(readPiece(*piece, data), file, &builder);
  }
  return builder.finish();
}

}  // namespace palpate::formats

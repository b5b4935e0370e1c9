// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/formats/vtu_writer.h"

#include <tinyxml2.h>

#include <cstdint>
#include <stdexcept>

#include "palpate/base/atomic_file.h"
#include "scalar_type.h"

namespace palpate::formats {
namespace {

// VTK's cell type for this number of points.
unsigned char cellType(Eigen::Index points) {
  switch (points) {
    case 2:
      return 3;
    case 3:
      return 5;
    case 4:
      return 10;
    case 8:
      return 12;
    case 10:
      return 24;
    default:
      throw std::invalid_argument("writeVtu: cells of " + std::to_string(points) +
                                  " points; must be 2, 3, 4, 8 or 10");
  }
}

/// Writes the XML part to `xml` and collects the blocks that follow it.
class Writer {
 public:
  tinyxml2::XMLPrinter xml;

  void begin(const char* element) { xml.OpenElement(element); }
  void end() { xml.CloseElement(); }

  template <class T>
  void array(const std::string& name, const char* type, Eigen::Index components, const T* values,
             Eigen::Index count) {
    xml.OpenElement("DataArray");
    xml.PushAttribute("type", type);
    xml.PushAttribute("Name", name.c_str());
    xml.PushAttribute("NumberOfComponents", std::to_string(components).c_str());
    xml.PushAttribute("format", "appended");
    xml.PushAttribute("offset", std::to_string(appended_.size()).c_str());
    xml.CloseElement();
    const std::uint64_t size = static_cast<std::uint64_t>(components * count) * sizeof(T);
    append(&size, sizeof size);
    append(values, size);
  }

  void arrays(const char* element, const std::vector<VtuArray>& list,
              const std::vector<int>& region) {
    begin(element);
    for (const VtuArray& a : list) {
      array(a.name, "Float64", a.values.rows(), a.values.data(), a.values.cols());
    }
    if (!region.empty()) {
      array("region", "Int32", 1, region.data(), static_cast<Eigen::Index>(region.size()));
    }
    end();
  }

  /// The complete file.
  std::string file() const {
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
           "byte_order=\"" +
           std::string(hostIsLittleEndian() ? "LittleEndian" : "BigEndian") +
           "\" header_type=\"UInt64\">\n" + xml.CStr() + "<AppendedData encoding=\"raw\">\n_" +
           appended_ + "\n</AppendedData>\n</VTKFile>\n";
  }

 private:
  void append(const void* data, std::size_t size) {
    if (size > 0) appended_.append(static_cast<const char*>(data), size);
  }

  std::string appended_;
};

void check(const std::vector<VtuArray>& arrays, Eigen::Index count, const char* of) {
  for (const VtuArray& a : arrays) {
    if (a.name.empty()) throw std::invalid_argument("writeVtu: an array must have a name");
    if (a.values.cols() == count && a.values.rows() > 0) continue;
    throw std::invalid_argument("writeVtu: array '" + a.name + "' has " +
                                std::to_string(a.values.cols()) + " columns; must be the " +
                                std::to_string(count) + ' ' + of);
  }
}

void writeCells(const mesh::CellMesh& mesh, Writer* out) {
  const Eigen::Index num_nodes = mesh.cells.rows();
  const Eigen::Matrix<std::int64_t, Eigen::Dynamic, Eigen::Dynamic> nodes =
      mesh.cells.cast<std::int64_t>();
  std::vector<std::int64_t> ends(static_cast<std::size_t>(mesh.numCells()));
  for (std::size_t i = 0; i < ends.size(); ++i) {
    ends[i] = static_cast<std::int64_t>(i + 1) * num_nodes;
  }
  const std::vector<unsigned char> types(ends.size(), ends.empty() ? 0 : cellType(num_nodes));
  out->begin("Cells");
  out->array("connectivity", "Int64", 1, nodes.data(), nodes.size());
  out->array("offsets", "Int64", 1, ends.data(), mesh.numCells());
  out->array("types", "UInt8", 1, types.data(), mesh.numCells());
  out->end();
}

}  // namespace

void writeVtu(const std::string& file, const mesh::CellMesh& mesh,
              const std::vector<VtuArray>& point_data, const std::vector<VtuArray>& cell_data) {
  check(point_data, mesh.numPoints(), "points");
  check(cell_data, mesh.numCells(), "cells");
  if (!mesh.region.empty() && static_cast<Eigen::Index>(mesh.region.size()) != mesh.numCells()) {
    throw std::invalid_argument("writeVtu: region must have one tag a cell");
  }
  Writer out;
  out.begin("UnstructuredGrid");
  out.begin("Piece");
  out.xml.PushAttribute("NumberOfPoints", std::to_string(mesh.numPoints()).c_str());
  out.xml.PushAttribute("NumberOfCells", std::to_string(mesh.numCells()).c_str());
  out.begin("Points");
  out.array("Points", "Float64", 3, mesh.points.data(), mesh.numPoints());
  out.end();
  writeCells(mesh, &out);
  out.arrays("PointData", point_data, {});
  out.arrays("CellData", cell_data, mesh.region);
  out.end();
  out.end();
  writeFileAtomically(file, out.file());
}

void writeVtu(const std::string& file, const mesh::TetMesh& mesh,
              const std::vector<VtuArray>& point_data, const std::vector<VtuArray>& cell_data) {
  writeVtu(file, mesh::cellsOf(mesh), point_data, cell_data);
}

}  // namespace palpate::formats

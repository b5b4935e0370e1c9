// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cursor.h"
#include "file_bytes.h"
#include "palpate/base/number.h"
#include "scalar_type.h"
#include "tet_formats.h"
#include "vtk_cells.h"

namespace palpate::formats {
namespace {

/// VTK's legacy format [The VTK User's Guide, "VTK File Formats"]: the sections of an unstructured
/// grid in sequence. Binary data is big-endian.
class LegacyVtkReader {
 public:
  LegacyVtkReader(const std::string& file, std::string_view bytes)
      : file_(file), in_(file, bytes) {}

  mesh::TetMesh read() {
    readHeader();
    while (!in_.atEnd()) readSection();
    if (grid_.types.size() != grid_.ends.size()) {
      in_.fail("", "truncated: there must be as many CELL_TYPES as CELLS");
    }
    TetBuilder builder(file_);
    addVtkGrid(grid_, file_, &builder);
    return builder.finish();
  }

 private:
  void readHeader() {
    constexpr std::string_view kVtkHeader = "# vtk DataFile Version ";
    const std::string_view header = in_.restOfLine();
    if (header.substr(0, kVtkHeader.size()) != kVtkHeader) {
      in_.fail(header, "must begin with '" + std::string(kVtkHeader) + "'");
    }
    const std::string_view number = header.substr(kVtkHeader.size());
    const double version = parseAnyNumber(number).value_or(0.0);
    if (!(version >= 1.0 && version <= 5.1)) {
      in_.fail(number, "the version must be 1.0 ... 5.1");
    }
    in_.skipLine();  // title
    const std::string_view encoding = in_.word();
    if (encoding != "ASCII" && encoding != "BINARY") in_.fail(encoding, "must be ASCII or BINARY");
    binary_ = encoding == "BINARY";
    in_.expect("DATASET");
    in_.expect("UNSTRUCTURED_GRID");
  }

  void readSection() {
    const std::string_view word = in_.word();
    const std::string key = lowerCase(word);
    if (key == "points") {
      const std::size_t n = in_.count("number of points", binary_ ? 3 : 6);
      grid_.points = readArray(in_.word(), 3 * n);
    } else if (key == "cells") {
      readCells();
    } else if (key == "cell_types") {
      const std::size_t n = in_.count("number of cells", binary_ ? 4 : 2);
      in_.skipLine();
      grid_.types = readNumbers({ScalarType::kSigned, 4}, n);
    } else if (key == "cell_data" || key == "point_data") {
      of_cells_ = key == "cell_data";
      num_values_ = in_.count("number of values", 1);
    } else if (key == "field") {
      readField();
    } else if (key == "metadata") {
      skipMetadata();
    } else if (!readAttribute(key)) {
      in_.fail(word, "must be a section of an unstructured grid: POINTS, CELLS, CELL_TYPES, ...");
    }
  }

  /// Up to version 4: "n size", then for each cell the number of points and the points. Version 5:
  /// "n + 1 size", OFFSETS (with a leading 0) and CONNECTIVITY.
  void readCells() {
    const std::size_t n = in_.count("number of cells", 1);
    const std::size_t size = in_.count("size of the cells", 1);
    if (in_.peek() == "OFFSETS") {
      in_.word();
      grid_.ends = readArray(in_.word(), n);
      if (!grid_.ends.empty()) {
        if (grid_.ends.front() != 0.0) in_.fail("OFFSETS", "must begin with 0");
        grid_.ends.erase(grid_.ends.begin());
      }
      in_.expect("CONNECTIVITY");
      grid_.connectivity = readArray(in_.word(), size);
      return;
    }
    in_.skipLine();
    const std::vector<double> numbers = readNumbers({ScalarType::kSigned, 4}, size);
    grid_.connectivity.clear();
    grid_.ends.clear();
    std::size_t i = 0;
    while (grid_.ends.size() < n) {
      if (i >= numbers.size() || !isNumberOfPoints(numbers[i], numbers.size() - i)) {
        in_.fail("cell " + std::to_string(grid_.ends.size() + 1),
                 "the cells must fit the size that CELLS announces");
      }
      const auto num_points = static_cast<std::size_t>(numbers[i]);
      const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(i) + 1;
      grid_.connectivity.insert(grid_.connectivity.end(), begin,
                                begin + static_cast<std::ptrdiff_t>(num_points));
      grid_.ends.push_back(static_cast<double>(grid_.connectivity.size()));
      i += num_points + 1;
    }
    if (i < numbers.size()) {
      in_.fail(std::to_string(numbers.size() - i) + " numbers left",
               "the cells must fit the size that CELLS announces");
    }
  }

  static bool isNumberOfPoints(double number, std::size_t left) {
    return number >= 0.0 && number < double(left) && number == std::floor(number);
  }

  void readField() {
    in_.word();  // name
    for (std::size_t n = in_.count("number of arrays", 4); n > 0; --n) {
      if (lowerCase(in_.peek()) == "metadata") {
        in_.word();
        skipMetadata();
      }
      const std::string name(in_.word());
      const std::size_t components = in_.count("number of components", 1);
      const std::size_t count = in_.count("number of values", 1);
      keep(name, components, readArray(in_.word(), product(components, count)));
    }
  }

  /// Reads SCALARS, VECTORS, ...; returns whether `key` is one of them.
  bool readAttribute(const std::string& key) {
    if (key == "scalars") {
      const std::string name(in_.word());
      const std::string type(in_.word());
      const std::string_view number = in_.wordOnLine();
      const std::size_t components = number.empty() ? 1 : small(number);
      in_.skipLine();
      if (lowerCase(in_.peek()) == "lookup_table") {
        in_.word();
        in_.word();
      }
      keep(name, components, readArray(type, product(components, num_values_)));
    } else if (key == "vectors" || key == "normals" || key == "tensors") {
      const std::string name(in_.word());
      const std::size_t components = key == "tensors" ? 9 : 3;
      keep(name, components, readArray(in_.word(), product(components, num_values_)));
    } else if (key == "global_ids" || key == "pedigree_ids") {
      in_.word();
      readArray(in_.word(), num_values_);
    } else if (key == "texture_coordinates") {
      in_.word();
      const std::size_t components = small(in_.word());
      readArray(in_.word(), product(components, num_values_));
    } else if (key == "color_scalars") {
      in_.word();
      const std::size_t components = small(in_.word());
      readArray(binary_ ? "unsigned_char" : "float", product(components, num_values_));
    } else if (key == "lookup_table") {
      in_.word();
      const std::size_t size = in_.count("size of a table", 4);
      readArray(binary_ ? "unsigned_char" : "float", product(4, size));
    } else {
      return false;
    }
    return true;
  }

  std::size_t small(std::string_view word) {
    const std::int64_t n = in_.toInteger(word, "number of components");
    if (n < 1 || n > 9) in_.fail(word, "the number of components must be 1 ... 9");
    return static_cast<std::size_t>(n);
  }

  /// Both factors are at most the file's size, so the product does not overflow.
  static std::size_t product(std::size_t components, std::size_t count) {
    return components * count;
  }

  void skipMetadata() {  // up to an empty line
    in_.skipLine();
    while (in_.remaining() > 0 && !in_.restOfLine().empty()) {
    }
  }

  void keep(const std::string& name, std::size_t components, std::vector<double> values) {
    if (!of_cells_ || values.empty() || (components != 1 && components != 3)) return;
    grid_.cell_data.push_back({name, components, std::move(values)});
  }

  /// Reads from after the type's name.
  std::vector<double> readArray(std::string_view type_name, std::size_t count) {
    const std::string name = lowerCase(type_name);
    if (name == "bit" && binary_) {  // unused data
      in_.skipLine();
      in_.bytes((count + 7) / 8, "array of bits");
      return {};
    }
    const auto type = name == "bit" ? ScalarType{ScalarType::kUnsigned, 1} : vtkType(name);
    if (!type) in_.fail(type_name, "must be a VTK type: int, float, double, vtktypeint64, ...");
    in_.skipLine();
    return readNumbers(*type, count);
  }

  std::vector<double> readNumbers(ScalarType type, std::size_t count) {
    std::vector<double> numbers;
    if (!binary_) {
      in_.checkCount(static_cast<std::int64_t>(count), "numbers", 2);
      numbers.resize(count);
      for (double& number : numbers) number = value();
      return numbers;
    }
    const char* data = in_.bytes(count * type.size, "array").data();
    numbers.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      numbers[i] = loadNumber(data + i * type.size, type, hostIsLittleEndian());
    }
    return numbers;
  }

  /// NaN is allowed in unused data; for points the builder refuses it.
  double value() {
    const std::string_view word = in_.word();
    const std::optional<double> number = parseAnyNumber(word);
    return number ? *number : in_.toNumber(word, "value of an array");
  }

  const std::string file_;
  Cursor in_;
  bool binary_ = false;
  bool of_cells_ = false;       // inside CELL_DATA
  std::size_t num_values_ = 0;  // of CELL_DATA or POINT_DATA
  VtkGrid grid_;
};

}  // namespace

mesh::TetMesh readVtk(const std::string& file, std::string_view bytes) {
  return LegacyVtkReader(file, bytes).read();
}

}  // namespace palpate::formats

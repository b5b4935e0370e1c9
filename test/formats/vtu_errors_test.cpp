// SPDX-License-Identifier: GPL-3.0-or-later
// What is said of VTK's XML files that are wrong.
#include <gtest/gtest.h>

#include "formats/refusals.h"
#include "formats/tet_formats.h"
#include "formats/tet_samples.h"

namespace palpate::formats::vtu_errors_test {
namespace {

void expectOfVtu(const VtuForm& form, const std::vector<Spoiling>& spoilings) {
  expectRefusals(parseTetMesh, "a.vtu", vtuSample(form), spoilings);
}

TEST(VtuErrors, OfTheXml) {
  expectOfVtu({},
              {{"</Points>", "", "line 15: truncated, or no XML (XML_ERROR_MISMATCHED_ELEMENT)"},
               {"type=\"UnstructuredGrid\"", "type=\"PolyData\"",
                "VTKFile: there must be a VTKFile of type UnstructuredGrid"},
               {"<UnstructuredGrid>", "<UnstructuredGrid/><UnstructuredGrid>",
                "line 3, UnstructuredGrid: must have an element Piece"},
               {"<CellData>", "</Piece><Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"><CellData>",
                "line 4, Piece: must have an element Points"}});
  expectRefusals(parseTetMesh, "a.vtu",
                 {{"<Mesh/>", "VTKFile: there must be a VTKFile of type UnstructuredGrid"},
                  {"<VTKFile type=\"UnstructuredGrid\">\n</VTKFile>",
                   "line 1, VTKFile: must have an element UnstructuredGrid"},
                  {"<VTKFile type=\"UnstructuredGrid\"><AppendedData encoding=\"raw\">",
                   "AppendedData: truncated: '_' and the data must follow"}});
}

TEST(VtuErrors, OfTheRoot) {
  const std::string order = "byte_order=\"LittleEndian\"";
  expectOfVtu(
      {},
      {{order, "byte_order=\"Middle\"",
        "line 2, VTKFile = Middle: byte_order must be LittleEndian or BigEndian"},
       {order, "header_type=\"UInt16\"",
        "line 2, VTKFile = UInt16: header_type must be UInt32 or UInt64"},
       {order, "compressor=\"vtkLZ4DataCompressor\"",
        "line 2, VTKFile = vtkLZ4DataCompressor: the compressor must be vtkZLibDataCompressor, or "
        "none"}});
}

TEST(VtuErrors, OfPieces) {
  const std::string points = ": NumberOfPoints must be a number of 0 ... 2147483647";
  expectOfVtu(
      {}, {{"NumberOfPoints=\"6\"", "", "line 4, Piece" + points},
           {"NumberOfPoints=\"6\"", "NumberOfPoints=\"six\"", "line 4, Piece = six" + points},
           {"NumberOfPoints=\"6\"", "NumberOfPoints=\"2147483648\"",
            "line 4, Piece = 2147483648" + points},
           {"NumberOfCells=\"3\"", "NumberOfCells=\"-3\"",
            "line 4, Piece = -3: NumberOfCells must be a number of 0 ... 2147483647"},
           {"\"Points\" NumberOfComponents=\"3\"", "\"Points\" NumberOfComponents=\"2\"",
            "line 16, DataArray 'Points': NumberOfComponents must be 3"},
           {"Name=\"types\"", "Name=\"kinds\"", "line 20, Cells: must have a DataArray 'types'"},
           {"3 7 11", "3 7 -1", "line 24, DataArray 'offsets': the last offset is out of range"},
           {"3 7 11", "3 7 nan", "line 24, DataArray 'offsets': the last offset is out of range"},
           {"3 7 11", "3 7 2147483648",
            "line 24, DataArray 'offsets': the last offset is out of range"}});
}

TEST(VtuErrors, OfArraysInText) {
  const std::string types = "line 27, DataArray 'types'";
  expectOfVtu({},
              {{"type=\"UInt8\"", "type=\"UChar\"",
                types + " = UChar: the type must be Int8 ... UInt64, Float32 or Float64"},
               {"\"types\" NumberOfComponents=\"1\" format=\"ascii\"",
                "\"types\" NumberOfComponents=\"1\" format=\"hex\"",
                types + " = hex: the format must be ascii, binary or appended"},
               {"5 10 10", "5 ten 10", types + " = ten: must be a number"},
               {"5 10 10", "5 10     ", types + ": truncated: must have 3 numbers"},
               {"5 10 10\n", "5 1", types + ": truncated: 6 bytes are needed, there are 5 at most"},
               {"5 10 10", "5 10 10 10", types + ": must have 3 numbers, not more"}});
}

TEST(VtuErrors, OfBlocks) {
  const VtuForm base64_form = {VtuForm::kBase64, false, false, false};
  const std::string types = vtuBlock(packed<unsigned char>({5, 10, 10}), base64_form, true);
  const std::string where = "line 27, DataArray 'types'", no_base64 = ": truncated, or no base64";
  ASSERT_EQ(types.size(), 12U);
  expectOfVtu(
      base64_form,
      {{"NumberOfPoints=\"6\"", "NumberOfPoints=\"5\"",
        "line 16, DataArray 'Points' = 72 bytes: must have 60 bytes by the number of points "
        "and cells"},
       {types, "", where + no_base64},
       {types, types.substr(0, 4), where + no_base64},
       {types, '*' + types.substr(1), where + no_base64},
       {types, types.substr(0, 8) + "****", where + no_base64},
       {types, base64(packed<unsigned>({3})),
        where + ": truncated: 3 bytes are needed, there are 1 at most"}});
}

// The block of the points: 72 bytes in three parts of at most 32.
TEST(VtuErrors, OfCompressedBlocks) {
  const std::string good = vtuSample({VtuForm::kAppendedRaw, false, false, true});
  const std::string head = packed<unsigned>({3, 32, 8});
  const std::size_t sizes = good.find(head) + head.size(), data = sizes + 12;
  const auto spoilt = [&](const std::vector<double>& numbers) {
    return changed(good, head, packed<unsigned>(numbers));
  };
  const std::string where = "line 12, DataArray 'Points'";
  const std::string no_parts = ": the parts are larger than the whole";
  const std::string no_size = " bytes: must have 72 bytes by the number of points and cells";
  const std::string no_data = ": the compressed data is damaged";
  const std::string behind_sizes = std::to_string(good.size() - data);
  std::string damaged = good;
  damaged[data + 5] = static_cast<char>(damaged[data + 5] ^ 0x55);
  expectRefusals(
      parseTetMesh, "a.vtu",
      {{spoilt({3, 37, 8}), where + no_parts},
       {spoilt({3, 32, 73}), where + no_parts},
       {spoilt({3, 32, 9}), where + " = 73" + no_size},
       {spoilt({0, 32, 8}), where + " = 0" + no_size},
       {spoilt({1e9, 32, 8}), where + ": truncated: 1000000000 bytes are needed, there are " +
                                  std::to_string((good.size() - sizes) / 4) + " at most"},
       {std::string(good).replace(sizes, 4, packed<unsigned>({1e6})),
        where + ": truncated: 1000000 bytes are needed, there are " + behind_sizes + " at most"},
       {damaged, where + no_data}});
}

// The block of the types: one part, the last of the file, and of three bytes.
TEST(VtuErrors, OfPartsThatAreTooShort) {
  const VtuForm form = {VtuForm::kAppendedRaw, false, false, true};
  const std::string three = vtuBlock(packed<unsigned char>({5, 10, 10}), form, false);
  const std::string two = vtuBlock(packed<unsigned char>({5, 10}), form, false);
  const std::string where = "line 17, DataArray 'types'";
  expectOfVtu(
      form,
      {{three, two, where + " = 2 bytes: must have 3 bytes by the number of points and cells"},
       {three, changed(two, packed<unsigned>({1, 32, 2}), packed<unsigned>({1, 32, 3})),
        where + ": the compressed data is damaged"}});
}

// A last part larger than the others would be read as far as those go, and zeros behind.
TEST(VtuErrors, OfALastPartThatIsTooLarge) {
  const VtuForm form = {VtuForm::kAppendedRaw, false, false, true};
  const std::string good = vtuBlock(packed<unsigned char>({5, 10, 10}), form, false);
  expectOfVtu(form,
              {{good, changed(good, packed<unsigned>({1, 32, 3}), packed<unsigned>({1, 2, 3})),
                "line 17, DataArray 'types': the last part must not be larger than the "
                "others"}});
}

}  // namespace
}  // namespace palpate::formats::vtu_errors_test

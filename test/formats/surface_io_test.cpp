// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/formats/surface_io.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>

#include "formats/surface_samples.h"
#include "support/contains.h"
#include "support/input_error.h"
#include "support/temp_folder.h"

namespace palpate::formats::surface_io_test {
namespace {

const test::TempFolder& dir() {
  static const test::TempFolder temp;
  return temp;
}

mesh::SurfaceMesh readText(const std::string& name, const std::string& text) {
  return readSurface(dir().write(name, text));
}
std::string complaintAbout(const std::string& name, const std::string& text) {
  return test::complaint([&] { readText(name, text); });
}

void expectTetrahedron(const mesh::SurfaceMesh& surface) {
  ASSERT_EQ(surface.points.cols(), 4);
  ASSERT_EQ(surface.triangles.cols(), 4);
  for (int f = 0; f < 4; ++f) {
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(Vec3(surface.points.col(surface.triangles(c, f))), Vec3(kCorners[kFaces[f][c]]));
    }
  }
  EXPECT_NEAR(mesh::enclosedVolume(surface), 1.0 / 6.0, 1e-15);
}

class EverySurfaceFormat : public testing::TestWithParam<Sample> {};

TEST_P(EverySurfaceFormat, ReadsATetrahedron) {
  expectTetrahedron(readText("a" + GetParam().extension, GetParam().bytes));
}

TEST_P(EverySurfaceFormat, IgnoresTheCaseOfTheExtension) {
  std::string extension = GetParam().extension;
  extension[1] = static_cast<char>(extension[1] - 'a' + 'A');
  expectTetrahedron(readText("a.b" + extension, GetParam().bytes));
}

TEST_P(EverySurfaceFormat, RefusesMissingAndEmptyFiles) {
  const std::string missing = dir().path("missing" + GetParam().extension);
  EXPECT_EQ(test::complaint([&] { readSurface(missing); }), missing + ": no such file");
  const std::string empty = "empty" + GetParam().extension;
  EXPECT_EQ(complaintAbout(empty, ""), dir().path(empty) + ": the file is empty");
  EXPECT_NE(complaintAbout(empty, "\n"), "");
}

class EveryTextFormat : public EverySurfaceFormat {};

TEST_P(EveryTextFormat, ReadsWindowsLineEnds) {
  std::string text;
  for (const char c : GetParam().bytes) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  expectTetrahedron(readText("a" + GetParam().extension, text));
}

std::vector<Sample> textSamples() {
  std::vector<Sample> samples;
  for (const Sample& sample : surfaceSamples()) {
    const bool binary =
        test::contains(sample.name, "binary") || test::contains(sample.name, "endian");
    if (!binary) samples.push_back(sample);
  }
  return samples;
}

INSTANTIATE_TEST_SUITE_P(All, EveryTextFormat, testing::ValuesIn(textSamples()),
                         [](const auto& sample) { return sample.param.name; });
INSTANTIATE_TEST_SUITE_P(All, EverySurfaceFormat, testing::ValuesIn(surfaceSamples()),
                         [](const auto& sample) { return sample.param.name; });

TEST(Surface, UnknownExtensionListsTheKnownOnes) {
  const std::string text = complaintAbout("a.blend", "x");
  EXPECT_TRUE(test::contains(text, "extension = .blend")) << text;
  EXPECT_TRUE(test::contains(text, ".obj, .off, .ply, .stl, .wrl")) << text;
  EXPECT_NE(complaintAbout("a", "x"), "");
}

TEST(Surface, FolderIsRefused) {
  std::filesystem::create_directories(dir().path("folder.obj"));
  EXPECT_TRUE(test::contains(test::complaint([] { readSurface(dir().path("folder.obj")); }),
                             "regular file"));
}

TEST(Surface, NumbersAreReadInAnyLocale) {
  if (!std::setlocale(LC_ALL, "de_DE.UTF-8"))
    GTEST_SKIP() << "needs a locale with a decimal comma: de_DE.UTF-8 is not installed";
  const mesh::SurfaceMesh surface = readText("a.obj", "v 0.5 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  std::setlocale(LC_ALL, "C");
  EXPECT_EQ(surface.points(0, 0), 0.5);
}

TEST(Obj, ReadsAllFormsOfFaces) {
  const mesh::SurfaceMesh surface =
      readText("a.obj",
               "v 0 0 0\nvt 0 0\nvn 0 0 1\nv 1 0 0 1.0\nv 1 1 0\n"
               "v 0 1 0  # last\nf 1/1 2/1 3/1\nf 1//1 3//1 4//1\n"
               "f -4/1/1 -3/1/1 -2/1/1\nf 1 2 \\\n 3 4\ns off\ng name\n");
  Eigen::Matrix3Xi expected(3, 5);
  expected << 0, 0, 0, 0, 0, 1, 2, 1, 1, 2, 2, 3, 2, 2, 3;
  EXPECT_EQ(surface.triangles, expected);
}

TEST(Obj, NamesTheLinesOfAllBadFaces) {
  const std::string text =
      complaintAbout("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\nf 1 2\nf -4 1 2\n");
  EXPECT_TRUE(test::contains(text, "a.obj: line 4 = corner 3: the index is out of range")) << text;
  EXPECT_TRUE(test::contains(text, "line 5 = 2 corners: a face must have 3 corners")) << text;
  EXPECT_TRUE(test::contains(text, "line 6 = corner 1")) << text;
}

TEST(Obj, RefusesBadNumbers) {
  EXPECT_TRUE(test::contains(complaintAbout("a.obj", "v 0 0 0\nv 0 nan 0\n"),
                             "line 2 = nan: must be finite: y of a vertex"));
  EXPECT_TRUE(test::contains(complaintAbout("a.obj", "v 0 0 1e999\n"), "must be finite"));
  EXPECT_TRUE(test::contains(complaintAbout("a.obj", "v 0 0,5 0\n"), "must be a number"));
  EXPECT_TRUE(test::contains(complaintAbout("a.obj", "v 0 0\nv 1 1 1\n"), "line 1"));
  EXPECT_TRUE(test::contains(complaintAbout("a.obj", "v 0 0 0\nf 0 1 1\n"), "must not be 0"));
  EXPECT_TRUE(test::contains(complaintAbout("a.obj", "v 0 0 0\nf 1 1.5 1\n"), "whole number"));
  EXPECT_TRUE(test::contains(complaintAbout("a.obj", "v 0 0 0\n"), "there is no triangle"));
}

TEST(Surface, PointsThatNoTriangleUsesAreDropped) {
  const mesh::SurfaceMesh surface =
      readText("a.obj", "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 8 8 8\nv 0 1 0\nf 2 3 5\n");
  EXPECT_EQ(surface.points, (Points(3, 3) << 0, 1, 0, 0, 0, 1, 0, 0, 0).finished());
  EXPECT_EQ(surface.triangles, Eigen::Vector3i(0, 1, 2));
}

TEST(Off, IgnoresColoursNormalsAndComments) {
  const mesh::SurfaceMesh surface =
      readText("a.off",
               "CNOFF # header\n\n4 1 0\n# points\n0 0 0 0 0 1 255 0 0\n"
               "1 0 0 0 0 1 255 0 0\n\n1 1 0 0 0 1 255 0 0 # third\n"
               "0 1 0 0 0 1 0 0 0\n4 0 1 2 3 0.5 0.5 0.5\n");
  EXPECT_EQ(surface.points.cols(), 4);
  EXPECT_EQ(surface.triangles, (Eigen::Matrix3Xi(3, 2) << 0, 0, 1, 2, 2, 3).finished());
}

TEST(Off, RefusesWhatIsWrong) {
  EXPECT_TRUE(test::contains(complaintAbout("a.off", "4OFF\n1 1 0\n"), "must begin with OFF"));
  EXPECT_TRUE(test::contains(complaintAbout("a.off", "OFF BINARY\n1 1 0\n"), "binary OFF"));
  EXPECT_TRUE(test::contains(complaintAbout("a.off", "OFF\n1000000 4 6\n0 0 0\n"), "only"));
  EXPECT_TRUE(
      test::contains(complaintAbout("a.off", "OFF\n-1 4 6\n0 0 0\n"), "must not be negative"));
  EXPECT_TRUE(test::contains(complaintAbout("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"),
                             "line 6 = corner 3"));
  EXPECT_TRUE(test::contains(complaintAbout("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n"),
                             "whole number"));
  EXPECT_TRUE(test::contains(complaintAbout("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n"),
                             "3 corners or more"));
}

TEST(Stl, MergesBitwiseEqualPointsOnly) {
  const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";
  const mesh::SurfaceMesh surface =
      readText("a.stl", "solid\n" + facet + "vertex 0 1 0\nendloop\nendfacet\n" + facet +
                            "vertex -0.0 1.0000001 0\nendloop\nendfacet\nendsolid\n");
  EXPECT_EQ(surface.points.cols(), 4);
  const mesh::SurfaceMesh zero =
      readText("a.stl", "solid\n" + facet + "vertex 0 1 0\nendloop\nendfacet\n" + facet +
                            "vertex -0.0 1 -0\nendloop\nendfacet\nendsolid\n");
  EXPECT_EQ(zero.points.cols(), 3);
}

TEST(Stl, BinaryFileMayBeginWithSolid) {
  expectTetrahedron(readText("a.stl", stlBinarySample("solid as exported")));
}

TEST(Stl, RefusesWhatIsWrong) {
  std::string nan = stlBinarySample();
  nan.replace(84 + 12, 4, packed<float>({std::nan("")}));
  EXPECT_TRUE(test::contains(complaintAbout("a.stl", nan), "must be finite"));
  std::string huge = stlBinarySample();
  huge.replace(80, 4, "\xFF\xFF\xFF\xFF");
  EXPECT_TRUE(test::contains(complaintAbout("a.stl", huge), "4294967295 facets"));
  std::string none = stlBinarySample().substr(0, 84);
  none.replace(80, 4, std::string(4, '\0'));
  EXPECT_TRUE(test::contains(complaintAbout("a.stl", none), "there is no triangle"));
  std::string open = stlTextSample();
  open.resize(open.find("endsolid"));
  EXPECT_TRUE(test::contains(complaintAbout("a.stl", open), "'endsolid' must follow"));
  EXPECT_TRUE(
      test::contains(complaintAbout("a.stl", "solid\nfacet\nvertex 1 2 x\n"), "line 3 = x"));
  EXPECT_TRUE(test::contains(
      complaintAbout("a.stl", "solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendsolid\n"),
      "2 corners"));
}

TEST(Ply, ReadsOtherPropertiesElementsAndPolygons) {
  const mesh::SurfaceMesh surface =
      readText("a.ply",
               "ply\nformat ascii 1.0\nelement camera 1\nproperty list int float view\n"
               "element vertex 4\nproperty list uchar int tags\nproperty float z\n"
               "property float y\nproperty float x\nelement face 1\nproperty float quality\n"
               "property list uchar uint vertex_index\nproperty list uchar float texcoord\n"
               "element edge 1\nproperty int a\nend_header\n"
               "2 0.5 0.5\n1 7 0 0 0\n0 0 0 1\n0 0 1 1\n0 0 1 0\n0.5 4 0 1 2 3 2 0 0\n5\n");
  EXPECT_EQ(surface.points, (Points(3, 4) << 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0).finished());
  EXPECT_EQ(surface.triangles.cols(), 2);
}

TEST(Ply, RefusesWhatIsWrong) {
  const std::string good = plyTextSample();
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return complaintAbout("a.ply", text);
  };
  EXPECT_TRUE(test::contains(with("ply", "plx"), "must be 'ply'"));
  EXPECT_TRUE(test::contains(with("ascii", "zip"), "binary_little_endian"));
  EXPECT_TRUE(test::contains(with("float y", "float w"), "property 'y'"));
  EXPECT_TRUE(test::contains(with("vertex_indices", "corners"), "vertex_indices"));
  EXPECT_TRUE(test::contains(with("element vertex 4", "element vertex 99999"), "line 4 = 99999"));
  EXPECT_TRUE(test::contains(with("element face", "element fact"), "element 'face'"));
  EXPECT_TRUE(test::contains(with("3 1 2 3", "3 1 2 4"), "face 4 = corner 3"));
  EXPECT_TRUE(test::contains(with("3 1 2 3", "2 1 2"), "face 4 = 2 corners"));
  EXPECT_TRUE(test::contains(with("3 1 2 3", "3 1 2"), "ends where"));
  EXPECT_TRUE(test::contains(with("3 1 2 3", "3 1 2 -1"), "out of range"));
}

// Of whatever length the axis is.
TEST(Wrl, AppliesTransformsAndUse) {
  for (const std::string axis : {"2", "2e200", "2e-200"}) {
    const mesh::SurfaceMesh surface = readText(
        "a.wrl", "#VRML V2.0 utf8\nDEF T Transform { translation 10 0 0 rotation 0 0 " + axis +
                     " 1.5707963267948966\n"
                     " scale 2 2 2 center 1 0 0 children [ Group { children DEF S Shape { geometry "
                     "IndexedFaceSet { coord DEF C Coordinate { point [ 1 0 0 2 0 0 1 1 0 ] } "
                     "coordIndex [ 0 1 2 -1 ] } } } ] }\nUSE S\nROUTE T.a TO T.b\n");
    ASSERT_EQ(surface.points.cols(), 6);
    // 1 0 0 is the centre; 2 0 0 goes to 2 along y of it; 1 1 0 to -2 along x.
    Points expected(3, 6);
    expected << 11, 11, 9, 1, 2, 1, 0, 2, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0;
    EXPECT_LT((surface.points - expected).cwiseAbs().maxCoeff(), 1e-14) << axis;
  }
}

TEST(Wrl, MirrorsAndClockwiseFacesTurnTheOrder) {
  const auto read = [](const std::string& transform, const std::string& ccw) {
    return readText("a.wrl",
                    "#VRML V2.0 utf8\nTransform { " + transform +
                        " children Shape { geometry IndexedFaceSet { " + ccw +
                        " coord Coordinate { point [ 0 0 0 1 0 0 0 1 0 0 0 1 ] }\n coordIndex "
                        "[ 0 2 1 -1 0 1 3 -1 0 3 2 -1 1 2 3 -1 ] } } }\n");
  };
  EXPECT_NEAR(mesh::enclosedVolume(read("", "")), 1.0 / 6, 1e-15);
  EXPECT_NEAR(mesh::enclosedVolume(read("scale -1 1 1", "")), 1.0 / 6, 1e-15);
  EXPECT_NEAR(mesh::enclosedVolume(read("", "ccw FALSE")), -1.0 / 6, 1e-15);
  EXPECT_NEAR(mesh::enclosedVolume(read("scale 1 -3 1", "ccw FALSE")), -0.5, 1e-15);
}

TEST(Wrl, SwitchAndLodShowOneChild) {
  const std::string shape =
      "Shape { geometry IndexedFaceSet { coord Coordinate { point [ 0 0 0 1 0 0 0 1 0 ] } "
      "coordIndex [ 0 1 2 ] } }";
  const std::string text = "#VRML V2.0 utf8\nSwitch { whichChoice 1 choice [ " + shape + " " +
                           shape + " ] }\nLOD { level [ " + shape + " " + shape + " ] }\n";
  EXPECT_EQ(readText("a.wrl", text).triangles.cols(), 2);
}

TEST(Wrl, RefusesWhatIsWrong) {
  const std::string header = "#VRML V2.0 utf8\n";
  EXPECT_TRUE(test::contains(complaintAbout("a.wrl", "#VRML V1.0 ascii\n"), "VRML 1 is not read"));
  EXPECT_TRUE(test::contains(complaintAbout("a.wrl", header + "USE A\n"), "DEF named before"));
  EXPECT_TRUE(test::contains(complaintAbout("a.wrl", header + "PROTO A [] {}\n"), "prototypes"));
  EXPECT_TRUE(test::contains(complaintAbout("a.wrl", header + "Shape { geometry Sphere {} }\n"),
                             "line 2 = Sphere: must be an IndexedFaceSet"));
  EXPECT_TRUE(
      test::contains(complaintAbout("a.wrl", header + "Inline { url \"b.wrl\" }\n"), "Inline"));
  EXPECT_TRUE(test::contains(complaintAbout("a.wrl", header + "Group { children ["), "truncated"));
  const auto faces = [&](const std::string& indices) {
    return complaintAbout("a.wrl", header +
                                       "Shape { geometry IndexedFaceSet { coord Coordinate { point "
                                       "[ 0 0 0 1 0 0 0 1 0 ] } coordIndex [ " +
                                       indices + " ] } }");
  };
  EXPECT_TRUE(test::contains(faces("0 1 3"), "face 1 = corner 3: the index is out of range"));
  EXPECT_TRUE(test::contains(faces("0 1 2 -1 0 1"), "face 2 = 2 corners"));
  EXPECT_TRUE(test::contains(faces("0 1 0.5"), "whole numbers"));
  EXPECT_TRUE(test::contains(faces("0 1 -2"), "out of range"));
}

TEST(Wrl, DeepAndMultiplyingNodesAreRefused) {
  std::string deep = "#VRML V2.0 utf8\n";
  for (int i = 0; i < 100000; ++i) deep += "Group { children ";
  EXPECT_TRUE(test::contains(complaintAbout("a.wrl", deep), "too deep"));
  std::string chain = "#VRML V2.0 utf8\nDEF N0 Group {}\n";
  std::string doubling = chain;
  for (int i = 1; i < 10000; ++i) {
    const std::string use = "USE N" + std::to_string(i - 1);
    const std::string group = "DEF N" + std::to_string(i) + " Group { children [ " + use;
    chain += group + " ] }\n";
    if (i < 60) doubling += group + " " + use + " ] }\n";
  }
  EXPECT_TRUE(test::contains(complaintAbout("a.wrl", chain), "too deep"));
  EXPECT_TRUE(test::contains(complaintAbout("a.wrl", doubling), "too many nodes"));
}

TEST(WriteSurface, IsReadBackBitForBit) {
  mesh::SurfaceMesh surface;
  surface.points = Points(3, 3);
  surface.points << 0.1, 1.0 / 3.0, 1e-300, -2e17, M_PI, 5e-324, 0, -1, 123456.789;
  surface.triangles.resize(3, 1);
  surface.triangles << 2, 0, 1;
  for (const std::string name : {"b.off", "b.obj", "b.OBJ"}) {
    const std::string file = dir().path(name);
    writeSurface(file, surface);
    const mesh::SurfaceMesh back = readSurface(file);
    EXPECT_EQ(back.points, surface.points) << name;
    EXPECT_EQ(back.triangles, surface.triangles) << name;
    const std::string first = test::fileBytes(file);
    writeSurface(file, surface);
    EXPECT_EQ(test::fileBytes(file), first);
  }
  EXPECT_TRUE(
      test::contains(test::complaint([&] { writeSurface(dir().path("b.stl"), surface); }), ".off"));
  EXPECT_THROW(writeSurface(dir().path("no/such/folder.off"), surface), std::runtime_error);
}

TEST(WriteSurface, LeavesNothingElseBehind) {
  const test::TempFolder temp;
  writeSurface(temp.path("a.off"), readText("a.obj", objSample()));
  std::filesystem::create_directories(temp.path("b.off"));  // cannot be replaced by a file
  EXPECT_THROW(writeSurface(temp.path("b.off"), readText("a.obj", objSample())),
               std::runtime_error);
  int entries = 0;
  for ([[maybe_unused]] const auto& e : std::filesystem::directory_iterator(temp.path("")))
    ++entries;
  EXPECT_EQ(entries, 2);
}

}  // namespace
}  // namespace palpate::formats::surface_io_test

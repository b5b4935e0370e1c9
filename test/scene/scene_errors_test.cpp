// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "palpate/scene/scene.h"
#include "support/input_error.h"
#include "support/temp_folder.h"

namespace palpate::scene::scene_errors_test {
namespace {

using test::hasProblem;

constexpr char kGood[] = R"(organs:
  - name: liver
    surface: liver.obj
    material: {young_modulus: 6000.0, poisson_ratio: 0.45, density: 1060.0}
    supports:
      - select: {plane: {axis: z, at: 0.0}}
instruments:
  - name: probe
    urdf: probe.urdf
    control_frame: tip
solver: {step: 0.01}
)";

class SceneErrors : public ::testing::Test {
 protected:
  std::vector<Problem> problemsOfText(const std::string& text) const {
    const std::string file = folder_.write("scene.yaml", text);
    return test::problemsOf([&] { readScene(file); });
  }
  /// Problems of the good scene with `from` turned into `to`.
  std::vector<Problem> problemsWith(const std::string& from, const std::string& to) const {
    std::string text = kGood;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return problemsOfText(text.replace(at, from.size(), to));
  }

  test::TempFolder folder_;
};

TEST_F(SceneErrors, TheGoodOneHasNone) {
  EXPECT_NO_THROW(readScene(folder_.write("good.yaml", kGood)));
}

TEST_F(SceneErrors, SheetsThatCannotBe) {
  const std::string sheet =
      "model: cloth\n    cloth: {thickness: 1.0e-3, width: 0.1, length: 0.1, spacing: 0.005}";
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = sheet;
    const std::size_t at = text.find(from);
    return problemsWith("surface: liver.obj", text.replace(at, from.size(), to));
  };
  std::string good = kGood;
  good.replace(good.find("surface: liver.obj"), std::string("surface: liver.obj").size(), sheet);
  EXPECT_NO_THROW(readScene(folder_.write("sheet.yaml", good)));
  EXPECT_TRUE(hasProblem(with("model: cloth", "model: cloth\n    tetrahedra: liver.vtu"),
                         "organs[0].tetrahedra", "takes no tetrahedra"));
  EXPECT_TRUE(hasProblem(with("model: cloth", "model: cloth\n    surface: liver.obj"), "organs[0]",
                         "either a surface or cloth.width"));
  EXPECT_TRUE(hasProblem(with("1.0e-3", "0.0"), "organs[0].cloth.thickness", "above 0"));
  EXPECT_TRUE(hasProblem(with("spacing: 0.005", "rolled: {}"), "organs[0].cloth", "needs all of"));
  EXPECT_TRUE(hasProblem(with("0.005}", "0.005, rolled: {gap_least: 2.0e-3}}"),
                         "organs[0].cloth.rolled.gap_least", "less than gap_most"));
  EXPECT_TRUE(hasProblem(problemsWith("surface: liver.obj",
                                      "surface: liver.obj\n    cloth: {width: 0.1, length: 0.1, "
                                      "spacing: 0.01}"),
                         "organs[0].cloth.width", "for model cloth"));
}

TEST_F(SceneErrors, NoSuchFile) {
  EXPECT_TRUE(hasProblem(test::problemsOf([&] { readScene(folder_.path("absent.yaml")); }), "",
                         "no such file"));
  EXPECT_TRUE(hasProblem(test::problemsOf([&] { readScene(folder_.path("")); }), "", "folder"));
}

TEST_F(SceneErrors, EmptyFile) {
  EXPECT_TRUE(hasProblem(problemsOfText(""), "", "is empty"));
  EXPECT_TRUE(hasProblem(problemsOfText("# only a comment\n"), "", "is empty"));
}

TEST_F(SceneErrors, NotYaml) {
  EXPECT_TRUE(hasProblem(problemsOfText("organs:\n  - name: [a\nrates: {"), "line 3", "not YAML"));
}

TEST_F(SceneErrors, NotAMap) {
  EXPECT_TRUE(hasProblem(problemsOfText("- a\n- b\n"), "", "keys with values"));
  EXPECT_TRUE(hasProblem(problemsOfText("just words"), "", "keys with values"));
}

TEST_F(SceneErrors, SeveralDocuments) {
  EXPECT_TRUE(hasProblem(problemsOfText(std::string(kGood) + "---\nname: second\n"), "",
                         "several YAML documents"));
}

TEST_F(SceneErrors, FrictionIsOfWhatThereIsAndDoesNotGrowBySlipping) {
  const auto problemsOf = [&](const std::string& friction) {
    return problemsWith("solver:", "contact: {friction: " + friction + "}\nsolver:");
  };
  EXPECT_TRUE(hasProblem(problemsOf("{static: 0.2, kinetic: 0.3}"), "contact.friction.kinetic",
                         "must not be larger than static"));
  EXPECT_TRUE(hasProblem(problemsOf("{pairs: [{instrument: knife, static: 0.2}]}"),
                         "contact.friction.pairs[0]", "must name organs, instruments"));
  EXPECT_TRUE(hasProblem(problemsOf("{pairs: [{link: tip, static: 0.2}]}"),
                         "contact.friction.pairs[0].link", "needs the key instrument"));
  EXPECT_TRUE(hasProblem(problemsOf("{static: -0.1}"), "contact.friction.static", ""));
}

TEST_F(SceneErrors, FrictionThatSlipsIsTheStaticOneWhereItIsLeftOut) {
  std::string text = kGood;
  text += "contact: {friction: {static: 0.4, pairs: [{organ: liver, static: 0.5, kinetic: 0.1}]}}";
  const FrictionConfig friction = readScene(folder_.write("scene.yaml", text)).contact.friction;
  EXPECT_EQ(friction.sliding, 0.4);
  ASSERT_EQ(friction.pairs.size(), 1U);
  EXPECT_EQ(friction.pairs[0].sliding, 0.1);
}

TEST_F(SceneErrors, OrgansThatAreNotThereCannotBeApart) {
  const auto problems =
      problemsWith("solver:", "contact: {apart: [{organ: liver, other: spleen}]}\nsolver:");
  EXPECT_TRUE(
      hasProblem(problems, "contact.apart[0]", "liver, spleen: must be the names of organs"));
  EXPECT_TRUE(hasProblem(problemsWith("solver:", "contact: {apart: [{organ: liver}]}\nsolver:"),
                         "contact.apart[0].other", "is missing"));
}

TEST_F(SceneErrors, UnknownKeyNamesTheNearest) {
  EXPECT_TRUE(hasProblem(problemsWith("solver: {step", "solver: {stepp"), "solver.stepp",
                         "did you mean step?"));
  EXPECT_TRUE(hasProblem(problemsWith("    surface", "    scal: 1\n    surface"), "organs[0].scal",
                         "did you mean scale?"));
  EXPECT_TRUE(hasProblem(problemsWith("poisson_ratio", "poison_ratio"),
                         "organs[0].material.poison_ratio", "did you mean poisson_ratio?"));
}

TEST_F(SceneErrors, ProblemsNameTheLine) {
  EXPECT_TRUE(hasProblem(problemsWith("step: 0.01", "step: 0.5"), "solver.step", "[line 11]"));
}

TEST_F(SceneErrors, DuplicateKey) {
  EXPECT_TRUE(hasProblem(problemsWith("step: 0.01", "step: 0.01, step: 0.02"), "solver.step",
                         "stands twice"));
  EXPECT_TRUE(hasProblem(problemsOfText(std::string(kGood) + "solver: {step: 0.02}\n"), "solver",
                         "stands twice [line 12]"));
}

TEST_F(SceneErrors, WrongTypes) {
  EXPECT_TRUE(hasProblem(problemsWith("step: 0.01", "step: fast"), "solver.step",
                         "must be a number in (0, 0.1] [s]"));
  EXPECT_TRUE(hasProblem(problemsWith("step: 0.01", "step: \"0.01\""), "solver.step", "number"));
  EXPECT_TRUE(hasProblem(problemsWith("step: 0.01", "step: [0.01]"), "solver.step", "number"));
  EXPECT_TRUE(hasProblem(problemsWith("step: 0.01", "step:"), "solver.step", "number"));
  EXPECT_TRUE(hasProblem(problemsWith("step: 0.01", "threads: 1.5"), "solver.threads", "whole"));
  EXPECT_TRUE(hasProblem(problemsWith("{step: 0.01}", "7"), "solver", "must be a section"));
  EXPECT_TRUE(hasProblem(problemsWith("{step: 0.01}", "[7]"), "solver", "must be a section"));
  EXPECT_TRUE(hasProblem(problemsWith("solver:", "gravity: [0, 0]\nsolver:"), "gravity",
                         "list of three numbers"));
  EXPECT_TRUE(hasProblem(problemsWith("solver:", "gravity: [0, 0, x]\nsolver:"), "gravity",
                         "list of three numbers"));
  EXPECT_TRUE(hasProblem(problemsWith("    urdf", "    cylinder_as_capsule: 1\n    urdf"),
                         "instruments[0].cylinder_as_capsule", "true or false"));
  EXPECT_TRUE(hasProblem(problemsWith("surface: liver.obj", "surface: {a: b}"), "organs[0].surface",
                         "must be text"));
  EXPECT_TRUE(hasProblem(problemsWith("name: liver", "name: right lobe"), "organs[0].name",
                         "must be a name"));
  EXPECT_TRUE(hasProblem(problemsOfText("organs: liver\n"), "organs", "must be a list"));
  EXPECT_TRUE(hasProblem(problemsOfText("organs: [liver]\n"), "organs[0]", "must be a section"));
  EXPECT_TRUE(
      hasProblem(problemsWith("0.45", "[0.4, a]"), "organs[0].material.poisson_ratio", "number"));
}

TEST_F(SceneErrors, OutOfRange) {
  EXPECT_TRUE(hasProblem(problemsWith("step: 0.01", "step: 0"), "solver.step", "(0, 0.1]"));
  EXPECT_TRUE(hasProblem(problemsWith("1060.0", "-1060"), "organs[0].material.density", "in (0"));
  EXPECT_TRUE(hasProblem(problemsWith("step: 0.01", "threads: 99999999999"), "solver.threads",
                         "whole number in [1, 256]"));
  EXPECT_TRUE(hasProblem(problemsWith("    surface", "    scale: 0\n    surface"),
                         "organs[0].scale", "in (0"));
  EXPECT_TRUE(hasProblem(problemsWith("    surface", "    edge_length: 0\n    surface"),
                         "organs[0].edge_length", "[m]"));
  EXPECT_TRUE(
      hasProblem(problemsWith("solver:", "rates: {haptic: -5}\nsolver:"), "rates.haptic", "[Hz]"));
}

TEST_F(SceneErrors, EdgeLength) {
  const auto with = [&](const std::string& edge_length) {
    return problemsWith("    surface", "    edge_length: " + edge_length + "\n    surface");
  };
  for (const char* value : {"fine", "[0.01]", "0", "2"}) {
    EXPECT_TRUE(hasProblem(with(value), "organs[0].edge_length",
                           "a number in [0.0001, 1] [m], or a section"))
        << value;
  }
  const auto at = [&](const std::string& place) { return with("{near: [" + place + "]}"); };
  EXPECT_TRUE(
      hasProblem(with("{coarse: 0.02}"), "organs[0].edge_length.coarse", "did you mean coarsest?"));
  EXPECT_TRUE(hasProblem(with("{coarsest: 0}"), "organs[0].edge_length.coarsest", "[0.0001, 1]"));
  const std::string place = "organs[0].edge_length.near[0]";
  EXPECT_TRUE(hasProblem(at("{point: [0, 0, 0]}"), place + ".finest", "is missing"));
  EXPECT_TRUE(hasProblem(at("{finest: 0.02, surface: true}"), place + ".finest", "at most"));
  EXPECT_TRUE(hasProblem(at("{finest: 0.002, surface: true, growth: 0}"), place + ".growth", "0"));
  EXPECT_TRUE(
      hasProblem(at("{finest: 0.002, surface: true, growth: 1.1}"), place + ".growth", "1]"));
  EXPECT_TRUE(hasProblem(at("{finest: 0.002, surface: true, radius: -1}"), place + ".radius", "0"));
  for (const char* where : {"", ", surface: false", ", surface: true, point: [0, 0, 0]",
                            ", point: [0, 0, 0], path: [[0, 0, 0]]"}) {
    EXPECT_TRUE(hasProblem(at("{finest: 0.002" + std::string(where) + "}"), place,
                           "exactly one of point, path, region, surface, trajectory"))
        << where;
  }
  EXPECT_TRUE(hasProblem(at("{finest: 0.002, surface: true, instrument: probe}"),
                         place + ".instrument", "only with `trajectory`"));
  for (const char* path : {"[]", "0.1", "[0, 0, 0]", "[[0, 0]]", "[[0, 0, x]]", "[[0, 0, 1e9]]"}) {
    EXPECT_TRUE(hasProblem(at("{finest: 0.002, path: " + std::string(path) + "}"), place + ".path",
                           "list of points, at least 1"))
        << path;
  }
  EXPECT_TRUE(hasProblem(at("{finest: 0.002, region: {ball: {}}}"), place + ".region", "exactly"));
  EXPECT_TRUE(hasProblem(
      problemsWith("    surface: liver.obj",
                   "    tetrahedra: liver.msh\n    edge_length: {near: [{finest: 0.002, surface: "
                   "true}]}"),
      "organs[0].edge_length", "tetrahedra are used as they are"));
}

TEST_F(SceneErrors, NotFinite) {
  for (const char* value : {".nan", ".inf", "-.inf", "nan", "1e999"}) {
    SCOPED_TRACE(value);
    EXPECT_TRUE(hasProblem(problemsWith("0.01", value), "solver.step", "number"));
    EXPECT_TRUE(
        hasProblem(problemsWith("0.45", value), "organs[0].material.poisson_ratio", "finite"));
    EXPECT_TRUE(
        hasProblem(problemsWith("solver:", "gravity: [0, 0, " + std::string(value) + "]\nsolver:"),
                   "gravity", "three numbers"));
  }
}

TEST_F(SceneErrors, Material) {
  EXPECT_TRUE(hasProblem(problemsWith("0.45", "0.5"), "organs[0].material.poisson_ratio",
                         "in (-1, 0.5) [line 4]"));
  EXPECT_TRUE(hasProblem(problemsWith("6000.0", "-1"), "organs[0].material.young_modulus", "> 0"));
  EXPECT_TRUE(hasProblem(problemsWith("young_modulus: 6000.0", "mu: 1.0"), "organs[0].material",
                         "needs either"));
  EXPECT_TRUE(hasProblem(problemsWith("{young", "{law: neo_hokean, young"),
                         "organs[0].material.law", "did you mean neo_hookean?"));
}

TEST_F(SceneErrors, MissingRequiredKey) {
  EXPECT_TRUE(hasProblem(problemsWith("    control_frame: tip\n", ""),
                         "instruments[0].control_frame", "is missing"));
  EXPECT_TRUE(hasProblem(problemsWith("axis: z, ", ""), "organs[0].supports[0].select.plane.axis",
                         "is missing"));
  EXPECT_TRUE(hasProblem(problemsOfText("name: nothing\n"), "organs", "is missing"));
  EXPECT_TRUE(hasProblem(problemsOfText("organs: []\n"), "organs", "at least 1"));
}

TEST_F(SceneErrors, SurfaceOrTetrahedra) {
  EXPECT_TRUE(hasProblem(problemsWith("    surface: liver.obj\n", ""), "organs[0]",
                         "exactly one of surface, tetrahedra"));
  EXPECT_TRUE(hasProblem(problemsWith("    surface", "    tetrahedra: a.msh\n    surface"),
                         "organs[0]", "exactly one of surface, tetrahedra"));
}

TEST_F(SceneErrors, OneRegionInASelection) {
  EXPECT_TRUE(hasProblem(problemsWith("{plane: {axis: z, at: 0.0}}", "{}"),
                         "organs[0].supports[0].select", "exactly one of"));
  EXPECT_TRUE(
      hasProblem(problemsWith("at: 0.0}}", "at: 0.0}, sphere: {center: [0, 0, 0], radius: 1}}"),
                 "organs[0].supports[0].select", "exactly one of"));
  EXPECT_TRUE(hasProblem(
      problemsWith("{plane: {axis: z, at: 0.0}}", "{box: {min: [0, 0, 1], max: [1, 1, 0]}}"),
      "organs[0].supports[0].select.box.min", "<= max"));
  EXPECT_TRUE(hasProblem(problemsWith("axis: z", "axis: w"),
                         "organs[0].supports[0].select.plane.axis", "x, y, z"));
}

TEST_F(SceneErrors, NamesDiffer) {
  const std::string second =
      "  - {name: liver, surface: b.obj, material: {mu: 1.0, kappa: 1.0}}\ninstruments:\n"
      "  - {name: probe, urdf: a.urdf, control_frame: a}\n";
  const std::vector<Problem> problems = problemsWith("instruments:\n", second);
  EXPECT_TRUE(hasProblem(problems, "organs[1].name", "must differ [line 7]"));
  EXPECT_TRUE(hasProblem(problems, "instruments[1].name", "must differ"));
}

TEST_F(SceneErrors, ChoicesListWhatThereIs) {
  EXPECT_TRUE(hasProblem(problemsWith("    surface", "    element: tet5\n    surface"),
                         "organs[0].element", "must be one of"));
  EXPECT_TRUE(hasProblem(problemsWith("    urdf", "    input: joint\n    urdf"),
                         "instruments[0].input", "must be one of joints, tf (did you mean joints"));
}

TEST_F(SceneErrors, PrescribedContactTakesOneSoftBodyAndOneTool) {
  const std::string good =
      "solver: {method: newton_bicgstab}\ncontact: {model: prescribed}\ngravity: [0, 0, 0]\n";
  EXPECT_NO_THROW(readScene(folder_.write(
      "good.yaml", std::string(kGood).replace(std::string(kGood).find("solver:"), 20, good))));
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = kGood;
    text.replace(text.find("solver: {step: 0.01}\n"), 21, good);
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return problemsOfText(text.replace(at, from.size(), to));
  };
  EXPECT_TRUE(hasProblem(with("newton_bicgstab", "tled"), "solver.method",
                         "tled: contact.model prescribed takes newton_bicgstab"));
  EXPECT_TRUE(hasProblem(with("    surface", "    model: tensor_mass\n    surface"),
                         "organs[0].model", "tensor_mass: contact.model prescribed takes fem"));
  EXPECT_TRUE(hasProblem(with("    surface", "    element: tet10\n    surface"),
                         "organs[0].element", "takes tet4, anp"));
  EXPECT_TRUE(hasProblem(with("    surface", "    adapt: {finest: 0.002}\n    surface"),
                         "organs[0].adapt.finest", "stays as it is: 0"));
  EXPECT_TRUE(hasProblem(
      with("instruments:\n",
           "  - {name: other, surface: b.obj, material: {young_modulus: 6.0e3, poisson_ratio: "
           "0.4, density: 1000}}\ninstruments:\n"),
      "organs[1].name", "takes one organ"));
  EXPECT_TRUE(hasProblem(
      with("instruments:\n", "instruments:\n  - {name: second, urdf: a.urdf, control_frame: a}\n"),
      "instruments[1].name", "takes one instrument"));
  EXPECT_TRUE(
      hasProblem(with("    control_frame: tip",
                      "    control_frame: tip\n    needle: {link: tip, puncture_force: 1.0}"),
                 "instruments[0].needle.link", "takes no needle"));
  EXPECT_TRUE(hasProblem(with("gravity: [0, 0, 0]", "anatomy: [{name: rib, surface: rib.obj}]"),
                         "anatomy[0].name", "takes no anatomy"));
  EXPECT_TRUE(hasProblem(with("model: prescribed", "model: prescribed, friction: {static: 0.2}"),
                         "contact.friction", "takes no friction"));
  EXPECT_TRUE(hasProblem(with("model: prescribed", "model: prescribd"), "contact.model",
                         "did you mean prescribed"));
}

TEST_F(SceneErrors, AllInOneMessage) {
  std::string text = kGood;
  text.replace(text.find("0.45"), 4, "0.5");
  text.replace(text.find("control_frame"), 13, "control_fram");
  text.replace(text.find("step: 0.01"), 10, "step: 9");
  const std::vector<Problem> problems = problemsOfText(text);
  EXPECT_EQ(problems.size(), 4u);  // the misspelt key and the missing one are two
}

TEST_F(SceneErrors, GarbageIsRefusedNotFatal) {
  problemsOfText(std::string(100000, '['));
  problemsOfText(std::string("\x00\xff\xfe\x80garbage", 11));
  problemsOfText("a: &a [*a]\norgans: *a\n");
  problemsOfText("organs: &a\n  - *a\n");
  problemsOfText("? [1, 2]\n: 3\n" + std::string(kGood));
  problemsOfText("<<: {name: x}\n" + std::string(kGood));
  problemsOfText(std::string(kGood) + std::string(1000000, 'k') + ": 1\n");
  for (std::size_t n = 1; n < sizeof(kGood) - 1; n += 3) {  // cut off anywhere: said or valid
    try {
      readScene(folder_.write("cut.yaml", std::string(kGood).substr(0, n)));
    } catch (const InputError&) {
    }
  }
}

}  // namespace
}  // namespace palpate::scene::scene_errors_test

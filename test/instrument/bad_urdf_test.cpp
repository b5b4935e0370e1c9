// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <random>

#include "palpate/base/error.h"
#include "palpate/instrument/instrument.h"
#include "support/source_folder.h"
#include "support/temp_folder.h"
#include "urdf_text.h"

namespace palpate::instrument::bad_urdf_test {
namespace {

using test::TempFolder;

/// What loading `text` says; fails the test if it loads.
std::string problemOf(const std::string& text) {
  const TempFolder temp;
  const std::string file = temp.write("bad.urdf", text);
  try {
    readInstrument(file);
  } catch (const InputError& error) {
    EXPECT_EQ(error.file(), file);
    return error.what();
  }
  ADD_FAILURE() << "loaded:\n" << text;
  return "";
}

#define EXPECT_PROBLEM(text, part)                                           \
  do {                                                                       \
    const std::string what = problemOf(text);                                \
    EXPECT_NE(what.find(part), std::string::npos) << "says only:\n" << what; \
  } while (false)

TEST(BadUrdf, FileMissingFolderOrEmpty) {
  const TempFolder temp;
  EXPECT_THROW(readInstrument(temp.path("none.urdf")), InputError);
  EXPECT_THROW(readInstrument(temp.path("")), InputError);
  EXPECT_THROW(readInstrument(""), InputError);
  EXPECT_PROBLEM("", "is empty");
  EXPECT_PROBLEM(" \n\t\n", "is empty");
}

TEST(BadUrdf, NotXmlOrAnotherXml) {
  EXPECT_PROBLEM("solid ball\n", "not XML");
  EXPECT_PROBLEM(std::string(1000, '\0'), "");
  EXPECT_PROBLEM("<scene/>", "must be <robot>");
  EXPECT_PROBLEM("<?xml version=\"1.0\"?>", "");
  EXPECT_PROBLEM("<robot><link name=\"a\"/></robot>", "needs a name");
  EXPECT_PROBLEM(robot("<xacro:include filename=\"a.xacro\"/>" + link("a")), "xacro");
}

TEST(BadUrdf, TruncatedAnywhere) {
  std::ifstream in(test::sourceFolder() + "/config/instruments/grasper.urdf");
  const std::string whole{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  ASSERT_GT(whole.size(), 1000u);
  for (std::size_t n = 0; n + 10 < whole.size(); n += 97) problemOf(whole.substr(0, n));
}

TEST(BadUrdf, RandomDamageIsRefusedOrLoadsButNeverCrashes) {
  std::ifstream in(test::sourceFolder() + "/config/instruments/probe.urdf");
  const std::string whole{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const TempFolder temp;
  std::mt19937 rng{5};
  for (int trial = 0; trial < 300; ++trial) {
    std::string text = whole;
    for (int k = 0; k < 3; ++k) {
      text[rng() % text.size()] = static_cast<char>(rng() % 256);
    }
    try {
      const Instrument instrument = readInstrument(temp.write("damaged.urdf", text));
      std::vector<Pose> poses;
      instrument.linkPoses(
          Eigen::VectorXd::Zero(static_cast<Eigen::Index>(instrument.joints().size())), &poses);
      for (const Pose& X : poses) EXPECT_TRUE(X.matrix().allFinite());
    } catch (const InputError&) {
    }
  }
}

TEST(BadUrdf, DeepNestingAndVeryManyLinks) {
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<a>";
  EXPECT_PROBLEM(robot(deep), "");
  std::string many = link("l0");
  for (int i = 1; i < 5000; ++i) {
    const std::string a = "l" + std::to_string(i - 1), b = "l" + std::to_string(i);
    many += link(b) + joint("j" + b, "fixed", a, b);
  }
  EXPECT_PROBLEM(robot(many), "at most");
}

// What is taken for each joint, or each name, would take the square of their number or length.
TEST(BadUrdf, ManyJointsShapesAndLongNames) {
  std::string joints, shapes, wrong;
  for (int i = 0; i < 20000; ++i) {
    const std::string name = "j" + std::to_string(i);
    joints += joint(name, "continuous", "a", "b", "<mimic joint=\"" + name + "x\"/>");
    shapes += collision("<sphere radius=\"1\"/>");
    wrong += collision("<sphere radius=\"-1\"/>");
  }
  EXPECT_PROBLEM(robot(link("a") + joints + link("b")), "more than 1000 joints");
  EXPECT_PROBLEM(robot(link("a", shapes)), "more than 10000 shapes");
  const std::string many = problemOf(robot(link("a", wrong)));
  EXPECT_EQ(std::count(many.begin(), many.end(), '\n'), 49);
  EXPECT_PROBLEM(robot(link(std::string(1000000, 'a'))), "a name of at most 100 bytes");
  std::string unknown = link("base");
  for (int i = 0; i < 900; ++i) {
    unknown +=
        link("l" + std::to_string(i)) +
        joint("j" + std::to_string(i), "fixed", std::string(4000, 'x') + std::to_string(i), "y");
  }
  EXPECT_PROBLEM(robot(unknown), "no link has this name");
  EXPECT_PROBLEM(std::string(std::size_t{5} << 20, ' '), "larger than 4 MiB");
}

TEST(BadUrdf, NumbersWhoseProductsAreNotFinite) {
  const auto one = [](const std::string& inside) {
    return robot(link("a") + link("b") + joint("j", "revolute", "a", "b", limit() + inside));
  };
  EXPECT_PROBLEM(one("<origin xyz=\"0 0 1e300\"/>"), "[-100, 100]");
  EXPECT_PROBLEM(one("<origin rpy=\"0 0 1e300\"/>"), "[-1e6, 1e6]");
  EXPECT_PROBLEM(one("<axis xyz=\"0 0 1e300\"/>"), "[-1e6, 1e6]");
  EXPECT_PROBLEM(robot(link("a", collision("<sphere radius=\"1e300\"/>"))), "> 0, at most 100");
  EXPECT_PROBLEM(robot(link("a", collision("<box size=\"1 1 101\"/>"))), "> 0, at most 100");
  EXPECT_PROBLEM(robot(link("a", collision("<mesh filename=\"a.obj\" scale=\"1 1 1e7\"/>"))),
                 "none of them 0");
  // Each follows the one before, a million times as far.
  std::string chain = link("l0") + link("l1") + joint("j1", "continuous", "l0", "l1");
  for (int i = 2; i < 100; ++i) {
    const std::string a = std::to_string(i - 1), b = std::to_string(i);
    chain += link("l" + b) + joint("j" + b, "continuous", "l" + a, "l" + b,
                                   "<mimic joint=\"j" + a + "\" multiplier=\"1e6\"/>");
  }
  EXPECT_PROBLEM(robot(chain), "goes too far");
}

// The second parser reads what the first one has understood: in some texts it has no end.
TEST(BadUrdf, BytesThatAreNoText) {
  const std::string good = robot(link("a", collision("<sphere radius=\"1\"/>")));
  for (const std::string& bytes :
       {std::string("\xEF"), std::string("\xEF\0\0", 3), std::string("\0<?xml \0", 8),
        std::string("<?xml \0", 7), std::string("<!DOCTYPE [")}) {
    for (const std::size_t at :
         {std::size_t{0}, good.find("<link"), good.find("name=\"a"), good.size()}) {
      const TempFolder temp;
      const std::string file = temp.write("a.urdf", std::string(good).insert(at, bytes));
      try {
        readInstrument(file);
      } catch (const InputError& error) {
        EXPECT_EQ(error.file(), file);
      }
    }
  }
}

TEST(BadUrdf, JointLoops) {
  const std::string links = link("a") + link("b") + link("c");
  // Two ways to c.
  EXPECT_PROBLEM(robot(links + joint("ab", "fixed", "a", "b") + joint("ac", "fixed", "a", "c") +
                       joint("bc", "fixed", "b", "c")),
                 "joint loop");
  // Back to the root: no root left.
  EXPECT_PROBLEM(robot(links + joint("ab", "fixed", "a", "b") + joint("bc", "fixed", "b", "c") +
                       joint("ca", "fixed", "c", "a")),
                 "joint loop");
  // A ring apart from the root.
  EXPECT_PROBLEM(robot(links + joint("bc", "fixed", "b", "c") + joint("cb", "fixed", "c", "b")),
                 "joint loop");
  EXPECT_PROBLEM(robot(links + joint("aa", "fixed", "a", "a")), "joint loop");
}

TEST(BadUrdf, NoLinkOrTwoRoots) {
  EXPECT_PROBLEM(robot(""), "has no links");
  EXPECT_PROBLEM(robot(link("a") + link("b")), "a, b: these links hang on no joint");
}

TEST(BadUrdf, UnknownLink) {
  EXPECT_PROBLEM(robot(link("base") + link("shaft") + joint("j", "fixed", "base", "shafd")),
                 "did you mean 'shaft'");
  EXPECT_PROBLEM(robot(link("base") + link("shaft") + joint("j", "fixed", "nowhere", "shaft")),
                 "'nowhere'");
  EXPECT_PROBLEM(robot(link("base") + "<joint name=\"j\" type=\"fixed\"/>"), "needs <parent");
}

TEST(BadUrdf, NamesMissingOrTwice) {
  EXPECT_PROBLEM(robot("<link/>"), "needs a name");
  EXPECT_PROBLEM(robot(link("a") + link("a")), "a link of this name");
  EXPECT_PROBLEM(robot(link("a") + link("b") + link("c") + joint("j", "fixed", "a", "b") +
                       joint("j", "fixed", "b", "c")),
                 "a joint of this name");
}

TEST(BadUrdf, JointType) {
  const std::string links = link("a") + link("b");
  EXPECT_PROBLEM(robot(links + joint("j", "floating", "a", "b")), "is not supported");
  EXPECT_PROBLEM(robot(links + joint("j", "planar", "a", "b")), "is not supported");
  EXPECT_PROBLEM(robot(links + joint("j", "revolut", "a", "b", limit())), "mean revolute");
  EXPECT_PROBLEM(robot(links + joint("j", "", "a", "b")), "must be one of");
}

TEST(BadUrdf, Mimics) {
  const std::string links = link("a") + link("b") + link("c") + link("d");
  const auto follows = [](const std::string& leader) {
    return limit() + "<mimic joint=\"" + leader + "\"/>";
  };
  const auto chain = [&](const std::string& j1, const std::string& j2, const std::string& j3) {
    return robot(links + joint("j1", "revolute", "a", "b", j1) +
                 joint("j2", "revolute", "b", "c", j2) + joint("j3", "revolute", "c", "d", j3));
  };
  EXPECT_PROBLEM(chain(limit(), limit(), follows("j4")), "'j4': no joint has this name");
  EXPECT_PROBLEM(chain(limit(), limit(), follows("")), "no joint has this name");
  EXPECT_PROBLEM(chain(limit(), limit(), follows("j3")), "j3 -> j3");
  EXPECT_PROBLEM(chain(follows("j2"), follows("j3"), follows("j1")), "must not follow itself");
  EXPECT_PROBLEM(robot(link("a") + link("b") + link("c") + joint("j1", "fixed", "a", "b") +
                       joint("j2", "revolute", "b", "c", follows("j1"))),
                 "is fixed");
  EXPECT_PROBLEM(chain(limit(), limit(), limit() + "<mimic joint=\"j1\" multiplier=\"inf\"/>"),
                 "multiplier");
}

TEST(BadUrdf, NumbersOfJoints) {
  const auto one = [](const std::string& inside) {
    return robot(link("a") + link("b") + joint("j", "revolute", "a", "b", inside));
  };
  EXPECT_PROBLEM(one(""), "needs <limit");
  EXPECT_PROBLEM(one("<limit lower=\"-1\" upper=\"1\"/>"), "effort");
  EXPECT_PROBLEM(one("<limit lower=\"nan\" upper=\"1\" effort=\"1\" velocity=\"1\"/>"), "lower");
  EXPECT_PROBLEM(one("<limit lower=\"2\" upper=\"1\" effort=\"1\" velocity=\"1\"/>"),
                 "must not be above");
  EXPECT_PROBLEM(one(limit() + "<axis xyz=\"0 0 0\"/>"), "direction");
  EXPECT_PROBLEM(one(limit() + "<axis xyz=\"0 1\"/>"), "3 finite numbers");
  EXPECT_PROBLEM(one(limit() + "<axis xyz=\"0 1e999 0\"/>"), "3 finite numbers");
  EXPECT_PROBLEM(one(limit() + "<origin xyz=\"0 0 inf\"/>"), "origin xyz");
  EXPECT_PROBLEM(one(limit() + "<origin xyz=\"0 0 0\" rpy=\"0 zero 0\"/>"), "origin rpy");
  EXPECT_PROBLEM(one(limit() + "<origin xyz=\"0,5 0 0\"/>"), "origin xyz");
}

TEST(BadUrdf, SizesOfShapes) {
  const auto body = [](const std::string& shape) { return robot(link("a", collision(shape))); };
  EXPECT_PROBLEM(body("<sphere radius=\"-0.005\"/>"), "'-0.005': must be one finite number > 0");
  EXPECT_PROBLEM(body("<sphere radius=\"0\"/>"), "radius");
  EXPECT_PROBLEM(body("<sphere radius=\"nan\"/>"), "radius");
  EXPECT_PROBLEM(body("<sphere/>"), "is missing");
  EXPECT_PROBLEM(body("<cylinder radius=\"1\" length=\"0\"/>"), "length");
  EXPECT_PROBLEM(body("<cylinder length=\"1\"/>"), "radius");
  EXPECT_PROBLEM(body("<box size=\"1 1\"/>"), "size");
  EXPECT_PROBLEM(body("<box size=\"1 -1 1\"/>"), "size");
  EXPECT_PROBLEM(body("<mesh/>"), "filename");
  EXPECT_PROBLEM(body("<mesh filename=\"a.stl\" scale=\"1 0 1\"/>"), "scale");
  EXPECT_PROBLEM(body("<cone radius=\"1\"/>"), "must be a sphere");
  EXPECT_PROBLEM(robot(link("a", "<collision/>")), "needs <geometry>");
  EXPECT_PROBLEM(robot(link("a", "<visual><geometry><box size=\"0 1 1\"/></geometry></visual>")),
                 "size");
}

TEST(BadUrdf, ErrorsOfTheParserBehindAreInTheMessage) {
  const std::string ball = collision("<sphere radius=\"1\"/>");
  EXPECT_PROBLEM(robot(link("a", "<inertial><mass value=\"heavy\"/></inertial>" + ball)),
                 "not a valid URDF");
  EXPECT_PROBLEM(robot("<material name=\"m\"><color rgba=\"1 1 1 1\"/></material>"
                       "<material name=\"m\"><color rgba=\"1 1 1 1\"/></material>" +
                       link("a")),
                 "not unique");
}

// Of an unfinished character urdfdom takes the next byte as well, which here begins "&lt;".
TEST(BadUrdf, NamesThatTheParserBehindReadsOtherwiseAreRefused) {
  const std::string links = link("a") + link("b");
  EXPECT_PROBLEM(robot(links + joint("j\xd1&lt;", "fixed", "a", "b")), "UTF-8");
  EXPECT_PROBLEM(robot(links + joint("j\xd1&lt;", "prismatic", "a", "b", limit())), "UTF-8");
}

TEST(BadUrdf, AllProblemsAtOnceWithTheirLines) {
  const std::string what =
      problemOf(robot(link("a", collision("<sphere radius=\"0\"/>")) + link("b") +
                      joint("j", "revolut", "a", "b", "<axis xyz=\"0 0\"/>" + limit()) +
                      joint("k", "revolute", "a", "c", limit() + "<mimic joint=\"l\"/>")));
  for (const char* part :
       {"link a/collision/geometry/sphere radius (line 3)", "joint j type (line 5)",
        "joint j/axis xyz (line 5)", "joint k (line 6) child = 'c'", "mimic = 'l'"}) {
    EXPECT_NE(what.find(part), std::string::npos) << part << " not in:\n" << what;
  }
}

TEST(BadUrdf, CollisionMeshMissingEmptyFlatOrInNoPackage) {
  const TempFolder temp;
  temp.write("empty.stl", "");
  temp.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n");
  const auto problem = [&](const std::string& name) {
    const std::string file =
        temp.write("a.urdf", robot(link("a", collision("<mesh filename=\"" + name + "\"/>"))));
    try {
      readInstrument(file);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("loaded");
  };
  EXPECT_NE(problem("none.stl").find("link a/collision = 'none.stl'"), std::string::npos);
  EXPECT_NE(problem("none.stl").find(temp.path("none.stl")), std::string::npos);
  EXPECT_NE(problem("empty.stl").find("empty.stl"), std::string::npos);
  EXPECT_NE(problem("flat.obj").find("no convex hull"), std::string::npos);
  EXPECT_NE(problem("package://no_such_package/a.stl").find("not found"), std::string::npos);
}

TEST(BadUrdf, IsSilent) {
  ::testing::internal::CaptureStderr();
  ::testing::internal::CaptureStdout();
  problemOf(robot("<material name=\"m\"/><material name=\"m\"/>" + link("a")));
  const TempFolder temp;
  readInstrument(temp.write("inertia.urdf",
                            robot(link("a",
                                       "<inertial><mass value=\"1\"/><inertia ixx=\"1\" ixy=\"0\" "
                                       "ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial>"))));
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace palpate::instrument::bad_urdf_test

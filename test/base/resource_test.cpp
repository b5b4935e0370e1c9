// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/resource.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>

#include "support/temp_folder.h"

namespace palpate::resource_test {
namespace {

using test::TempFolder;

std::string package(const std::string& name) {
  return "<?xml version=\"1.0\"?>\n<package>\n <!-- <name>other</name> -->\n <name>\n" + name +
         " </name></package>";
}

/// Sets a variable for one test.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    const char* old = std::getenv(name);
    had_ = old != nullptr;
    if (had_) old_ = old;
    ::setenv(name, value.c_str(), 1);
  }
  ~Variable() { had_ ? ::setenv(name_, old_.c_str(), 1) : ::unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  bool had_ = false;
  std::string old_;
};

TEST(Resource, PathsAreAbsoluteOrStartAtTheFolder) {
  EXPECT_EQ(resolveResource("/a/b.stl", "/somewhere"), "/a/b.stl");
  EXPECT_EQ(resolveResource("file:///a/b.stl", "/somewhere"), "/a/b.stl");
  EXPECT_EQ(resolveResource("meshes/b.stl", "/somewhere"), "/somewhere/meshes/b.stl");
  EXPECT_EQ(resolveResource("../b.stl", "/some/where"), "/some/b.stl");
  EXPECT_EQ(resolveResource("b.stl", ""), "b.stl");
}

TEST(Resource, FindsThePackageAboveTheFile) {
  const TempFolder temp;
  temp.write("arm/package.xml", package("arm_description"));
  temp.write("arm/urdf/deep/arm.urdf", "");
  EXPECT_EQ(resolveResource("package://arm_description/meshes/a.stl", temp.path("arm/urdf/deep")),
            temp.path("arm/meshes/a.stl"));
}

TEST(Resource, FindsPackagesOfTheRosPackagePath) {
  const TempFolder temp;
  temp.write("ws/src/repo/arm/package.xml", package("arm_description"));
  temp.write("ws/src/repo/arm/inner/package.xml", package("hidden_in_a_package"));
  temp.write("ws/src/a/b/c/d/package.xml", package("too_deep"));
  temp.write("itself/package.xml", package("itself"));
  const Variable variable("ROS_PACKAGE_PATH",
                          "/nowhere:" + temp.path("ws/src:") + temp.path("itself"));
  EXPECT_EQ(resolveResource("package://arm_description/a.stl", "/"),
            temp.path("ws/src/repo/arm/a.stl"));
  EXPECT_EQ(resolveResource("package://itself/a.stl", "/"), temp.path("itself/a.stl"));
  EXPECT_THROW(resolveResource("package://hidden_in_a_package/a.stl", "/"), std::invalid_argument);
  EXPECT_THROW(resolveResource("package://too_deep/a.stl", "/"), std::invalid_argument);
}

TEST(Resource, FindsInstalledPackages) {
  const TempFolder temp;
  temp.write("prefix/share/arm_description/a.stl", "");
  const Variable variable("CMAKE_PREFIX_PATH", temp.path("prefix"));
  EXPECT_EQ(resolveResource("package://arm_description/a.stl", "/"),
            temp.path("prefix/share/arm_description/a.stl"));
}

TEST(Resource, SaysWhereItLooked) {
  const TempFolder temp;
  const Variable path("ROS_PACKAGE_PATH", temp.path(""));
  try {
    resolveResource("package://no_such_package/a.stl", "/tmp");
    FAIL();
  } catch (const std::invalid_argument& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find("no_such_package"), std::string::npos) << what;
    EXPECT_NE(what.find(temp.path("")), std::string::npos) << what;
    EXPECT_NE(what.find("/usr/share"), std::string::npos) << what;
  }
}

TEST(Resource, StaysWithinAPackage) {
  const TempFolder temp;
  temp.write("arm/package.xml", package("arm"));
  for (const char* rest :
       {"../a.stl", "..", "meshes/../../a.stl", "/etc/passwd", "a/../..", "./.."}) {
    EXPECT_THROW(resolveResource("package://arm/" + std::string(rest), temp.path("arm")),
                 std::invalid_argument)
        << rest;
  }
  EXPECT_EQ(resolveResource("package://arm/a/../..b/./c.stl", temp.path("arm")),
            temp.path("arm/..b/c.stl"));
}

// As long as may be, and of as many comments: in no time.
TEST(Resource, LooksIntoAnyPackageFile) {
  const TempFolder temp;
  std::string comments;
  for (int i = 0; i < 100000; ++i) comments += "<!---->";
  temp.write("arm/package.xml", comments + package("arm"));
  EXPECT_EQ(resolveResource("package://arm/a.stl", temp.path("arm")), temp.path("arm/a.stl"));
  temp.write("arm/package.xml", package("arm") + "<!-- without an end");
  EXPECT_EQ(resolveResource("package://arm/a.stl", temp.path("arm")), temp.path("arm/a.stl"));
  temp.write("arm/package.xml", package("arm") + std::string(std::size_t{2} << 20, ' '));
  EXPECT_THROW(resolveResource("package://arm/a.stl", temp.path("arm")), std::invalid_argument);
}

TEST(Resource, RefusesAZeroByte) {
  EXPECT_THROW(resolveResource(std::string("a.obj\0.off", 10), "/tmp"), std::invalid_argument);
}

TEST(Resource, RefusesWhatItCannotRead) {
  for (const char* uri : {"", "package://", "package:///a.stl", "package://arm", "package://../a",
                          "https://example.org/a.stl", "model://arm/a.stl"}) {
    EXPECT_THROW(resolveResource(uri, "/tmp"), std::invalid_argument) << uri;
  }
}

}  // namespace
}  // namespace palpate::resource_test

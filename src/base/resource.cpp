// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/resource.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/base/text_file.h"

namespace palpate {
namespace {

namespace fs = std::filesystem;
constexpr int kCrawlDepth = 3;
constexpr std::size_t kMaxPackageFile = std::size_t{1} << 20;  // [bytes]

std::vector<std::string> pathList(const char* variable) {
  std::vector<std::string> entries;
  const char* text = std::getenv(variable);
  std::istringstream in(text == nullptr ? "" : text);
  for (std::string entry; std::getline(in, entry, ':');) {
    if (!entry.empty()) entries.push_back(entry);
  }
  return entries;
}

bool isFolder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

bool isPackage(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_regular_file(folder / "package.xml", ignored);
}

/// `text` without its comments.
std::string withoutComments(const std::string& text) {
  std::string left;
  std::size_t at = 0;
  for (std::size_t begin; (begin = text.find("<!--", at)) != std::string::npos;) {
    left.append(text, at, begin - at);
    const std::size_t end = text.find("-->", begin);
    if (end == std::string::npos) return left;
    at = end + 3;
  }
  return left.append(text, at, std::string::npos);
}

/// <name> in folder/package.xml, or "".
std::string packageName(const fs::path& folder) {
  if (!isPackage(folder)) return "";
  std::string text;
  try {
    text = withoutComments(readTextFile((folder / "package.xml").string(), kMaxPackageFile));
  } catch (const InputError&) {
    return "";
  }
  const std::size_t open = text.find("<name>"), close = text.find("</name>");
  if (open == std::string::npos || close == std::string::npos || close < open) return "";
  const std::string name = text.substr(open + 6, close - open - 6);
  const std::size_t first = name.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return "";
  return name.substr(first, name.find_last_not_of(" \t\r\n") + 1 - first);
}

/// Depth-first search in the order of names; packages do not nest.
fs::path crawl(const fs::path& folder, const std::string& package, int depth) {
  if (isPackage(folder)) return packageName(folder) == package ? folder : fs::path();
  if (depth == 0) return {};
  std::vector<fs::path> children;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (isFolder(it->path())) children.push_back(it->path());
  }
  std::sort(children.begin(), children.end());
  for (const fs::path& child : children) {
    const fs::path found = crawl(child, package, depth - 1);
    if (!found.empty()) return found;
  }
  return {};
}

fs::path findPackage(const std::string& package, const std::string& folder) {
  std::error_code ignored;
  fs::path up = fs::absolute(folder.empty() ? "." : folder, ignored).lexically_normal();
  for (;; up = up.parent_path()) {
    if (packageName(up) == package) return up;
    if (up == up.parent_path()) break;
  }
  std::string looked = "upwards from '" + folder + "'";
  for (const std::string& entry : pathList("ROS_PACKAGE_PATH")) {
    const fs::path found = crawl(entry, package, kCrawlDepth);
    if (!found.empty()) return found;
    looked += ", in '" + entry + "' (ROS_PACKAGE_PATH)";
  }
  std::vector<std::string> prefixes = pathList("CMAKE_PREFIX_PATH");
  prefixes.push_back("/usr");
  for (const std::string& prefix : prefixes) {
    const fs::path shared = fs::path(prefix) / "share" / package;
    if (isFolder(shared)) return shared;
    looked += ", in '" + (fs::path(prefix) / "share").string() + "'";
  }
  throw std::invalid_argument("package '" + package + "' is not found; looked " + looked);
}

bool startsWith(const std::string& text, const std::string& begin) {
  return text.compare(0, begin.size(), begin) == 0;
}

}  // namespace

std::string resolveResource(const std::string& uri, const std::string& relative_to_folder) {
  static constexpr char kPackage[] = "package://", kFile[] = "file://";
  if (uri.empty()) throw std::invalid_argument("the name of the file is empty");
  if (uri.find('\0') != std::string::npos) {
    throw std::invalid_argument("the name of the file must not have a zero byte");
  }
  if (startsWith(uri, kPackage)) {
    const std::string rest = uri.substr(sizeof(kPackage) - 1);
    const std::size_t slash = rest.find('/');
    const std::string package = rest.substr(0, slash);
    if (package.empty() || package == "." || package == ".." || slash == std::string::npos) {
      throw std::invalid_argument("'" + uri + "' must be package://NAME/path");
    }
    const fs::path inside = fs::path(rest.substr(slash + 1)).lexically_normal();
    if (inside.is_absolute() || (!inside.empty() && *inside.begin() == "..")) {
      throw std::invalid_argument("'" + uri + "' must stay within its package");
    }
    return (findPackage(package, relative_to_folder) / inside).string();
  }
  std::string path = uri;
  if (startsWith(uri, kFile)) {
    path = uri.substr(sizeof(kFile) - 1);
  } else if (uri.find("://") != std::string::npos) {
    throw std::invalid_argument("'" + uri + "' must be a path, file:// or package://");
  }
  return (fs::path(relative_to_folder) / path).lexically_normal().string();
}

}  // namespace palpate

// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene_files.h"

#include <tinyxml2.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <system_error>

#include "palpate/base/resource.h"
#include "sha256.h"

namespace palpate::node {
namespace {

namespace fs = std::filesystem;

constexpr char kUrdf[] = ".urdf", kDatabase[] = ".database";

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// "" for what is no name of a resource.
std::string resolvedOrNone(const std::string& uri, const fs::path& folder) {
  try {
    return resolveResource(uri, folder.string());
  } catch (const std::invalid_argument&) {
    return "";
  }
}

palpate::RecordedFile recorded(const std::string& key, const std::string& path) {
  palpate::RecordedFile file;
  file.key = key;
  file.path = path;
  file.sha256 = sha256OfFile(path);
  return file;
}

// Each file below a folder, in the order of their names.
std::vector<std::string> filesBelow(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    if (it->is_regular_file(error)) names.push_back(it->path().lexically_relative(folder).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

// What the meshes of a robot description are called, each once.
class MeshNames final : public tinyxml2::XMLVisitor {
 public:
  bool VisitEnter(const tinyxml2::XMLElement& element, const tinyxml2::XMLAttribute*) override {
    const char* name = element.Attribute("filename");
    if (std::string(element.Name()) == "mesh" && name) names.insert(name);
    return true;
  }
  std::set<std::string> names;
};

std::set<std::string> meshesOf(const std::string& urdf) {
  tinyxml2::XMLDocument document;
  MeshNames meshes;
  if (document.LoadFile(urdf.c_str()) == tinyxml2::XML_SUCCESS) document.Accept(&meshes);
  return meshes.names;
}

}  // namespace

std::vector<palpate::RecordedFile> sceneFiles(const scene::Scene& scene) {
  const fs::path folder = fs::path(scene.file).parent_path();
  std::vector<palpate::RecordedFile> files = {recorded("scene", scene.file)};
  for (const keys::KeyValue& value : scene::sceneValues(scene)) {
    if (!value.is_text || value.value.empty()) continue;
    const std::string path = resolvedOrNone(value.value, folder);
    std::error_code ignored;
    if (fs::is_directory(path, ignored) && endsWith(value.key, kDatabase)) {
      for (const std::string& name : filesBelow(path)) {
        files.push_back(recorded(value.key + "/" + name, (fs::path(path) / name).string()));
      }
    }
    if (!fs::is_regular_file(path, ignored)) continue;
    files.push_back(recorded(value.key, path));
    if (!endsWith(value.key, kUrdf)) continue;
    for (const std::string& name : meshesOf(path)) {
      files.push_back(
          recorded(value.key + " " + name, resolvedOrNone(name, fs::path(path).parent_path())));
    }
  }
  return files;
}

}  // namespace palpate::node

// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/scene/scene.h"

#include "palpate/keys/markdown_writer.h"
#include "palpate/keys/yaml_reader.h"
#include "palpate/scene/scene_fields.h"

namespace palpate::scene {

Scene readScene(const std::string& file) {
  Scene scene;
  scene.file = file;
  keys::readYaml(file, [&](keys::FieldVisitor& v) { describe(v, scene); });
  return scene;
}

void driveByHands(Scene* scene) {
  for (InstrumentConfig& instrument : scene->instruments) instrument.proxy.active = true;
}

std::vector<keys::KeyValue> sceneValues(const Scene& scene) {
  Scene copy = scene;
  return keys::fieldValues([&](keys::FieldVisitor& v) { describe(v, copy); });
}

std::string sceneFormatMarkdown() {
  Scene defaults;
  return "# Scene files\n\n"
         "A scene is a YAML file that says which organs and instruments there are and how they "
         "are\n"
         "simulated; examples are in `config/scenes`. Units are SI. This page is generated from "
         "the\n"
         "list of keys that reads and checks the files:\n\n"
         "    palpate docs scene_format > docs/scene_format.md\n\n"
         "Every key is optional unless it says **required**. A key that is not listed here, a "
         "value\n"
         "of another type or outside its range, or a broken rule is refused with all other "
         "problems\n"
         "of the file.\n" +
         keys::fieldsMarkdown([&](keys::FieldVisitor& v) { describe(v, defaults); });
}

}  // namespace palpate::scene

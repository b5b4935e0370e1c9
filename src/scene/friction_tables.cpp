// SPDX-License-Identifier: GPL-3.0-or-later
#include "friction_tables.h"

#include <algorithm>
#include <utility>

#include "palpate/base/error.h"

namespace palpate::scene {
namespace {

struct Shape {
  std::string instrument, link, anatomy;
};

std::vector<Shape> shapesOf(const Scene& scene, const SceneParts& parts) {
  std::vector<Shape> shapes;
  for (std::size_t i = 0; i < parts.instruments.size(); ++i) {
    const instrument::Instrument& tool = parts.instruments[i];
    for (const instrument::CollisionBody& body : tool.bodies()) {
      const std::string& link = tool.linkNames()[static_cast<std::size_t>(body.link)];
      shapes.push_back({scene.instruments[i].name, link, ""});
    }
  }
  for (const AnatomyConfig& part : scene.anatomy) shapes.push_back({"", "", part.name});
  return shapes;
}

void checkLinks(const Scene& scene, const std::vector<Shape>& shapes) {
  const std::vector<FrictionPairConfig>& pairs = scene.contact.friction.pairs;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (pairs[k].link.empty()) continue;
    std::vector<std::string> links;
    for (const Shape& shape : shapes) {
      const bool known = std::count(links.begin(), links.end(), shape.link) > 0;
      if (shape.instrument == pairs[k].instrument && !known) links.push_back(shape.link);
    }
    if (std::count(links.begin(), links.end(), pairs[k].link) > 0) continue;
    throw InputError(scene.file, "contact.friction.pairs[" + std::to_string(k) + "].link",
                     pairs[k].link,
                     "must be a link of " + pairs[k].instrument +
                         " with a collision shape; these are " + joinNames(links));
  }
}

// Number of names in the pair if all match; -1 otherwise.
int fit(const FrictionPairConfig& pair, const std::string& organ, const Shape& shape) {
  const std::pair<const std::string&, const std::string&> all[] = {
      {pair.organ, organ},
      {pair.instrument, shape.instrument},
      {pair.link, shape.link},
      {pair.anatomy, shape.anatomy}};
  int names = 0;
  for (const auto& [named, is] : all) {
    if (named.empty()) continue;
    if (named != is) return -1;
    ++names;
  }
  return names;
}

contact::Friction frictionOf(const FrictionConfig& config, const std::string& organ,
                             const Shape& shape) {
  contact::Friction friction = config;
  int most = 0;
  for (const FrictionPairConfig& pair : config.pairs) {
    const int names = fit(pair, organ, shape);
    if (names < most) continue;
    most = names;
    friction = pair;
  }
  return friction;
}

}  // namespace

std::vector<contact::FrictionTable> frictionTables(const Scene& scene, const SceneParts& parts) {
  const std::vector<Shape> shapes = shapesOf(scene, parts);
  checkLinks(scene, shapes);
  std::vector<contact::FrictionTable> tables;
  for (const OrganConfig& organ : scene.organs) {
    contact::FrictionTable table;
    for (const Shape& shape : shapes) {
      table.by_number.push_back(frictionOf(scene.contact.friction, organ.name, shape));
    }
    tables.push_back(table);
  }
  return tables;
}

}  // namespace palpate::scene

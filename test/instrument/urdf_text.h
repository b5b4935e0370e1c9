// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace palpate::instrument {

inline std::string robot(const std::string& body) {
  return "<?xml version=\"1.0\"?>\n<robot name=\"r\">\n" + body + "</robot>\n";
}
inline std::string link(const std::string& name, const std::string& inside = "") {
  return "<link name=\"" + name + "\">" + inside + "</link>\n";
}
/// `inside` must have the limit, if the type needs one.
inline std::string joint(const std::string& name, const std::string& type,
                         const std::string& parent, const std::string& child,
                         const std::string& inside = "") {
  return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/>" + inside + "</joint>\n";
}
inline std::string limit() {
  return "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/>";
}
inline std::string collision(const std::string& shape, const std::string& name = "") {
  return "<collision" + (name.empty() ? "" : " name=\"" + name + "\"") + "><geometry>" + shape +
         "</geometry></collision>";
}

}  // namespace palpate::instrument

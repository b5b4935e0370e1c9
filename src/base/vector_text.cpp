// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/base/vector_text.h"

#include <locale>
#include <sstream>

namespace palpate {

std::string vectorText(const Vec3& v) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << '[' << v.x() << ", " << v.y() << ", " << v.z() << ']';
  return text.str();
}

}  // namespace palpate

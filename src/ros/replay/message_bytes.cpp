// SPDX-License-Identifier: GPL-3.0-or-later
#include "message_bytes.h"

#include <cstdint>

#include "bag_records.h"

namespace palpate::node {
namespace {

/// Goes through the bytes of a message [ROS message serialization: little-endian, strings and lists
/// behind their lengths].
class Walk {
 public:
  explicit Walk(std::string_view bytes) : left_(bytes) {}

  bool skip(std::uint64_t size) {
    if (size > left_.size()) return false;
    left_.remove_prefix(size);
    return true;
  }
  bool count(std::uint32_t* number) {
    if (left_.size() < 4) return false;
    *number = bagNumber(left_, 0);
    return skip(4);
  }
  /// Things of `size` bytes each.
  bool list(std::uint64_t size) {
    std::uint32_t number = 0;
    return count(&number) && skip(size * number);
  }
  bool text() { return list(1); }
  /// Things of so many texts each.
  bool lists(int texts) {
    std::uint32_t number = 0;
    if (!count(&number)) return false;
    for (; number > 0; --number) {
      for (int k = 0; k < texts; ++k) {
        if (!text()) return false;
      }
    }
    return true;
  }
  /// Number, stamp, frame.
  bool header() { return skip(12) && text(); }

 private:
  std::string_view left_;
};

}  // namespace

bool areMessage(std::string_view bytes, const sensor_msgs::JointState*) {
  Walk walk(bytes);
  // Names, positions, velocities, efforts.
  return walk.header() && walk.lists(1) && walk.list(8) && walk.list(8) && walk.list(8);
}

bool areMessage(std::string_view bytes, const tf2_msgs::TFMessage*) {
  Walk walk(bytes);
  std::uint32_t transforms = 0;
  if (!walk.count(&transforms)) return false;
  for (; transforms > 0; --transforms) {
    if (!walk.header() || !walk.text() || !walk.skip(7 * 8)) return false;
  }
  return true;
}

bool areMessage(std::string_view bytes, const palpate::RunRecord*) {
  Walk walk(bytes);
  if (!walk.header()) return false;
  for (int k = 0; k < 4; ++k) {  // version, commit, scene, its text
    if (!walk.text()) return false;
  }
  return walk.lists(2) && walk.lists(2) && walk.lists(3);  // keys, replaced, files
}

}  // namespace palpate::node

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
  /// Number, stamp, frame.
  bool header() { return skip(12) && text(); }

 private:
  std::string_view left_;
};

}  // namespace

bool areMessage(std::string_view bytes, const sensor_msgs::JointState*) {
  Walk walk(bytes);
  std::uint32_t names = 0;
  if (!walk.header() || !walk.count(&names)) return false;
  for (; names > 0; --names) {
    if (!walk.text()) return false;
  }
  return walk.list(8) && walk.list(8) && walk.list(8);  // positions, velocities, efforts
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

}  // namespace palpate::node

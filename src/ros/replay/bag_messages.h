// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <rosbag/bag.h>
#include <rosbag/message_instance.h>

#include <cstdint>
#include <string>

#include "message_bytes.h"
#include "palpate/base/error.h"
#include "palpate/scene/scene.h"

namespace palpate::node {

bool isTf(const std::string& topic);
bool isStaticTf(const std::string& topic);

/// What rosbag says, on one line.
std::string bagProblem(const rosbag::BagException& error);

/// Opens a bag for reading that moves a scene's instruments.
/// @throws InputError: no such bag, one that checkBag() refuses, or an instrument of the scene has
/// no messages in it (the topics there are get listed).
void openInputBag(const std::string& file, const scene::Scene& scene, rosbag::Bag* bag);

/// The message, which is looked through before it is decoded.
/// @throws InputError: it is of another type, or cut off.
template <class Message>
boost::shared_ptr<Message> decodedMessage(const rosbag::MessageInstance& m,
                                          const std::string& file) {
  if (m.getMD5Sum() != ros::message_traits::MD5Sum<Message>::value()) {
    throw InputError(file, m.getTopic(), m.getDataType(),
                     std::string("must be ") + ros::message_traits::DataType<Message>::value());
  }
  std::string bytes(m.size(), '\0');
  ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(&bytes[0]), m.size());
  m.write(stream);
  if (!areMessage(bytes, static_cast<const Message*>(nullptr))) {
    throw InputError(file, m.getTopic(), "", "has a message that is cut off");
  }
  return m.instantiate<Message>();
}

}  // namespace palpate::node

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace palpate::node {

/// Goes through a bag before rosbag opens it, which believes what a bag says of itself: looks up
/// places without looking whether they are there, and takes as much memory as it is told. Behind
/// this check every record lies in the file or its chunk, every entry of an index is the place of a
/// message of its connection, chunks have a bound, and nothing is counted twice.
/// @throws InputError naming the byte: no bag of format 2.0, encrypted, not indexed, cut off or
/// damaged, a chunk of more than 64 MiB, or chunks that stand for more than 256 bytes for each of
/// the file and 64 MiB beside.
void checkBag(const std::string& file);

}  // namespace palpate::node

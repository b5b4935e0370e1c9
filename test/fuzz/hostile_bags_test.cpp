// SPDX-License-Identifier: GPL-3.0-or-later
// Bags that say of themselves what is not so: rosbag believes them. Each is a bag that is well,
// changed in one place; kept_files.cpp has the tests of files that are kept.
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "palpate/base/error.h"
#include "ros/replay/bag_records.h"
#include "support/contains.h"
#include "support/input_error.h"
#include "targets.h"

namespace palpate::fuzz {
namespace {

using node::BagRecord;

constexpr std::size_t kFirst = 13;  // behind the line with the version

class HostileBags : public ::testing::Test {
 protected:
  HostileBags() : good_(targetNamed("bag").seeds()[0]) { targetNamed("bag").read(good_); }

  static std::string complaintOf(const std::string& bytes) {
    EXPECT_NO_THROW(tryBytes(targetNamed("bag"), bytes));
    return test::complaint([&] { targetNamed("bag").read(bytes); });
  }
  /// The first record of the kind that is not within a chunk.
  BagRecord record(BagRecord::Op op) const {
    for (std::uint64_t at = kFirst; at < good_.size();) {
      const BagRecord one = node::bagRecord(good_, at);
      if (one.is(op)) return one;
      at = one.end();
    }
    ADD_FAILURE() << "no record of kind " << op;
    return {};
  }
  template <class T>
  std::string with(std::uint64_t at, T value) const {
    std::string bytes = good_;
    std::memcpy(&bytes[at], &value, sizeof value);
    return bytes;
  }
  /// With another value of the field in the record's header.
  template <class T>
  std::string withField(BagRecord::Op op, const std::string& field, T value) const {
    return with(good_.find(field + "=", record(op).place) + field.size() + 1, value);
  }
  /// Where these bytes are in the one chunk, which is not compressed.
  std::uint64_t find(const std::string& bytes) const {
    const std::size_t at = good_.find(bytes, record(BagRecord::kChunk).data);
    EXPECT_NE(at, std::string::npos);
    return at;
  }

  std::string good_;
};

TEST_F(HostileBags, IndicesOfWhatIsNoMessageAreRefused) {
  const BagRecord index = record(BagRecord::kIndex);
  for (const std::uint32_t offset : {0xF0000000U, 0xFFFFFFFFU, 1U}) {
    EXPECT_TRUE(test::contains(complaintOf(with(index.data + 8, offset)), "not in the chunk"));
  }
  EXPECT_TRUE(
      test::contains(complaintOf(withField(BagRecord::kIndex, "conn", 77U)), "not in the chunk"));
  EXPECT_TRUE(
      test::contains(complaintOf(withField(BagRecord::kIndex, "count", 0xFFFFFFFFU)), "size"));
  EXPECT_TRUE(test::contains(complaintOf(withField(BagRecord::kIndex, "ver", 9U)), "version 1"));
}

TEST_F(HostileBags, SizesAndPlacesThatCannotBeAreRefused) {
  EXPECT_TRUE(
      test::contains(complaintOf(withField(BagRecord::kChunk, "size", 0xFFFFFFFFU)), "too large"));
  EXPECT_TRUE(
      test::contains(complaintOf(withField(BagRecord::kChunk, "size", 7U)), "another size"));
  EXPECT_TRUE(
      test::contains(complaintOf(withField(BagRecord::kFile, "chunk_count", 0xFFFFFFFFU)), "byte"));
  EXPECT_TRUE(
      test::contains(complaintOf(withField(BagRecord::kFile, "conn_count", 0xFFFFFFFFU)), "byte"));
  EXPECT_TRUE(test::contains(
      complaintOf(withField(BagRecord::kFile, "index_pos", ~std::uint64_t{0})), "byte"));
  EXPECT_TRUE(
      test::contains(complaintOf(withField(BagRecord::kFile, "index_pos", std::uint64_t{0})),
                     "run rosbag reindex"));
  EXPECT_TRUE(
      test::contains(complaintOf(withField(BagRecord::kChunkInfo, "chunk_pos", std::uint64_t{13})),
                     "of no chunk"));
  EXPECT_TRUE(
      test::contains(complaintOf(withField(BagRecord::kChunkInfo, "count", 1000U)), "size"));
  for (const BagRecord::Op op : {BagRecord::kFile, BagRecord::kChunk, BagRecord::kIndex,
                                 BagRecord::kConnection, BagRecord::kChunkInfo}) {
    EXPECT_TRUE(test::contains(complaintOf(with(record(op).place, 0xFFFFFFF0U)), "longer than"))
        << op;
    EXPECT_TRUE(test::contains(complaintOf(with(record(op).data - 4, 0xFFFFFFF0U)), "longer than"))
        << op;
    EXPECT_TRUE(test::contains(complaintOf(with(record(op).place + 4, 0xFFFFFFF0U)), "longer than"))
        << op;
  }
}

// A list of names of half a billion would be made before it is looked whether they are there.
TEST_F(HostileBags, MessagesThatSayTheyAreLongerAreRefused) {
  const std::uint64_t name = find(std::string("\1\0\0\0\1\0\0\0z", 9));
  for (const std::uint32_t count : {0xFFFFFFFFU, 0x1FFFFFFFU, 2U}) {
    EXPECT_TRUE(test::contains(complaintOf(with(name, count)), "cut off"));
    EXPECT_TRUE(test::contains(complaintOf(with(name + 4, count)), "cut off"));
    EXPECT_TRUE(test::contains(complaintOf(with(name + 9, count)), "cut off"));
  }
  const std::uint64_t frame = find(std::string("\5\0\0\0world", 9));
  EXPECT_TRUE(test::contains(complaintOf(with(frame, 0xFFFFFFFFU)), "cut off"));
  EXPECT_TRUE(test::contains(complaintOf(with(frame - 16, 0xFFFFFFFFU)), "cut off"));
}

// Their differences are beyond what a duration of ROS holds.
TEST_F(HostileBags, StampsMayBeAnyTimes) {
  const std::uint64_t joints = find(std::string("\1\0\0\0\1\0\0\0z", 9)) - 12;  // second, ns, frame
  const std::uint64_t transform = find(std::string("\5\0\0\0world", 9)) - 8;
  for (const std::uint64_t at : {joints, transform}) {
    for (const std::uint32_t second : {0U, 1U, 0x7FFFFFFFU, 0x80000000U, 0xFFFFFFFFU}) {
      for (const std::uint32_t nanosecond : {0U, 0xFFFFFFFFU}) {
        std::string bytes = with(at, second);
        std::memcpy(&bytes[at + 4], &nanosecond, 4);
        EXPECT_NO_THROW(tryBytes(targetNamed("bag"), bytes)) << second << " " << nanosecond;
      }
    }
  }
}

TEST_F(HostileBags, NumbersThatAreNotFiniteMoveNothing) {
  const std::uint64_t position = find(std::string("\1\0\0\0\1\0\0\0z\1\0\0\0", 13)) + 13;
  const std::uint64_t translation = find("t_tip") + 5;
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
    for (const std::uint64_t at : {position, translation, translation + 24}) {
      EXPECT_NO_THROW(tryBytes(targetNamed("bag"), with(at, value))) << value;
    }
  }
}

TEST_F(HostileBags, OtherVersionsAndEncryptedOnesAreRefused) {
  EXPECT_TRUE(test::contains(complaintOf("#ROSBAG V1.2\n"), "format 2.0"));
  EXPECT_TRUE(test::contains(complaintOf("#ROSBAG V2.0\n"), "longer than"));
  EXPECT_TRUE(test::contains(complaintOf(std::string(kFirst, 'x')), "format 2.0"));
  const std::string field = "encryptor=rosbag/AesCbcEncryptor";
  std::string header = std::string(4, '\0') + field;
  header[0] = static_cast<char>(field.size());
  std::string bytes = good_;
  const BagRecord file = record(BagRecord::kFile);
  const auto length = static_cast<std::uint32_t>(file.data - file.place - 8 + header.size());
  bytes.insert(file.data - 4, header);
  std::memcpy(&bytes[file.place], &length, 4);
  EXPECT_TRUE(test::contains(complaintOf(bytes), "encrypted"));
}

// Every byte once, of all of three compressions.
TEST_F(HostileBags, BytesMayBeAnyBytes) {
  for (const std::string& seed : targetNamed("bag").seeds()) {
    for (std::size_t at = kFirst; at < seed.size(); at += 29) {
      std::string bytes = seed;
      bytes[at] = static_cast<char>(bytes[at] ^ (at % 2 == 0 ? 0x80 : 0x01));
      SCOPED_TRACE(at);
      EXPECT_NO_THROW(tryBytes(targetNamed("bag"), bytes));
    }
  }
}

}  // namespace
}  // namespace palpate::fuzz

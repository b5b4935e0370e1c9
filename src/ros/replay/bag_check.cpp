// SPDX-License-Identifier: GPL-3.0-or-later
#include "bag_check.h"

#include <fcntl.h>
#include <rosbag/chunked_file.h>
#include <rosbag/exceptions.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <set>
#include <vector>

#include "bag_records.h"
#include "palpate/base/error.h"

namespace palpate::node {
namespace {

constexpr std::string_view kVersion = "#ROSBAG V2.0\n";
constexpr std::uint64_t kMostChunk = std::uint64_t{64} << 20;  // [bytes]
constexpr std::uint64_t kMostEach = 256;  // in chunks for each byte of the file

/// A file's bytes, without a copy.
class MappedFile {
 public:
  explicit MappedFile(const std::string& file) {
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    struct stat status {};
    const bool regular =
        descriptor >= 0 && ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
    size_ = regular ? static_cast<std::size_t>(status.st_size) : 0;
    if (size_ > 0) data_ = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (descriptor >= 0) ::close(descriptor);
    if (descriptor < 0) throw InputError(file, "", "", "cannot be opened for reading");
    if (!regular) throw InputError(file, "", "", "must be a regular file");
    if (data_ == MAP_FAILED) throw InputError(file, "", "", "cannot be read");
  }
  ~MappedFile() {
    if (size_ > 0) ::munmap(data_, size_);
  }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::string_view bytes() const { return {static_cast<const char*>(data_), size_}; }

 private:
  void* data_ = nullptr;
  std::size_t size_ = 0;
};

/// A message in a chunk.
struct Place {
  std::uint32_t offset, connection;
  friend bool operator<(const Place& a, const Place& b) {
    return a.offset != b.offset ? a.offset < b.offset : a.connection < b.connection;
  }
};

class Checker {
 public:
  explicit Checker(std::string_view bytes)
      : bytes_(bytes), left_(kMostEach * bytes.size() + kMostChunk) {}

  void check() {
    if (bytes_.substr(0, kVersion.size()) != kVersion) fail(0, "is no bag of format 2.0");
    const BagRecord file = bagRecord(bytes_, kVersion.size());
    if (!file.is(BagRecord::kFile)) fail(file.place, "must be the record of the file");
    const auto encryptor = file.fields.find("encryptor");
    if (encryptor != file.fields.end() && !encryptor->second.empty()) {
      fail(file.place, "is encrypted");
    }
    const std::uint64_t index = file.longNumber("index_pos");
    if (index == 0) {
      fail(file.place, "is not indexed (cut off while recording?): run rosbag reindex");
    }
    std::uint64_t at = file.end();
    while (at < index) at = checkChunk(at);
    if (at != index) fail(file.place, "the place of the index is none");
    for (std::uint32_t n = file.number("conn_count"); n > 0; --n) at = checkConnection(at);
    for (std::uint32_t n = file.number("chunk_count"); n > 0; --n) at = checkInfo(at);
    for (const std::uint32_t connection : indexed_) {
      if (connections_.count(connection) == 0) fail(index, "a message is of no connection");
    }
  }

 private:
  [[noreturn]] static void fail(std::uint64_t place, const std::string& what) {
    throw BagFault{place, what};
  }

  /// A chunk and the index records behind it. @returns where they end.
  std::uint64_t checkChunk(std::uint64_t at) {
    const BagRecord chunk = bagRecord(bytes_, at);
    if (!chunk.is(BagRecord::kChunk)) fail(at, "must be a chunk");
    const std::vector<Place> messages = messagesOf(chunk);
    std::uint32_t& indices = chunks_[at];
    at = chunk.end();
    while (at < bytes_.size()) {
      const BagRecord record = bagRecord(bytes_, at);
      if (!record.is(BagRecord::kIndex)) break;
      checkIndex(record, messages);
      ++indices;
      at = record.end();
    }
    return at;
  }

  void checkIndex(const BagRecord& record, const std::vector<Place>& messages) {
    const std::uint32_t connection = record.number("conn"), count = record.number("count");
    if (record.number("ver") != 1) fail(record.place, "must be an index of version 1");
    if (record.size != std::uint64_t{12} * count) fail(record.place, "an index of another size");
    for (std::uint32_t i = 0; i < count; ++i) {
      const Place place{bagNumber(bytes_, record.data + 12 * i + 8), connection};
      if (std::binary_search(messages.begin(), messages.end(), place)) continue;
      fail(record.place, "an index of messages that are not in the chunk");
    }
    indexed_.insert(connection);
  }

  std::vector<Place> messagesOf(const BagRecord& chunk) {
    const std::string data = decompressed(chunk);
    std::vector<Place> messages;
    for (std::uint64_t at = 0; at < data.size();) {
      BagRecord record;
      try {
        record = bagRecord(data, at);
        if (record.is(BagRecord::kMessage)) {
          record.longNumber("time");
          messages.push_back({static_cast<std::uint32_t>(at), record.number("conn")});
        }
      } catch (const BagFault& fault) {
        fail(chunk.place, "in the chunk: " + fault.what);
      }
      at = record.end();
    }
    return messages;
  }

  std::string decompressed(const BagRecord& chunk) {
    const auto found = chunk.fields.find("compression");
    const std::string kind = found == chunk.fields.end() ? "" : found->second;
    const std::uint32_t size = chunk.number("size");
    if (size > kMostChunk || chunk.size > kMostChunk || size > left_) {
      fail(chunk.place, "the chunk is too large, or all together");
    }
    left_ -= size;
    const std::string_view data = bytes_.substr(chunk.data, chunk.size);
    if (kind == "none") {
      if (size != chunk.size) fail(chunk.place, "the chunk has another size than it says");
      return std::string(data);
    }
    if (kind != "bz2" && kind != "lz4") fail(chunk.place, "must be of compression none, bz2, lz4");
    std::string plain(size, '\0');
    std::string packed(data);  // rosbag asks for bytes that it could change
    try {
      rosbag::ChunkedFile().decompress(
          kind == "bz2" ? rosbag::compression::BZ2 : rosbag::compression::LZ4,
          reinterpret_cast<std::uint8_t*>(&plain[0]), size,
          reinterpret_cast<std::uint8_t*>(&packed[0]), chunk.size);
    } catch (const rosbag::BagException&) {
      fail(chunk.place, "the chunk is damaged");
    }
    return plain;
  }

  std::uint64_t checkConnection(std::uint64_t at) {
    const BagRecord record = bagRecord(bytes_, at);
    if (!record.is(BagRecord::kConnection)) fail(at, "must be a connection");
    bagFields(bytes_.substr(record.data, record.size), at);
    connections_.insert(record.number("conn"));
    return record.end();
  }

  std::uint64_t checkInfo(std::uint64_t at) {
    const BagRecord record = bagRecord(bytes_, at);
    if (!record.is(BagRecord::kChunkInfo)) fail(at, "must be what is known of a chunk");
    const std::uint32_t count = record.number("count");
    if (record.number("ver") != 1) fail(at, "must be of version 1");
    if (record.size != std::uint64_t{8} * count) fail(at, "must have the size that it says");
    const auto chunk = chunks_.find(record.longNumber("chunk_pos"));
    if (chunk == chunks_.end()) fail(at, "is of no chunk, or of one that was known");
    if (count > chunk->second) fail(at, "has more connections than the chunk has indices");
    chunks_.erase(chunk);
    return record.end();
  }

  std::string_view bytes_;
  std::uint64_t left_;                             // of what chunks may stand for
  std::map<std::uint64_t, std::uint32_t> chunks_;  // by place, the number of their indices
  std::set<std::uint32_t> connections_, indexed_;
};

}  // namespace

void checkBag(const std::string& file) {
  const MappedFile mapped(file);
  try {
    Checker(mapped.bytes()).check();
  } catch (const BagFault& fault) {
    throw InputError(file, "byte " + std::to_string(fault.place), "", fault.what);
  }
}

}  // namespace palpate::node

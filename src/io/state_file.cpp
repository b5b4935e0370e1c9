// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/io/state_file.h"

#include <zlib.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "palpate/base/atomic_file.h"
#include "palpate/base/error.h"
#include "palpate/base/number.h"
#include "palpate/base/text_file.h"

namespace palpate::io {
namespace {

constexpr char kFormat[] = "palpate state 9";
constexpr const char* kOldFormats[] = {"# palpate state 1", "palpate state 2", "palpate state 3",
                                       "palpate state 4",   "palpate state 5", "palpate state 6",
                                       "palpate state 7"};
constexpr char kPayload[] = "payload: ";
constexpr std::size_t kMaxBytes = std::size_t{1} << 30;

// Replaces characters of a name that would break the line.
std::string inOneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

std::string header(const sim::SimulatorState& state) {
  std::string text = std::string(kFormat) + "\nscene: " + inOneLine(state.scene) +
                     "\ntime: " + formatNumber(state.time) + " s\n";
  for (const sim::ModelState& model : state.models) {
    text += "organs: " + joinNames(model.organs) + "; model: " + model.model +
            "; state: " + model.state.kind + "\n";
  }
  return text;
}

unsigned long checksum(const std::string& header, const std::string& payload) {
  unsigned long sum = crc32(0L, Z_NULL, 0);
  for (const std::string* part : {&header, &payload}) {
    sum = crc32_z(sum, reinterpret_cast<const Bytef*>(part->data()), part->size());
  }
  return sum;
}

// Header line before the payload.
std::string payloadLine(const std::string& header, const std::string& payload) {
  char sum[16];
  std::snprintf(sum, sizeof(sum), "%08lx", checksum(header, payload));
  return kPayload + std::to_string(payload.size()) + " bytes, crc32 " + sum + "\n";
}

}  // namespace

void writeState(const std::string& file, const sim::SimulatorState& state) {
  const std::string lines = header(state), payload = state.bytes();
  writeFileAtomically(file, lines + payloadLine(lines, payload) + payload);
}

sim::SimulatorState readState(const std::string& file) {
  const std::string bytes = readTextFile(file, kMaxBytes);
  const auto fail = [&](const std::string& value, const std::string& allowed) {
    throw InputError(file, "", value.substr(0, 60), allowed);
  };
  const std::string first = bytes.substr(0, bytes.find('\n'));
  for (const char* old : kOldFormats) {
    if (first == old)
      fail(first, "was written by an earlier version that knew less: save it again");
  }
  if (first != kFormat) {
    fail(first, std::string("is no state: must begin with '") + kFormat + "'");
  }
  const std::size_t line = bytes.find(std::string("\n") + kPayload) + 1;  // 0: absent
  const std::size_t end = line > 0 ? bytes.find('\n', line) : std::string::npos;
  const std::string payload = end == std::string::npos ? "" : bytes.substr(end + 1);
  if (end == std::string::npos ||
      bytes.compare(line, end + 1 - line, payloadLine(bytes.substr(0, line), payload)) != 0) {
    fail("", "is cut off or was changed: its checksum is not that of its bytes");
  }
  try {
    return sim::SimulatorState::fromBytes(payload);
  } catch (const std::invalid_argument& error) {
    throw InputError(file, "", "", error.what());
  }
}

void restoreState(const std::string& file, sim::Simulator* simulator) {
  const sim::SimulatorState state = readState(file);
  try {
    simulator->restore(state);
  } catch (const std::invalid_argument& error) {
    throw InputError(file, "", "", error.what());
  }
}

}  // namespace palpate::io

// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/io/state_file.h"

#include <zlib.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "palpate/base/atomic_file.h"
#include "palpate/base/error.h"
#include "palpate/base/number.h"

namespace palpate::io {
namespace {

constexpr char kFormat[] = "palpate state 3";
constexpr const char* kOldFormats[] = {"# palpate state 1", "palpate state 2"};
constexpr char kPayload[] = "payload: ";

// What a name may have that would look like another line.
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

// The line before the payload.
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
  std::ifstream in(file, std::ios::binary);
  const auto fail = [&](const std::string& value, const std::string& allowed) {
    throw InputError(file, "", value.substr(0, 60), allowed);
  };
  if (!in) fail("", "cannot be opened");
  std::string line, lines;
  std::getline(in, line);
  for (const char* old : kOldFormats) {
    if (line == old) fail(line, "was written by an earlier version that knew less: save it again");
  }
  if (line != kFormat) fail(line, std::string("is no state: must begin with '") + kFormat + "'");
  while (in && line.rfind(kPayload, 0) != 0) {
    lines += line + "\n";
    std::getline(in, line);
  }
  const std::string payload{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (line + "\n" != payloadLine(lines, payload)) {
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

// SPDX-License-Identifier: GPL-3.0-or-later
#include "memory_targets.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "palpate/base/state_bytes.h"
#include "palpate/enrichment/database_folder.h"
#include "palpate/enrichment/surrogate_file.h"
#include "palpate/enrichment/surrogate_training.h"
#include "palpate/io/state_file.h"
#include "palpate/mesh/tet_mesh.h"
#include "scratch_file.h"
#include "state_scenes.h"
#include "targets.h"

namespace palpate::fuzz {
namespace {

constexpr std::string_view kPayload = "payload: ";
constexpr std::string_view kSurrogateHead = "palpate surrogate 1\n";
constexpr std::string_view kBodyHead = "palpate deformed body 1\n",
                           kSampleHead = "palpate deformation 1\n";

/// FNV-1a, 64 bits, as bytes.
std::string markOf(std::string_view bytes) {
  std::uint64_t h = 14695981039346656037U;
  for (const char c : bytes) h = (h ^ static_cast<unsigned char>(c)) * 1099511628211U;
  StateWriter mark;
  mark.put(h);
  return mark.bytes();
}

/// The state with a line of its payload that fits; as it is where there is no such line.
std::string withItsChecksum(std::string_view bytes) {
  const std::size_t line = bytes.find(kPayload), end = bytes.find('\n', line);
  const std::size_t first = bytes.find('\n');
  if (line == std::string_view::npos || end == std::string_view::npos || first >= line) {
    return std::string(bytes);
  }
  const std::string head(bytes.substr(0, line)), payload(bytes.substr(end + 1));
  unsigned long sum = crc32(0L, Z_NULL, 0);
  for (const std::string& part : {head, payload}) {
    sum = crc32_z(sum, reinterpret_cast<const Bytef*>(part.data()), part.size());
  }
  char text[16];
  std::snprintf(text, sizeof text, "%08lx", sum);
  return head + std::string(kPayload) + std::to_string(payload.size()) + " bytes, crc32 " + text +
         "\n" + payload;
}

enrichment::DeformationDatabase smallDatabase() {
  enrichment::DeformationDatabase database;
  const mesh::TetMesh box = mesh::boxMesh(Vec3(0.1, 0.1, 0.04), Eigen::Vector3i(1, 1, 1));
  database.coarse = database.fine = {box.points, mesh::boundaryTriangles(box.tets)};
  database.made_by = "by hand, patch 0.01 m";
  const Points& X = database.fine.points;
  for (int k = 0; k < 12; ++k) {
    enrichment::Deformation sample;
    sample.contact = (3 * k) % static_cast<int>(X.cols());
    const Vec3 d(1e-3, 0.0, -1e-3 * (1 + k % 3));
    sample.force = 100.0 * d;
    sample.fine = d * Eigen::RowVectorXd::LinSpaced(X.cols(), 0.0, 1.0);
    database.samples.push_back(sample);
  }
  return database;
}

}  // namespace

void readStateFile(std::string_view bytes) {
  static const ScratchFile file("hostile.state");
  const sim::SimulatorState state = io::readState(file.write(withItsChecksum(bytes)));
  require(sim::SimulatorState::fromBytes(state.bytes()) == state, "a state that is another one");
}

std::vector<std::string> stateFiles() {
  const ScratchFile file("well.state");
  std::vector<std::string> files;
  for (int k = 0; k < 2; ++k) {
    io::writeState(file.path(), stateOf(k));
    files.push_back(test::fileBytes(file.path()));
  }
  return files;
}

void readSurrogateFile(std::string_view bytes) {
  static const ScratchFile file("hostile.net");
  enrichment::Surrogate surrogate = enrichment::readSurrogate(
      file.write(std::string(kSurrogateHead) + markOf(bytes) + std::string(bytes)));
  Eigen::VectorXd work, coefficients;
  Vec3 force;
  Points displacements(3, surrogate.surface.points.cols());
  const Vec3 place = surrogate.surface.points.col(0);
  for (const Vec3& displacement :
       {Vec3(0.0, 0.0, 0.0), Vec3(1e-3, 0.0, -2e-3), Vec3(1.0, 1.0, 1.0)}) {
    surrogate.predict(place, displacement, &work, &force, &coefficients);
    surrogate.shape(coefficients, &displacements);
    require(force.allFinite() && displacements.allFinite(), "an answer that is not finite");
    require(!std::isnan(surrogate.strangeness(place, displacement)), "a strangeness of NaN");
  }
}

std::vector<std::string> surrogateFiles() {
  std::vector<std::string> files;
  const ScratchFile file("well.net");
  for (const char* kind : {"kernel", "network"}) {
    enrichment::TrainingSettings settings;
    settings.kind = kind;
    settings.hidden = {4};
    settings.modes = 2;
    settings.iterations = 20;
    settings.held_out = 0.0;
    enrichment::writeSurrogate(file.path(), enrichment::trainSurrogate(smallDatabase(), settings));
    const std::string whole = test::fileBytes(file.path());
    files.push_back(whole.substr(kSurrogateHead.size() + sizeof(std::uint64_t)));
  }
  return files;
}

void readDatabaseFolder(std::string_view bytes) {
  static const test::TempFolder folder;
  StateReader in(bytes.substr(0, sizeof(std::uint64_t)));
  std::uint64_t length = 0;
  if (bytes.size() >= sizeof length) in.get(&length);
  bytes.remove_prefix(std::min(bytes.size(), sizeof length));
  const std::string body(bytes.substr(0, length % (bytes.size() + 1)));
  bytes.remove_prefix(body.size());
  folder.write("body.bin", std::string(kBodyHead) + body);
  folder.write("sample_000000.bin", std::string(kSampleHead) + markOf(body) + std::string(bytes));
  enrichment::readDatabase(folder.path(""));
}

std::vector<std::string> databaseFolders() {
  const test::TempFolder folder;
  const enrichment::DeformationDatabase database = smallDatabase();
  enrichment::DatabaseFolder(folder.path("of"), database.coarse, database.fine, database.made_by)
      .write(0, database.samples[0], true);
  const std::string body = test::fileBytes(folder.path("of/body.bin")).substr(kBodyHead.size());
  const std::string sample = test::fileBytes(folder.path("of/sample_000000.bin"))
                                 .substr(kSampleHead.size() + sizeof(std::uint64_t));
  StateWriter length;
  length.put(static_cast<std::uint64_t>(body.size()));
  return {length.bytes() + body + sample};
}

void goOnFrom(std::string_view bytes) {
  if (bytes.empty()) return;
  const auto scene = static_cast<int>(static_cast<unsigned char>(bytes[0]));
  restoreInto(scene, std::string(bytes.substr(1)));
}

std::vector<std::string> payloads() {
  std::vector<std::string> all;
  for (int k = 0; k < numStateScenes(); ++k)
    all.push_back(static_cast<char>(k) + stateOf(k).bytes());
  return all;
}

}  // namespace palpate::fuzz

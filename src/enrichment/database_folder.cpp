// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/enrichment/database_folder.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "palpate/base/atomic_file.h"
#include "palpate/base/error.h"
#include "palpate/base/state_bytes.h"
#include "palpate/base/text_file.h"

namespace palpate::enrichment {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kBody = "palpate deformed body 1\n", kSample = "palpate deformation 1\n";
constexpr std::size_t kMaxBytes = std::size_t{1} << 30;
constexpr char kBodyName[] = "body.bin";

// FNV-1a, 64 bits.
std::uint64_t markOf(std::string_view bytes) {
  std::uint64_t h = 14695981039346656037U;
  for (const char c : bytes) h = (h ^ static_cast<unsigned char>(c)) * 1099511628211U;
  return h;
}

std::string fileOf(const std::string& folder, int index) {
  char name[32];
  std::snprintf(name, sizeof name, "sample_%06d.bin", index);
  return (fs::path(folder) / name).string();
}

std::string bodyBytes(const mesh::SurfaceMesh& coarse, const mesh::SurfaceMesh& fine,
                      const std::string& made_by) {
  StateWriter out;
  out.put(coarse.points);
  out.put(coarse.triangles);
  out.put(fine.points);
  out.put(fine.triangles);
  out.put(std::string_view(made_by));
  return out.bytes();
}

// The bytes after `head` in a file.
std::string readAfter(const std::string& file, std::string_view head) {
  std::string bytes = readTextFile(file, kMaxBytes);
  if (bytes.compare(0, head.size(), head) != 0) {
    throw InputError(file, "", "", "is not of a database of deformations of this version");
  }
  return bytes.substr(head.size());
}

// Whether the surfaces have valid data.
bool sound(const mesh::SurfaceMesh& surface) {
  return surface.points.cols() > 0 && surface.points.allFinite() && surface.triangles.size() > 0 &&
         surface.triangles.minCoeff() >= 0 && surface.triangles.maxCoeff() < surface.points.cols();
}

void readBody(const std::string& file, const std::string& bytes, DeformationDatabase* database) {
  try {
    StateReader in(bytes);
    in.get(&database->coarse.points);
    in.get(&database->coarse.triangles);
    in.get(&database->fine.points);
    in.get(&database->fine.triangles);
    in.get(&database->made_by);
    in.finish();
  } catch (const std::invalid_argument&) {
    throw InputError(file, "", "", "is cut off");
  }
  if (!sound(database->coarse) || !sound(database->fine) ||
      database->numCoarse() > database->numFine()) {
    throw InputError(file, "", "", "has no surfaces, a coarse one and a fine one");
  }
}

// Reads a sample; returns whether it was solved.
bool readSample(const std::string& file, std::uint64_t mark, const DeformationDatabase& database,
                Deformation* sample) {
  const std::string bytes = readAfter(file, kSample);
  std::uint64_t of = 0;
  std::uint8_t solved = 0;
  try {
    StateReader in(bytes);
    in.get(&of);
    in.get(&solved);
    in.get(&sample->contact);
    in.get(&sample->force);
    in.get(&sample->fine);
    in.finish();
  } catch (const std::invalid_argument&) {
    throw InputError(file, "", "", "is cut off");
  }
  if (of != mark) throw InputError(file, "", "", "is of another body than the folder's");
  if (solved != 0 && (sample->fine.cols() != database.numFine() || !sample->fine.allFinite() ||
                      !sample->force.allFinite() || sample->contact < 0 ||
                      sample->contact >= database.numCoarse())) {
    throw InputError(file, "", "",
                     "has not the points of the folder's body, or numbers that are not finite");
  }
  return solved != 0;
}

}  // namespace

DatabaseFolder::DatabaseFolder(const std::string& folder, const mesh::SurfaceMesh& coarse,
                               const mesh::SurfaceMesh& fine, const std::string& made_by)
    : folder_(folder) {
  const std::string bytes = bodyBytes(coarse, fine, made_by);
  mark_ = markOf(bytes);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder, "", "", "cannot be made a folder: " + error.message());
  const std::string body = (fs::path(folder) / kBodyName).string();
  if (!fs::exists(body, error)) {
    writeFileAtomically(body, std::string(kBody) + bytes);
  } else if (readAfter(body, kBody) != bytes) {
    throw InputError(
        folder, "", "",
        "has deformations of another body or made in another way; give another folder");
  }
}

bool DatabaseFolder::has(int index) const {
  std::error_code ignored;
  return fs::exists(fileOf(folder_, index), ignored);
}

void DatabaseFolder::write(int index, const Deformation& sample, bool solved) const {
  StateWriter out;
  out.put(mark_);
  out.put(static_cast<std::uint8_t>(solved));
  out.put(sample.contact);
  out.put(sample.force);
  out.put(sample.fine);
  writeFileAtomically(fileOf(folder_, index), std::string(kSample) + out.bytes());
}

std::uint64_t databaseMark(const mesh::SurfaceMesh& coarse, const mesh::SurfaceMesh& fine,
                           const std::string& made_by) {
  return markOf(bodyBytes(coarse, fine, made_by));
}

DeformationDatabase readDatabase(const std::string& folder, int* unsolved, int count) {
  const std::string body = (fs::path(folder) / kBodyName).string();
  const std::string bytes = readAfter(body, kBody);
  DeformationDatabase database;
  readBody(body, bytes, &database);
  const std::string end = fileOf("", count);
  std::vector<std::string> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), none; !error && entry != none;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.compare(0, 7, "sample_") == 0 && entry->path().extension() == ".bin" &&
        (name.size() < end.size() || name < end)) {
      files.push_back(entry->path().string());
    }
  }
  if (error) throw InputError(folder, "", "", "cannot be read: " + error.message());
  std::sort(files.begin(), files.end());
  int others = 0;
  for (const std::string& file : files) {
    Deformation sample;
    if (readSample(file, markOf(bytes), database, &sample)) {
      database.samples.push_back(std::move(sample));
    } else {
      ++others;
    }
  }
  if (unsolved) *unsolved = others;
  return database;
}

}  // namespace palpate::enrichment

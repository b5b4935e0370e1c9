// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace palpate {

/// One error in an input file.
struct Problem {
  std::string key;      ///< Position: "organs[0].material.poisson_ratio", "line 12", "".
  std::string value;    ///< Value as the user wrote it; may be empty.
  std::string allowed;  ///< Allowed values as a sentence: "must be in (-1, 0.5)".
};

/// Bad input, thrown only while loading. Carries all problems of a file, so that users can fix them
/// at once. what() has one line per problem:
///
///     scene.yaml: organs[0].material.poisson_ratio = 0.5: must be in (-1, 0.5)
///
/// Control characters in texts are replaced, and long texts are cut, since files are untrusted.
class InputError : public std::runtime_error {
 public:
  InputError(std::string file, std::vector<Problem> problems);
  InputError(std::string file, std::string key, std::string value, std::string allowed);

  const std::string& file() const { return file_; }
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  struct Readable {
    std::string file;
    std::vector<Problem> problems;
  };
  explicit InputError(Readable what);

  std::string file_;
  std::vector<Problem> problems_;
};

/// Known name nearest to `name` by edit distance; "" if none is close or `name` exceeds 100 bytes.
std::string nearestName(const std::string& name, const std::vector<std::string>& known);

/// "a, b, c".
std::string joinNames(const std::vector<std::string>& names);

}  // namespace palpate

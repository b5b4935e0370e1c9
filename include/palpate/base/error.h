// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace palpate {

/// One thing that is wrong with an input file.
struct Problem {
  std::string key;      ///< Where in the file: "organs[0].material.poisson_ratio", "line 12", "".
  std::string value;    ///< What stands there, as the user wrote it; may be empty.
  std::string allowed;  ///< What would be right, as a sentence: "must be in (-1, 0.5)".
};

/// Bad input. Thrown while loading only, never by a cycle. Carries all problems of one file, so
/// that a user mends them in one go. what() has one line a problem:
///
///     scene.yaml: organs[0].material.poisson_ratio = 0.5: must be in (-1, 0.5)
///
/// Control characters are replaced in all texts, and what is too long for a message is cut: a file
/// says what it likes.
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

/// The known name that looks most like `name` (edit distance), or "" if none is close; nothing is
/// close to a name of more than 100 bytes.
std::string nearestName(const std::string& name, const std::vector<std::string>& known);

/// "a, b, c".
std::string joinNames(const std::vector<std::string>& names);

}  // namespace palpate

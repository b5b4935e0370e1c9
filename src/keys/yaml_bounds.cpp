// SPDX-License-Identifier: GPL-3.0-or-later
#include "yaml_bounds.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <map>
#include <sstream>
#include <vector>

#include "palpate/base/error.h"

namespace palpate::keys {
namespace {

constexpr std::size_t kDeepest = 50;
constexpr std::size_t kMostValues = 200000;

/// Counts the values of a document.
class Counter : public YAML::EventHandler {
 public:
  explicit Counter(const std::string& file) : file_(file) {}

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { add(mark, anchor, 1); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                const std::string&) override {
    add(mark, anchor, 1);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = sizes_.find(anchor);
    if (found == sizes_.end()) fail(mark, "an alias must not stand within what it stands for");
    add(mark, 0, found->second);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(mark, anchor);
  }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(mark, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapEnd() override { close(); }

 private:
  struct Open {
    YAML::Mark mark;
    YAML::anchor_t anchor;
    std::size_t size;
  };

  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& allowed) const {
    throw InputError(file_, "line " + std::to_string(mark.line + 1), "", allowed);
  }

  void add(const YAML::Mark& mark, YAML::anchor_t anchor, std::size_t size) {
    if (anchor != 0) sizes_[anchor] = size;
    if (open_.empty()) return;
    open_.back().size += size;
    if (open_.back().size <= kMostValues) return;
    fail(mark, "must not have more than " + std::to_string(kMostValues) +
                   " values; an alias counts as all that it stands for");
  }
  void open(const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (open_.size() == kDeepest) {
      fail(mark, "must not be nested deeper than " + std::to_string(kDeepest) + " levels");
    }
    open_.push_back({mark, anchor, 1});
  }
  void close() {
    const Open closed = open_.back();
    open_.pop_back();
    add(closed.mark, closed.anchor, closed.size);
  }

  const std::string& file_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, std::size_t> sizes_;  // sizes of complete anchors
};

}  // namespace

void checkYamlBounds(const std::string& file, const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  Counter first(file), second(file);
  if (!parser.HandleNextDocument(first)) throw InputError(file, "", "", "is empty");
  // Stops at the second document: for some texts, the parser finds documents without end.
  if (parser.HandleNextDocument(second)) {
    throw InputError(file, "", "", "has several YAML documents (`---`), must have one");
  }
}

}  // namespace palpate::keys

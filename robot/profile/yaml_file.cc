// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/profile/yaml_file.h"

#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/eventhandler.h>

#include <cmath>
#include <optional>
#include <set>
#include <sstream>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/numbers.h"
#include "poise/robot/text_file.h"

namespace poise {
namespace {

constexpr size_t kMostMib = 1;

// Refuses errors that yaml-cpp accepts. yaml-cpp ignores one of two equal keys,
// and an alias can make a map contain itself.
class Checker : public YAML::EventHandler {
 public:
  explicit Checker(const std::string& source) : source_(source) {}

  int documents() const { return documents_; }

  // Refuses the first key without a value. Must be called last, so that any
  // other error is reported first.
  void RefuseMissingValues() const;

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1) Refuse(mark, "has a second document, must have one");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override;
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) override {
    Refuse(mark, "has an alias (*), must repeat the value instead");
  }
  void OnScalar(const YAML::Mark& mark, const std::string& /*tag*/,
                YAML::anchor_t /*anchor*/, const std::string& value) override {
    AddNode(mark, &value);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& /*tag*/,
                       YAML::anchor_t /*anchor*/,
                       YAML::EmitterStyle::value /*style*/) override;
  void OnSequenceEnd() override { open_.pop_back(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& /*tag*/,
                  YAML::anchor_t /*anchor*/,
                  YAML::EmitterStyle::value /*style*/) override;
  void OnMapEnd() override { open_.pop_back(); }

 private:
  struct Key {
    std::string name;
    YAML::Mark mark;
  };
  struct Collection {
    bool is_map;
    bool key_is_next;
    std::set<std::string> keys;
    Key key;  // The last key.
  };

  [[noreturn]] void Refuse(const YAML::Mark& mark,
                           const std::string& what) const {
    throw Refusal(source_, mark.line + 1, what);
  }

  void AddNode(const YAML::Mark& mark, const std::string* scalar);

  const std::string& source_;
  std::optional<Key> missing_;  // The first key without a value.
  int documents_ = 0;
  std::vector<Collection> open_;
};

void Checker::RefuseMissingValues() const {
  if (!missing_) return;
  Refuse(missing_->mark,
         "key " + Quoted(missing_->name) + " has no value, must have one");
}

void Checker::OnNull(const YAML::Mark& mark, YAML::anchor_t /*anchor*/) {
  if (!missing_ && !open_.empty() && open_.back().is_map &&
      !open_.back().key_is_next) {
    // The key is stored, because the mark of a missing value can be far below
    // the key. The key is refused later: in a truncated file, another error is
    // more important.
    missing_ = open_.back().key;
  }
  AddNode(mark, nullptr);
}

void Checker::OnSequenceStart(const YAML::Mark& mark,
                              const std::string& /*tag*/,
                              YAML::anchor_t /*anchor*/,
                              YAML::EmitterStyle::value /*style*/) {
  AddNode(mark, nullptr);
  open_.push_back({false, false, {}, {}});
}

void Checker::OnMapStart(const YAML::Mark& mark, const std::string& /*tag*/,
                         YAML::anchor_t /*anchor*/,
                         YAML::EmitterStyle::value /*style*/) {
  AddNode(mark, nullptr);
  open_.push_back({true, true, {}, {}});
}

void Checker::AddNode(const YAML::Mark& mark, const std::string* scalar) {
  if (open_.empty() || !open_.back().is_map) return;
  Collection& map = open_.back();
  if (map.key_is_next) {
    if (scalar == nullptr || scalar->empty()) {
      Refuse(mark, "has a key that is not a text, must be a text");
    }
    if (!map.keys.insert(*scalar).second) {
      Refuse(mark, "key " + Quoted(*scalar) + " occurs twice, must occur once");
    }
    map.key = {*scalar, mark};
  }
  map.key_is_next = !map.key_is_next;
}

}  // namespace

YAML::Node LoadYaml(const std::filesystem::path& file) {
  return ParseYaml(ReadTextFile(file, kMostMib), file.string());
}

YAML::Node ParseYaml(const std::string& text, const std::string& source) {
  ExpectText(text, source);
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    Checker checker(source);
    while (parser.HandleNextDocument(checker)) {
    }
    if (checker.documents() == 0) {
      throw Refusal(source, 0, "is empty, must be a map");
    }
    checker.RefuseMissingValues();
    return YAML::Load(text);
  } catch (const YAML::DeepRecursion& error) {
    throw Refusal(source, error.mark.line + 1, "is nested too deeply");
  } catch (const YAML::Exception& error) {
    throw Refusal(source, error.mark.line + 1,
                  "is not valid YAML: " + error.msg);
  }
}

std::optional<double> ToNumber(const YAML::Node& node) {
  if (!node.IsScalar()) return std::nullopt;
  const auto numbers = ParseNumbers(node.Scalar());
  if (!numbers || numbers->size() != 1 || !std::isfinite(numbers->front())) {
    return std::nullopt;
  }
  return numbers->front();
}

std::string Shown(const YAML::Node& node) {
  constexpr std::size_t kShort = 6;
  if (node.IsScalar()) return Quoted(node.Scalar());
  if (node.IsSequence()) {
    std::string items;
    for (const YAML::Node& item : node) {
      if (node.size() > kShort || !item.IsScalar()) return "a list";
      items += (items.empty() ? "" : ", ") + item.Scalar();
    }
    return "the list " + Quoted("[" + items + "]");
  }
  return node.IsMap() ? "a map" : "empty";
}

void Refuse(const std::string& file, const YAML::Node& at,
            const std::string& what) {
  throw Refusal(file, at.Mark().line + 1, what);
}

}  // namespace poise

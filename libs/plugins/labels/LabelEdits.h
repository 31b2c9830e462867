#pragma once

#include <omnimapper/map/Labels.h>

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::plugins {

/// Whether a text may be a label, and if not, why: it must have something that can be seen, and at most 200 bytes once
/// it is printable.
std::optional<std::string> whyNoLabel(const std::string& text);

/// The labels and what was before, for undoing.
class LabelEdits {
 public:
  /// The labels of the map, where this run has not changed them yet.
  void begin(const map::Labels& labels);
  const map::Labels& now() const { return labels_; }

  void add(map::Label label);
  /// Whether there is a label of that text on that landmark, or if it has none, on none.
  bool has(const map::Label& label) const;
  void ask(map::LabelQuestion question);
  /// The question has an answer, or nobody gave one.
  void forgetQuestion();

  /// What an edit did, or why it did nothing.
  struct Outcome {
    bool is_done = false;
    std::string text;  ///< a few words
  };
  /// Edits by a command: "rename OLD = NEW", "delete LABEL", "choose N" (the N-th choice of the question, from 1 on)
  /// and "undo", which takes back the last change of this run; 100 changes can be taken back.
  Outcome edit(const std::string& command);

 private:
  Outcome rename(const std::string& names);
  Outcome remove(const std::string& name);
  Outcome choose(const std::string& number);
  Outcome undo();
  void keep();

  map::Labels labels_;
  std::deque<map::Labels> before_;
};

}  // namespace omnimapper::plugins

#pragma once

#include <omnimapper/map/Labels.h>

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace omnimapper::map {

/// Whether a text may be a label, and if not, why: it must have something that can be seen, and at most 200 bytes once
/// it is printable.
std::optional<std::string> whyNoLabel(const std::string& text);

/// A landmark and the name that it is to get.
struct NamedLandmark {
  base::LandmarkId id;
  std::string text;
};
/// Reads "name ID = TEXT", as in "name 0:12 = kitchen table"; none if the command is another one.
std::optional<NamedLandmark> namedLandmark(const std::string& command);

/// The labels and what was before, for undoing.
class LabelEdits {
 public:
  /// The labels of the map, where this run has not changed them yet.
  void begin(const Labels& labels);
  const Labels& now() const { return labels_; }

  void add(Label label);
  /// Whether there is a label of that text on that landmark, or if it has none, on none.
  bool has(const Label& label) const;
  void ask(LabelQuestion question);
  /// The question has an answer, or nobody gave one.
  void forgetQuestion();

  /// What an edit did, or why it did nothing.
  struct Outcome {
    bool is_done = false;
    std::string text;  ///< a few words
  };
  /// Edits by a command: "rename OLD = NEW", "delete LABEL", "choose N" (the N-th choice of the question, from 1 on)
  /// and "undo".
  Outcome edit(const std::string& command);
  /// The text of a command for "rename", OLD, NEW; "delete", LABEL; "undo"; or "name", ID, TEXT, which is for something
  /// that knows the landmarks (namedLandmark()). Empty if the words are none of these, a text may be no label, or one
  /// would be misread.
  static std::string commandOf(const std::vector<std::string>& words);
  Outcome rename(const std::string& from, const std::string& to);
  Outcome remove(const std::string& name);
  /// Takes back the last change; 100 changes can be taken back.
  Outcome undo();

 private:
  Outcome choose(const std::string& number);
  void keep();

  Labels labels_;
  std::deque<Labels> before_;
};

}  // namespace omnimapper::map

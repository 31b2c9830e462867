#pragma once

#include <chrono>
#include <ostream>
#include <string>

namespace omnimapper::base {

/// Where a long piece of work says how far it is. The default says nothing.
class Progress {
 public:
  virtual ~Progress() = default;
  /// `fraction` in [0, 1]; `what` a few words.
  virtual void report(double /*fraction*/, const std::string& /*what*/) {}
  /// How work goes that has no end of its own, in a few words.
  virtual void reportState(const std::string& /*how*/) {}
  /// A sentence on something that has just happened.
  virtual void reportEvent(const std::string& /*sentence*/) {}
};

/// One line on a terminal, redrawn at most ten times a second, and only for work longer than two seconds. Sentences
/// have lines of their own, on a pipe or in a file too.
class TerminalProgress : public Progress {
 public:
  /// `terminal` is false for a pipe or file: no line is drawn then. `quiet`: no sentences either.
  TerminalProgress(std::ostream& out, bool terminal, bool quiet = false)
      : out_(out), terminal_(terminal && !quiet), quiet_(quiet) {}
  ~TerminalProgress() override;
  void report(double fraction, const std::string& what) override;
  void reportState(const std::string& how) override;
  void reportEvent(const std::string& sentence) override;

 private:
  bool isDue();

  std::ostream& out_;
  bool terminal_, quiet_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point last_ = start_;
};

}  // namespace omnimapper::base

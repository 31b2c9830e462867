#pragma once

#include <chrono>
#include <ostream>
#include <string>

namespace omnimapper::base {

/// Receives the progress of long work. This base class ignores what it receives.
class Progress {
 public:
  virtual ~Progress() = default;
  /// Reports the progress: `fraction` in [0, 1], `what` in a few words.
  virtual void report(double /*fraction*/, const std::string& /*what*/) {}
  /// Reports the state of work without a known end, in a few words.
  virtual void reportState(const std::string& /*how*/) {}
  /// Reports an event in a sentence.
  virtual void reportEvent(const std::string& /*sentence*/) {}
};

/// Shows one line on a terminal, redrawn at most ten times a second, and only for work longer than two seconds. Events
/// get separate lines, which are also written to a pipe or file.
class TerminalProgress : public Progress {
 public:
  /// `terminal` is false if `out` is a pipe or a file: then no progress line is drawn. With `quiet`, neither the
  /// progress line nor events are written.
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

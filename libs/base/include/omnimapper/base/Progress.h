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
};

/// One line on a terminal, redrawn at most ten times a second, and only for work longer than two seconds.
class TerminalProgress : public Progress {
 public:
  /// `terminal` is false for a pipe or file: nothing is written then.
  TerminalProgress(std::ostream& out, bool terminal) : out_(out), terminal_(terminal) {}
  ~TerminalProgress() override;
  void report(double fraction, const std::string& what) override;

 private:
  std::ostream& out_;
  bool terminal_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::chrono::steady_clock::time_point last_ = start_;
};

}  // namespace omnimapper::base

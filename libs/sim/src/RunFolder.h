#pragma once

#include <string>

namespace omnimapper::sim {

/// The folder of a run while it is filled. All is made in a draft inside of it and takes the place of an older run's
/// when it is whole, the log last: a log never stands beside another run's truth.
class RunFolder {
 public:
  /// `name` is the log's. Throws Error(unwritable_output), also for a folder that holds things but no simulated log:
  /// what somebody else put there is not replaced.
  RunFolder(const std::string& folder, const std::string& name);
  /// What was not published goes.
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  /// Where everything is to be written.
  const std::string& draft() const { return draft_; }
  /// Removes what the older run left, whatever its name, and puts the draft in its place. Files that no run makes stay.
  /// Throws Error(unwritable_output).
  void publish();

 private:
  std::string folder_, name_, older_name_, draft_;
};

}  // namespace omnimapper::sim

#pragma once

#include <string>

namespace omnimapper::query {

/// While an object of this class exists, no other one exists for the same folder, in this program or another: what one
/// program changes in a map is not overwritten by another that had read the map before.
class MapLock {
 public:
  /// Waits up to 5 s for another program's change. Throws Error(unwritable_output) if it takes longer, and
  /// Error(unreadable_input) while a run writes into the folder, which would replace what was changed. `folder` is that
  /// of the map; empty is the working directory. On a file system without locks, nothing is locked.
  explicit MapLock(const std::string& folder);
  ~MapLock();
  MapLock(const MapLock&) = delete;
  MapLock& operator=(const MapLock&) = delete;

 private:
  int folder_;  // descriptor; -1 if the folder cannot be opened
};

}  // namespace omnimapper::query

#pragma once

#include <sys/types.h>

namespace omnimapper::testing {

/// What all processes of a group together do now.
struct ProcessGroup {
  double processor_seconds = 0;  ///< [s] that those which have not ended have used
  bool has_work = false;         ///< a thread runs, or waits for a core or a disk
};

ProcessGroup lookAtProcessGroup(pid_t group);

}  // namespace omnimapper::testing

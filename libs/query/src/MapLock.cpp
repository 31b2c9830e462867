#include "MapLock.h"

#include <fcntl.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/OutputFolder.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>

namespace omnimapper::query {

MapLock::MapLock(const std::string& folder)
    : folder_(::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  constexpr auto kPause = std::chrono::milliseconds(5);
  constexpr int kTries = 1000;
  if (folder_ < 0) return;  // who reads the map says why
  if (base::isBeingWritten(folder)) {
    ::close(folder_);
    throw base::Error(base::ExitCode::unreadable_input,
                      folder + ": the run that makes this map has not ended; the map can be changed when it has");
  }
  for (int tries = 0; ::flock(folder_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK; ++tries) {
    if (tries == kTries) {
      ::close(folder_);
      throw base::Error(base::ExitCode::unwritable_output,
                        folder + ": another program is changing this map; try again when it has ended");
    }
    std::this_thread::sleep_for(kPause);
  }
}

MapLock::~MapLock() {
  if (folder_ >= 0) ::close(folder_);
}

}  // namespace omnimapper::query

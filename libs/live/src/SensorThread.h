#pragma once

#include <omnimapper/live/LiveSource.h>
#include <omnimapper/live/SensorClock.h>

#include <chrono>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "Arrivals.h"

namespace omnimapper::live {

class SensorDriver;

/// Reads one sensor: opens its driver, passes its observations on, and opens it again when it fails or falls silent.
class SensorThread {
 public:
  SensorThread(SensorSection section, const LiveOptions& options, std::shared_ptr<Arrivals> arrivals);

  void start();
  /// Waits until the driver is open or has failed to open; false if neither happens within `patience`.
  bool waitUntilOpen(std::chrono::milliseconds patience) const;
  /// Whether the first opening failed.
  bool hasFailedToOpen() const;
  /// Ends the thread; false if its driver does not return within `patience`. The thread is left running then, and keeps
  /// the objects alive that it uses.
  bool stop(std::chrono::milliseconds patience);

  /// Sentences about events since the last call. Silence is detected in this call.
  std::vector<std::string> takeNews();
  SensorMetrics metrics() const;

 private:
  struct Shared;
  static void run(const std::shared_ptr<Shared>& shared);
  static void openDriver(Shared& shared, SensorDriver& driver);
  static void readDriver(Shared& shared);

  std::shared_ptr<Shared> shared_;  // shared with the thread, which may outlive this object
  std::thread thread_;
};

}  // namespace omnimapper::live

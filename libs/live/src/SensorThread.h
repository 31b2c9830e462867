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

/// Reads one sensor: opens its driver, hands on what that gives, and opens it again when it fails or falls silent.
class SensorThread {
 public:
  SensorThread(SensorSection section, const LiveOptions& options, std::shared_ptr<Arrivals> arrivals);

  void start();
  /// Waits so long for the driver to be open, or to have failed; true if either is so.
  bool waitUntilOpen(std::chrono::milliseconds patience) const;
  /// Whether the first opening failed.
  bool hasFailedToOpen() const;
  /// Ends the thread; false if its driver does not return within that time: it is left behind then, and keeps alive
  /// what it uses.
  bool stop(std::chrono::milliseconds patience);

  /// Sentences since the last call. Silence is noticed here.
  std::vector<std::string> takeNews();
  SensorMetrics metrics() const;

 private:
  struct Shared;
  static void run(const std::shared_ptr<Shared>& shared);
  static void openDriver(Shared& shared, SensorDriver& driver);
  static void readDriver(Shared& shared);

  std::shared_ptr<Shared> shared_;  // with the thread, which may outlive this object
  std::thread thread_;
};

}  // namespace omnimapper::live

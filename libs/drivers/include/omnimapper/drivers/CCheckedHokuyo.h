#pragma once

#include <mrpt/hwdrivers/CHokuyoURG.h>
#include <omnimapper/drivers/CheckedSensor.h>

#include <memory>

namespace omnimapper::drivers {

class LaserClock;

/// MRPT's driver of Hokuyo lasers, over a connection that checks the data. An INI with `driver = CHokuyoURG` gets this
/// driver; all keys are MRPT's. It differs from MRPT's in these points:
/// - Messages that are incomplete or have a wrong checksum are rejected and counted.
/// - If the laser closes the connection, neither the program nor the thread is ended; the next doProcess() throws.
/// - The aperture of a scan is the angle between its first and last beam. MRPT's is one step wider.
/// - Stamps stay right when the laser's clock wraps after 4.7 hours, and if that clock is fast or slow.
class CCheckedHokuyo : public mrpt::hwdrivers::CHokuyoURG, public CheckedSensor {
  DEFINE_GENERIC_SENSOR(CCheckedHokuyo)
 public:
  CCheckedHokuyo();
  ~CCheckedHokuyo() override;

  /// Connects and starts the laser. Throws std::runtime_error with the reason if the laser does not answer correctly.
  void initialize() override;
  /// Throws std::runtime_error if the laser has closed the connection or has stopped measuring.
  void doProcessSimple(bool& is_there, mrpt::obs::CObservation2DRangeScan& scan, bool& has_failed) override;

  std::uint64_t leftOut() const override;
  std::string leftOutByReason() const override;
  bool waitsForOthers() const override { return false; }

 private:
  class Stream;
  void stopMeasuring();
  void requirePossibleProperties() const;

  std::shared_ptr<Stream> stream_;
  std::unique_ptr<LaserClock> clock_;
  std::uint64_t damaged_before_ = 0;  // damaged messages before the last initialize()
};

}  // namespace omnimapper::drivers

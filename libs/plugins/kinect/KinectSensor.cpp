#include "KinectSensor.h"

#include <mrpt/obs/CObservationIMU.h>
#include <omnimapper/base/AtLoad.h>
#include <omnimapper/drivers/FramePairing.h>
#include <omnimapper/drivers/KinectConversion.h>
#include <omnimapper/drivers/TickClock.h>
#include <omnimapper/drivers/readDriverSection.h>

#include <chrono>
#include <cstdio>
#include <utility>

#include "FreenectDevice.h"

namespace omnimapper::drivers {

namespace {

using HostClock = std::chrono::steady_clock;

double secondsFrom(HostClock::time_point begin) {
  return std::chrono::duration<double>(HostClock::now() - begin).count();
}

}  // namespace

IMPLEMENTS_GENERIC_SENSOR(KinectSensor, omnimapper::drivers)

namespace {
const base::AtLoad kKinectIsRegistered([] { KinectSensor::doRegister(); });
}

struct KinectSensor::Open {
  explicit Open(const KinectOptions& options) : conversion(options), pairing(options.pairing), device(options) {}

  KinectConversion conversion;
  FramePairing pairing;
  TickClock clock;
  bool has_depths = false;
  HostClock::time_point last_depths = HostClock::now();  // or of the opening
  FreenectDevice device;
};

KinectSensor::KinectSensor() {
  m_sensorLabel = "KINECT";
  m_state = ssUninitialized;
}

KinectSensor::~KinectSensor() = default;

void KinectSensor::loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& ini, const std::string& section) {
  options_ = readUnderMrpt([&] { return KinectOptions::read(ini, section); });
}

void KinectSensor::initialize() {
  open_.reset();
  open_ = std::make_unique<Open>(options_);
  m_state = ssWorking;
}

void KinectSensor::doProcess() {
  if (!open_) throw base::Error(base::ExitCode::internal, "a KinectSensor works only after initialize()");
  constexpr std::chrono::milliseconds kPatience(100);
  const auto end = HostClock::now() + kPatience;
  bool has_frame = false;
  try {
    for (auto now = HostClock::now(); !has_frame && now < end; now = HostClock::now()) {
      auto message = open_->device.next(std::chrono::duration_cast<std::chrono::milliseconds>(end - now));
      if (message) add(*message);
      has_frame = handOut();
    }
    if (secondsFrom(open_->last_depths) > options_.silence) {
      char text[64];
      std::snprintf(text, sizeof text, "the Kinect has sent no depth image for %.1f s",
                    secondsFrom(open_->last_depths));
      throw base::Error(base::ExitCode::unreadable_input, text);
    }
  } catch (const base::Error&) {
    m_state = ssError;
    throw;
  }
}

void KinectSensor::add(FreenectMessage& message) {
  if (message.kind == FreenectMessage::Kind::acceleration) {
    if (!open_->has_depths) return;  // without depths the sensor does not count as back yet
    auto imu = mrpt::obs::CObservationIMU::Create();
    imu->timestamp = message.arrival;
    imu->sensorLabel = m_sensorLabel + "_IMU";
    imu->sensorPose = options_.baseFromSensor();
    const auto& [left, up, forward] = message.acceleration;
    imu->set(mrpt::obs::IMU_X_ACC, forward);
    imu->set(mrpt::obs::IMU_Y_ACC, left);
    imu->set(mrpt::obs::IMU_Z_ACC, up);
    appendObservation(imu);
    return;
  }
  const auto time = open_->clock.at(message.ticks, message.arrival);
  if (message.kind == FreenectMessage::Kind::picture) {
    open_->pairing.addPicture(time.seconds, std::move(message.picture));
  } else {
    open_->last_depths = HostClock::now();
    open_->has_depths = true;
    open_->pairing.add({time.seconds, time.stamp, std::move(message.depths), {}});
  }
}

// Appends the next depth image; false if there is none yet. It waits for the picture no longer than the pairing allows.
bool KinectSensor::handOut() {
  const bool is_late = !options_.grab_image || secondsFrom(open_->last_depths) > 2 * options_.pairing;
  const auto frame = open_->pairing.take(is_late);
  if (!frame) return false;
  const auto scan =
      open_->conversion.observation(frame->depths.data(), frame->picture.empty() ? nullptr : frame->picture.data());
  scan->timestamp = frame->stamp;
  scan->sensorLabel = m_sensorLabel;
  appendObservation(scan);
  return true;
}

}  // namespace omnimapper::drivers

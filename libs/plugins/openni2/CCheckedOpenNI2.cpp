#include "CCheckedOpenNI2.h"

#include <OpenNI.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <omnimapper/base/AtLoad.h>
#include <omnimapper/base/Error.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <vector>

IMPLEMENTS_GENERIC_SENSOR(CCheckedOpenNI2, omnimapper::drivers)

namespace omnimapper::drivers {

namespace {

const base::AtLoad kOpenNI2IsRegistered([] { CCheckedOpenNI2::doRegister(); });

base::Error cameraError(const std::string& sentence) {
  return base::Error(base::ExitCode::unreadable_input, sentence);
}

// OpenNI2 stays initialized until the program ends: its drivers are loaded once and report which cameras are plugged
// in.
void openOpenNI2() {
  static const auto status = openni::OpenNI::initialize();
  if (status != openni::STATUS_OK)
    throw cameraError(std::string("OpenNI2 cannot be started: ") + openni::OpenNI::getExtendedError());
}

}  // namespace

class CCheckedOpenNI2::Driver : public mrpt::hwdrivers::COpenNI2Sensor {
 public:
  // Number of its camera among those that are plugged in.
  int deviceNumber() const { return m_user_device_number; }
};

/// Opens streams of the same camera in addition to MRPT's. When all of them have a frame, MRPT's have one, too.
class CCheckedOpenNI2::Watch : private openni::OpenNI::DeviceDisconnectedListener {
 public:
  explicit Watch(const std::string& uri) : uri_(uri), registration_(*this) {
    if (device_.open(uri.c_str()) != openni::STATUS_OK)
      throw cameraError(std::string("the camera cannot be opened: ") + openni::OpenNI::getExtendedError());
    constexpr std::array<openni::SensorType, 3> kTypes{openni::SENSOR_COLOR, openni::SENSOR_DEPTH, openni::SENSOR_IR};
    for (std::size_t i = 0; i < kTypes.size(); ++i) {
      auto& stream = streams_[i];
      if (!device_.hasSensor(kTypes[i]) || stream.create(device_, kTypes[i]) != openni::STATUS_OK) continue;
      // A stream that does not start here, such as infrared beside colour, did not start for MRPT either.
      if (stream.start() != openni::STATUS_OK) {
        stream.destroy();
        continue;
      }
      works_[i] = true;
      listeners_[i].listen(*this, i);
      stream.addNewFrameListener(&listeners_[i]);
    }
  }
  ~Watch() override {
    for (std::size_t i = 0; i < streams_.size(); ++i) {
      if (works_[i]) streams_[i].removeNewFrameListener(&listeners_[i]);
      streams_[i].destroy();
    }
    device_.close();
  }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  // Waits until all streams have a frame that came since forget(); false if one has none within `patience`.
  bool waitForFrames(std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    const bool is_over = changed_.wait_for(lock, patience, [this] { return is_gone_ || came_ == works_; });
    if (is_gone_) throw cameraError("OpenNI2 reports that the camera is gone");
    return is_over;
  }
  void forget() {
    const std::lock_guard lock(mutex_);
    came_ = {};
  }

 private:
  // OpenNI2 keeps a pointer to the listener until it is removed, even if the camera cannot be opened.
  class Registration {
   public:
    explicit Registration(openni::OpenNI::DeviceDisconnectedListener& listener) : listener_(listener) {
      openni::OpenNI::addDeviceDisconnectedListener(&listener_);
    }
    ~Registration() { openni::OpenNI::removeDeviceDisconnectedListener(&listener_); }
    Registration(const Registration&) = delete;
    Registration& operator=(const Registration&) = delete;

   private:
    openni::OpenNI::DeviceDisconnectedListener& listener_;
  };
  // OpenNI2 needs a listener for each stream.
  class Listener : public openni::VideoStream::NewFrameListener {
   public:
    void listen(Watch& watch, std::size_t stream) {
      watch_ = &watch;
      stream_ = stream;
    }

   private:
    void onNewFrame(openni::VideoStream&) override { watch_->frameCame(stream_); }
    Watch* watch_ = nullptr;
    std::size_t stream_ = 0;
  };
  void frameCame(std::size_t stream) {
    const std::lock_guard lock(mutex_);
    came_[stream] = true;
    changed_.notify_all();
  }
  void onDeviceDisconnected(const openni::DeviceInfo* info) override {
    const std::lock_guard lock(mutex_);
    is_gone_ = is_gone_ || uri_ == info->getUri();
    changed_.notify_all();
  }

  const std::string uri_;
  openni::Device device_;
  std::array<Listener, 3> listeners_;
  std::array<openni::VideoStream, 3> streams_;
  std::array<bool, 3> works_{};

  std::mutex mutex_;
  std::condition_variable changed_;
  std::array<bool, 3> came_{};
  bool is_gone_ = false;
  const Registration registration_;  // must be the last member: its callback uses the others
};

CCheckedOpenNI2::CCheckedOpenNI2() {
  m_sensorLabel = "OPENNI2";
  m_state = ssUninitialized;
}

// The destructor of MRPT's driver throws if there was never a camera of its number, which would end the program.
CCheckedOpenNI2::~CCheckedOpenNI2() {
  watch_.reset();
  if (driver_ && driver_->deviceNumber() >= driver_->getNumDevices()) static_cast<void>(driver_.release());
}

void CCheckedOpenNI2::loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& ini, const std::string& section) {
  auto copy = std::make_unique<mrpt::config::CConfigFileMemory>();
  std::vector<std::string> sections;
  ini.getAllSections(sections);
  for (const auto& each : sections) {
    std::vector<std::string> keys;
    ini.getAllKeys(each, keys);
    for (const auto& key : keys) copy->write(each, key, ini.read_string(each, key, ""));
  }
  ini_ = std::move(copy);
  m_grab_decimation = 0;  // MRPT's driver applies that key itself
  section_ = section;
}

void CCheckedOpenNI2::initialize() {
  openOpenNI2();
  openni::Array<openni::DeviceInfo> cameras;
  openni::OpenNI::enumerateDevices(&cameras);
  if (cameras.getSize() == 0)
    throw cameraError(
        "OpenNI2 finds no camera: is it plugged in? Debian's libopenni2-0 brings the udev rules that let "
        "everybody use it");
  const int asked = ini_->read_int(section_, "device_number", 0);
  if (asked < 0 || asked >= cameras.getSize())
    throw cameraError("there is no camera with device_number = " + std::to_string(asked) + " but " +
                      std::to_string(cameras.getSize()) + " in all, counted from 0");
  driver_ = std::make_unique<Driver>();
  driver_->loadConfig(*ini_, section_);
  driver_->initialize();
  if (driver_->getNumDevices() == 0) throw cameraError("the camera is gone again");
  const int number = driver_->deviceNumber();
  watch_ = std::make_unique<Watch>(cameras[std::min(number, cameras.getSize() - 1)].getUri());
  m_state = ssWorking;
}

void CCheckedOpenNI2::doProcess() {
  if (!watch_) throw base::Error(base::ExitCode::internal, "a CCheckedOpenNI2 works only after initialize()");
  try {
    if (!watch_->waitForFrames(std::chrono::milliseconds(100))) return;
    driver_->doProcess();
    watch_->forget();
  } catch (const std::exception&) {
    m_state = ssError;
    throw;
  }
  for (const auto& [stamp, observation] : driver_->getObservations()) appendObservation(observation);
}

}  // namespace omnimapper::drivers

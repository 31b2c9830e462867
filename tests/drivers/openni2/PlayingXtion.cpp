// A driver of OpenNI2 that plays the depths and pictures of a rawlog as an Xtion. Environment: OMNIMAPPER_PLAYED_LOG is
// the rawlog, of 640 x 480 images. At its end the device is unplugged, and plugged in again after
// OMNIMAPPER_UNPLUGGED_S seconds, if that is set; if it is "never", the device stays plugged in and sends nothing until
// it is opened again. Only for tests: OpenNI2 loads it from a folder of the build.
#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/serialization/CArchive.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

// OniDriverAPI.h requires its user to define these.
#define XN_NEW(type, ...) new type(__VA_ARGS__)
#define XN_DELETE(pointer) delete (pointer)
#include <Driver/OniDriverAPI.h>

// Every driver has classes of these names, so they must not be visible to other drivers.
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kWidth = 640, kHeight = 480, kRate = 30;
constexpr std::size_t kPixels = static_cast<std::size_t>(kWidth) * kHeight;

struct Frame {
  std::chrono::duration<double> time;  // since the first image
  std::vector<std::uint16_t> millimetres;
  std::vector<std::uint8_t> red_green_blue;
};

std::vector<Frame> readLog(const std::string& path) {
  std::vector<Frame> frames;
  mrpt::io::CFileGZInputStream file(path);
  auto archive = mrpt::serialization::archiveFrom(file);
  mrpt::Clock::time_point first;
  try {
    while (true) {
      const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservation3DRangeScan>(archive.ReadObject());
      if (!scan || scan->rangeImage.size() != kPixels || !scan->hasIntensityImage) continue;
      if (frames.empty()) first = scan->timestamp;
      auto& frame = frames.emplace_back();
      frame.time = scan->timestamp - first;
      for (const std::uint16_t units : std::vector(scan->rangeImage.begin(), scan->rangeImage.end()))
        frame.millimetres.push_back(
            static_cast<std::uint16_t>(std::lround(units * static_cast<double>(scan->rangeUnits) * 1000)));
      for (unsigned row = 0; row < kHeight; ++row) {
        const auto* pixel = scan->intensityImage.ptrLine<std::uint8_t>(row);
        for (int column = 0; column < kWidth; ++column, pixel += 3)
          frame.red_green_blue.insert(frame.red_green_blue.end(), {pixel[2], pixel[1], pixel[0]});
      }
    }
  } catch (const std::exception&) {  // the end of the file
  }
  return frames;
}

OniVideoMode modeOf(OniSensorType type) {
  return {type == ONI_SENSOR_DEPTH ? ONI_PIXEL_FORMAT_DEPTH_1_MM : ONI_PIXEL_FORMAT_RGB888, kWidth, kHeight, kRate};
}

/// The images that are played, from the time at which the first stream starts.
class Play {
 public:
  explicit Play(std::vector<Frame> frames) : frames_(std::move(frames)) {}

  const std::vector<Frame>& frames() const { return frames_; }
  Clock::time_point begin() {
    const std::lock_guard lock(mutex_);
    // MRPT's driver sleeps for a second after it has started the streams.
    if (!begin_) begin_ = Clock::now() + std::chrono::milliseconds(1200);
    return *begin_;
  }
  void rewind() {
    const std::lock_guard lock(mutex_);
    begin_.reset();
  }

 private:
  const std::vector<Frame> frames_;
  std::mutex mutex_;
  std::optional<Clock::time_point> begin_;
};

class Stream : public oni::driver::StreamBase {
 public:
  Stream(OniSensorType type, std::shared_ptr<Play> play, std::function<void()> on_end)
      : type_(type), play_(std::move(play)), on_end_(std::move(on_end)) {}
  ~Stream() override { stop(); }

  OniStatus start() override {
    stopping_ = false;
    thread_ = std::thread([this] { run(); });
    return ONI_STATUS_OK;
  }
  void stop() override {
    stopping_ = true;
    if (thread_.joinable()) thread_.join();
  }

  OniBool isPropertySupported(int id) override {
    return id == ONI_STREAM_PROPERTY_VIDEO_MODE || id == ONI_STREAM_PROPERTY_HORIZONTAL_FOV ||
           id == ONI_STREAM_PROPERTY_VERTICAL_FOV || id == ONI_STREAM_PROPERTY_MIRRORING ||
           (type_ == ONI_SENSOR_DEPTH && id == ONI_STREAM_PROPERTY_MAX_VALUE);
  }
  OniStatus getProperty(int id, void* data, int* size) override {
    constexpr float kFocalLength = 525;  // [px]
    switch (isPropertySupported(id) ? id : -1) {
      case ONI_STREAM_PROPERTY_VIDEO_MODE:
        return give(modeOf(type_), data, size);
      case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
        return give(2 * std::atan(0.5F * kWidth / kFocalLength), data, size);
      case ONI_STREAM_PROPERTY_VERTICAL_FOV:
        return give(2 * std::atan(0.5F * kHeight / kFocalLength), data, size);
      case ONI_STREAM_PROPERTY_MIRRORING:
        return give(OniBool(FALSE), data, size);
      case ONI_STREAM_PROPERTY_MAX_VALUE:
        return give(10000, data, size);
      default:
        return ONI_STATUS_NOT_IMPLEMENTED;
    }
  }
  OniStatus setProperty(int id, const void*, int) override {
    return isPropertySupported(id) ? ONI_STATUS_OK : ONI_STATUS_NOT_IMPLEMENTED;
  }
  void notifyAllProperties() override {
    for (const int id :
         {ONI_STREAM_PROPERTY_VIDEO_MODE, ONI_STREAM_PROPERTY_HORIZONTAL_FOV, ONI_STREAM_PROPERTY_VERTICAL_FOV,
          ONI_STREAM_PROPERTY_MIRRORING, ONI_STREAM_PROPERTY_MAX_VALUE}) {
      char data[64];
      int size = sizeof data;
      if (getProperty(id, data, &size) == ONI_STATUS_OK) raisePropertyChanged(id, data, size);
    }
  }

 private:
  template <class Value>
  static OniStatus give(const Value& value, void* data, int* size) {
    if (*size < static_cast<int>(sizeof value)) return ONI_STATUS_BAD_PARAMETER;
    std::memcpy(data, &value, sizeof value);
    *size = sizeof value;
    return ONI_STATUS_OK;
  }

  void run() {
    const auto begin = play_->begin();
    int number = 0;
    for (const Frame& frame : play_->frames()) {
      const auto when = begin + std::chrono::duration_cast<Clock::duration>(frame.time);
      while (!stopping_ && Clock::now() < when)
        std::this_thread::sleep_for(std::min<Clock::duration>(when - Clock::now(), std::chrono::milliseconds(20)));
      if (stopping_) return;
      send(frame, ++number);
    }
    if (type_ == ONI_SENSOR_DEPTH) on_end_();
  }

  void send(const Frame& frame, int number) {
    OniFrame* to = getServices().acquireFrame();
    if (!to) return;
    const bool is_depth = type_ == ONI_SENSOR_DEPTH;
    const void* from = is_depth ? static_cast<const void*>(frame.millimetres.data()) : frame.red_green_blue.data();
    to->stride = kWidth * (is_depth ? 2 : 3);
    to->dataSize = to->stride * kHeight;
    std::memcpy(to->data, from, static_cast<std::size_t>(to->dataSize));
    to->frameIndex = number;
    to->videoMode = modeOf(type_);
    to->width = kWidth;
    to->height = kHeight;
    to->cropOriginX = to->cropOriginY = 0;
    to->croppingEnabled = FALSE;
    to->sensorType = type_;
    to->timestamp = static_cast<std::uint64_t>(frame.time.count() * 1e6);
    raiseNewFrame(to);
    getServices().releaseFrame(to);
  }

  const OniSensorType type_;
  const std::shared_ptr<Play> play_;
  const std::function<void()> on_end_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

// MRPT opens an infrared stream, too, in the format of the colour stream, and waits for its frames.
constexpr OniSensorType kSensors[] = {ONI_SENSOR_DEPTH, ONI_SENSOR_COLOR, ONI_SENSOR_IR};

class Device : public oni::driver::DeviceBase {
 public:
  Device(std::shared_ptr<Play> play, std::function<void()> on_end)
      : play_(std::move(play)), on_end_(std::move(on_end)) {
    play_->rewind();
    for (int i = 0; i < 3; ++i) {
      modes_[i] = modeOf(kSensors[i]);
      infos_[i] = {kSensors[i], 1, &modes_[i]};
    }
  }

  OniStatus getSensorInfoList(OniSensorInfo** infos, int* count) override {
    *infos = infos_;
    *count = 3;
    return ONI_STATUS_OK;
  }
  oni::driver::StreamBase* createStream(OniSensorType type) override { return new Stream(type, play_, on_end_); }
  void destroyStream(oni::driver::StreamBase* stream) override { delete stream; }
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode) override { return TRUE; }
  OniBool isPropertySupported(int id) override { return id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION; }
  OniStatus setProperty(int, const void*, int) override { return ONI_STATUS_OK; }
  OniStatus getProperty(int id, void* data, int* size) override {
    if (!isPropertySupported(id)) return ONI_STATUS_NOT_IMPLEMENTED;
    const int is_registered = ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR;
    std::memcpy(data, &is_registered, sizeof is_registered);
    *size = sizeof is_registered;
    return ONI_STATUS_OK;
  }

 private:
  const std::shared_ptr<Play> play_;
  const std::function<void()> on_end_;
  OniVideoMode modes_[3];
  OniSensorInfo infos_[3];
};

class Driver : public oni::driver::DriverBase {
 public:
  explicit Driver(OniDriverServices* services) : DriverBase(services) {
    std::strcpy(info_.uri, "omnimapper-playing-xtion");
    std::strcpy(info_.vendor, "OmniMapper");
    std::strcpy(info_.name, "rawlog");
    info_.usbVendorId = 0x1d27;  // the ids of an Xtion
    info_.usbProductId = 0x0609;
  }
  ~Driver() override { shutdown(); }

  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback changed, void* cookie) override {
    DriverBase::initialize(connected, disconnected, changed, cookie);
    const char* log = std::getenv("OMNIMAPPER_PLAYED_LOG");
    if (!log) return ONI_STATUS_OK;
    play_ = std::make_shared<Play>(readLog(log));
    deviceConnected(&info_);
    return ONI_STATUS_OK;
  }
  oni::driver::DeviceBase* deviceOpen(const char*, const char*) override {
    return new Device(play_, [this] { unplug(); });
  }
  void deviceClose(oni::driver::DeviceBase* device) override { delete device; }
  void shutdown() override {
    stopping_ = true;
    if (cable_.joinable()) cable_.join();
  }

 private:
  // This needs a separate thread, because OpenNI2 stops the streams in this call.
  void unplug() {
    const char* seconds = std::getenv("OMNIMAPPER_UNPLUGGED_S");
    if (seconds && std::string(seconds) == "never") return;
    if (cable_.joinable()) cable_.join();
    cable_ = std::thread([this, seconds] {
      deviceDisconnected(&info_);
      if (!seconds) return;
      const auto back = Clock::now() + std::chrono::duration<double>(std::atof(seconds));
      while (!stopping_ && Clock::now() < back) std::this_thread::sleep_for(std::chrono::milliseconds(20));
      if (!stopping_) deviceConnected(&info_);
    });
  }

  OniDeviceInfo info_{};
  std::shared_ptr<Play> play_;
  std::atomic<bool> stopping_{false};
  std::thread cable_;
};

}  // namespace

ONI_EXPORT_DRIVER(Driver)

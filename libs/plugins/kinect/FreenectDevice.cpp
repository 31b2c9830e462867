#include "FreenectDevice.h"

#include <omnimapper/live/HostClock.h>
#include <sys/time.h>

#include <utility>

namespace omnimapper::drivers {

namespace {

constexpr std::size_t kKinectPixels = static_cast<std::size_t>(kKinectWidth) * kKinectHeight;

base::Error kinectError(const std::string& sentence) {
  return base::Error(base::ExitCode::unreadable_input, sentence);
}

freenect_led_options ledOf(KinectOptions::Led led) {
  switch (led) {
    case KinectOptions::Led::green:
      return LED_GREEN;
    case KinectOptions::Led::red:
      return LED_RED;
    case KinectOptions::Led::yellow:
      return LED_YELLOW;
    case KinectOptions::Led::blink_green:
      return LED_BLINK_GREEN;
    case KinectOptions::Led::blink_red_yellow:
      return LED_BLINK_RED_YELLOW;
    default:
      return LED_OFF;
  }
}

}  // namespace

FreenectDevice::FreenectDevice(const KinectOptions& options)
    : options_(options), depth_buffer_(kKinectPixels), picture_buffer_(3 * kKinectPixels) {
  try {
    open();
    startCameras();
  } catch (const base::Error&) {
    close();
    throw;
  }
  thread_ = std::thread([this] { run(); });
}

FreenectDevice::~FreenectDevice() {
  stopping_ = true;
  thread_.join();
  close();
}

void FreenectDevice::open() {
  if (freenect_init(&context_, nullptr) < 0)
    throw kinectError("libfreenect cannot be started: it has no access to USB");
  freenect_set_log_level(context_, FREENECT_LOG_FATAL);
  const int parts = FREENECT_DEVICE_CAMERA | (options_.usesMotor() ? FREENECT_DEVICE_MOTOR : 0);
  freenect_select_subdevices(context_, static_cast<freenect_device_flags>(parts));
  const int count = freenect_num_devices(context_);
  if (count <= 0)
    throw kinectError("there is no Kinect on USB: is it plugged in, and has it power from its own supply?");
  if (options_.serial.empty() && options_.device_number >= count)
    throw kinectError("there is no Kinect with device_number = " + std::to_string(options_.device_number) + " but " +
                      std::to_string(count) + " in all, counted from 0");
  const int opened = options_.serial.empty()
                         ? freenect_open_device(context_, &device_, options_.device_number)
                         : freenect_open_device_by_camera_serial(context_, &device_, options_.serial.c_str());
  if (opened < 0) {
    device_ = nullptr;
    throw kinectError((options_.serial.empty()
                           ? "the Kinect cannot be opened"
                           : "the Kinect with the serial " + options_.serial + " cannot be opened") +
                      std::string(": another program has it, or this user may not use it; Debian's libfreenect0.5 "
                                  "brings the udev rules that let everybody use it"));
  }
  freenect_set_user(device_, this);
  if (options_.tilt && freenect_set_tilt_degs(device_, *options_.tilt / base::option_text::kRadiansPerDegree) < 0)
    throw kinectError("the Kinect's motor does not turn");
  if (options_.led != KinectOptions::Led::as_it_is && freenect_set_led(device_, ledOf(options_.led)) < 0)
    throw kinectError("the Kinect's lamp cannot be set");
}

void FreenectDevice::startCameras() {
  const auto format =
      options_.registration == KinectOptions::Registration::device ? FREENECT_DEPTH_REGISTERED : FREENECT_DEPTH_11BIT;
  const auto depth_mode = freenect_find_depth_mode(FREENECT_RESOLUTION_MEDIUM, format);
  freenect_set_depth_callback(device_, onDepths);
  if (!depth_mode.is_valid || freenect_set_depth_mode(device_, depth_mode) < 0 ||
      freenect_set_depth_buffer(device_, depth_buffer_.data()) < 0 || freenect_start_depth(device_) < 0)
    throw kinectError("the Kinect's depth camera does not start");
  if (!options_.grab_image) return;
  const auto picture_mode = freenect_find_video_mode(FREENECT_RESOLUTION_MEDIUM, FREENECT_VIDEO_RGB);
  freenect_set_video_callback(device_, onPicture);
  if (!picture_mode.is_valid || freenect_set_video_mode(device_, picture_mode) < 0 ||
      freenect_set_video_buffer(device_, picture_buffer_.data()) < 0 || freenect_start_video(device_) < 0)
    throw kinectError("the Kinect's colour camera does not start");
}

void FreenectDevice::close() {
  if (device_) {
    freenect_stop_depth(device_);
    freenect_stop_video(device_);
    freenect_close_device(device_);
  }
  if (context_) freenect_shutdown(context_);
  device_ = nullptr;
  context_ = nullptr;
}

void FreenectDevice::run() {
  using Clock = std::chrono::steady_clock;
  const auto period = std::chrono::duration<double>(1 / options_.imu_rate);
  auto read = Clock::now() - std::chrono::hours(1);
  while (!stopping_) {
    timeval patience{0, 50'000};
    if (freenect_process_events_timeout(context_, &patience) < 0) return fail("USB reports that the Kinect is gone");
    if (!options_.grab_imu || Clock::now() - read < period) continue;
    read = Clock::now();
    readAcceleration();
    if (!failure_.empty()) return;
  }
}

void FreenectDevice::readAcceleration() {
  constexpr int kMostFailures = 10;  // some readings may get lost while the cameras fill the bus
  auto* state = freenect_update_tilt_state(device_) < 0 ? nullptr : freenect_get_tilt_state(device_);
  if (!state) {
    if (++failed_readings_ == kMostFailures) fail("the Kinect's accelerometer does not answer");
    return;
  }
  failed_readings_ = 0;
  FreenectMessage message;
  message.kind = FreenectMessage::Kind::acceleration;
  auto& [left, up, forward] = message.acceleration;
  freenect_get_mks_accel(state, &left, &up, &forward);
  add(std::move(message));
}

void FreenectDevice::onDepths(freenect_device* device, void* depths, std::uint32_t ticks) {
  FreenectMessage message;
  message.kind = FreenectMessage::Kind::depths;
  message.ticks = ticks;
  const auto* values = static_cast<const std::uint16_t*>(depths);
  message.depths.assign(values, values + kKinectPixels);
  static_cast<FreenectDevice*>(freenect_get_user(device))->add(std::move(message));
}

void FreenectDevice::onPicture(freenect_device* device, void* picture, std::uint32_t ticks) {
  FreenectMessage message;
  message.kind = FreenectMessage::Kind::picture;
  message.ticks = ticks;
  const auto* bytes = static_cast<const std::uint8_t*>(picture);
  message.picture.assign(bytes, bytes + 3 * kKinectPixels);
  static_cast<FreenectDevice*>(freenect_get_user(device))->add(std::move(message));
}

void FreenectDevice::add(FreenectMessage message) {
  // These are messages of a fifth of a second. A reader that is slower than the cameras loses the oldest ones, but
  // those that it gets are never so old that their clock would seem to be another than the host's.
  constexpr std::size_t kMost = 12;
  message.arrival = live::hostNow();
  {
    const std::lock_guard lock(mutex_);
    messages_.push_back(std::move(message));
    if (messages_.size() > kMost) messages_.pop_front();
  }
  arrived_.notify_one();
}

void FreenectDevice::fail(const std::string& reason) {
  {
    const std::lock_guard lock(mutex_);
    failure_ = reason;
  }
  arrived_.notify_one();
}

std::optional<FreenectMessage> FreenectDevice::next(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  arrived_.wait_for(lock, patience, [this] { return !messages_.empty() || !failure_.empty(); });
  if (messages_.empty()) {
    if (!failure_.empty()) throw kinectError(failure_);
    return std::nullopt;
  }
  FreenectMessage message = std::move(messages_.front());
  messages_.pop_front();
  return message;
}

}  // namespace omnimapper::drivers

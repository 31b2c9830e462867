#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/sim/Sensor.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::sim {

namespace {

// Random streams of one sensor: its measurements and their arrival.
constexpr std::uint64_t kArrivalStream = 0xA55, kMeasurementStream = 0x3EA;

constexpr double kMostMeasurements = 1e7;

int countOf(const SensorOptions& options, const SensorContext& context) {
  const double count = std::floor((context.duration - options.first) * options.rate + 1e-9) + 1;
  if (count > kMostMeasurements) {
    throw base::Error(base::ExitCode::out_of_range,
                      context.place() + "rate_hz = " + base::option_text::format(options.rate) + ": makes " +
                          base::option_text::format(count) + " measurements in " +
                          base::option_text::format(context.duration) + " s; at most " +
                          base::option_text::format(kMostMeasurements) + " are possible");
  }
  return std::max(0, static_cast<int>(count));
}

// Labels are used in the names of truth and image files.
void refuseBadLabel(const std::string& label, const std::string& place) {
  if (isPlainFileName(label)) return;
  throw base::Error(
      base::ExitCode::out_of_range,
      place + "label = " + label + ": is used in file names; it must be text without '/' that does not begin with '.'");
}

}  // namespace

const base::OptionTable<SensorOptions>& SensorOptions::table() {
  using base::Range;
  static const auto table =
      base::OptionTable<SensorOptions>()
          .text("label", &SensorOptions::label,
                "Sensor label of the observations. Empty means the name of the section.")
          .number("x_m", &SensorOptions::x, {}, "Position of the sensor in the robot's base frame, forward.")
          .number("y_m", &SensorOptions::y, {}, "Position of the sensor in the robot's base frame, to the left.")
          .number("z_m", &SensorOptions::z, {}, "Position of the sensor in the robot's base frame, upwards.")
          .number("yaw_deg", &SensorOptions::yaw, {}, "Yaw of the sensor in the base frame, positive to the left.")
          .number("pitch_deg", &SensorOptions::pitch, {}, "Pitch of the sensor in the base frame, positive downwards.")
          .number("roll_deg", &SensorOptions::roll, {}, "Roll of the sensor in the base frame, positive to the right.")
          .number("rate_hz", &SensorOptions::rate, {1e-6, 1e5}, "Number of measurements per second.")
          .number("first_s", &SensorOptions::first, Range::notNegative(),
                  "Time of the first measurement after the start of the run.")
          .number("latency_s", &SensorOptions::latency, Range::notNegative(),
                  "Latency from the stamp of a measurement to its arrival, which decides its place in the log.")
          .number("jitter_s", &SensorOptions::jitter, Range::notNegative(), "Standard deviation of the latency.")
          .number("dropout", &SensorOptions::dropout, {0, 1},
                  "Fraction of the sensor's measurements that never arrive.");
  return table;
}

geometry::Se3 SensorOptions::baseFromSensor() const {
  return geometry::fromMrpt(mrpt::poses::CPose3D(x, y, z, yaw, pitch, roll));
}

Sensor::Sensor(const SensorOptions& options, const SensorContext& context)
    : options_(options),
      context_(context),
      base_from_sensor_(options.baseFromSensor()),
      count_(countOf(options, context)) {
  refuseBadLabel(options.label, context.place());
}

bool isSeenWell(double range, double cosine) {
  constexpr double kFarthest = 4, kLeastCosine = 0.25882;  // [m], 75 deg
  return range <= kFarthest && cosine >= kLeastCosine;
}

bool isPlainFileName(const std::string& name) {
  const auto is_bad = [](unsigned char c) { return c == '/' || c < 0x20 || c == 0x7f; };
  return !name.empty() && name.front() != '.' && std::none_of(name.begin(), name.end(), is_bad);
}

base::Stamp Sensor::stampOf(int k) const {
  return context_.start + base::durationFromSeconds(timeOf(k));
}

double Sensor::arrivalOf(int k) const {
  Random random(context_.seed, {context_.number, kArrivalStream, static_cast<std::uint64_t>(k)});
  if (random.chance(options_.dropout)) return -1;
  return timeOf(k) + std::max(0.0, options_.latency + random.gaussian(options_.jitter));
}

geometry::Se3 Sensor::mapFromSensor(double time) const {
  return *context_.map_from_base->at(time) * base_from_sensor_;
}

Random Sensor::randomOf(int k, std::uint64_t purpose) const {
  return {context_.seed, {context_.number, kMeasurementStream + purpose, static_cast<std::uint64_t>(k)}};
}

void Sensor::stamp(mrpt::obs::CObservation& observation, int k) const {
  observation.timestamp = stampOf(k);
  observation.sensorLabel = label();
}

std::unique_ptr<Sensor> makeSensor(const base::Config& config, const std::string& name, SensorContext context) {
  if (!config.has(name)) {
    throw base::Error(base::ExitCode::out_of_range,
                      config.file() + ": [simulation] sensors: there is no section [" + name + "]");
  }
  const base::ConfigSection section = config.section(name);
  std::string class_name;
  section.find("class", class_name);
  std::vector<std::string> known;
  for (const SensorClass& candidate : sensorClasses()) {
    known.push_back(candidate.name);
    if (candidate.name != class_name) continue;
    std::vector<std::string> others{"class"};
    for (const auto& spec : candidate.options) others.push_back(spec.key);
    SensorOptions mount = section.read<SensorOptions>(others);
    if (mount.label.empty()) mount.label = name;
    context.file = config.file();
    context.section = name;
    return candidate.make(section, mount, context);
  }
  const std::string near = base::nearestName(class_name, known);
  throw base::Error(base::ExitCode::unknown_plugin, config.file() + ": [" + name + "] class = " + class_name +
                                                        ": there is no such sensor class" +
                                                        (near.empty() ? "" : "; did you mean '" + near + "'?") +
                                                        " (omnimapper-simulate --list lists them)");
}

}  // namespace omnimapper::sim

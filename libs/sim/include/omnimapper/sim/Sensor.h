#pragma once

#include <mrpt/obs/CObservation.h>
#include <omnimapper/base/Config.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/sim/ObjectView.h>
#include <omnimapper/sim/SignView.h>
#include <omnimapper/sim_world/Random.h>
#include <omnimapper/sim_world/Scene.h>

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace omnimapper::sim {

/// Options that every sensor has: where it is on the base, and when it measures.
struct SensorOptions {
  std::string label;                    ///< of its observations; empty: the name of its section
  double x = 0, y = 0, z = 0;           ///< position of the sensor in the base [m]
  double yaw = 0, pitch = 0, roll = 0;  ///< [rad]
  double rate = 10;                     ///< [1/s]
  double first = 0;                     ///< time of the first measurement [s]
  double latency = 0;                   ///< from stamp to arrival [s]
  double jitter = 0;                    ///< standard deviation of the latency [s]; the latency is never below 0
  double dropout = 0;                   ///< part of the measurements that never arrive
  static const base::OptionTable<SensorOptions>& table();
  geometry::Se3 baseFromSensor() const;
};

/// What a sensor knows about the run.
struct SensorContext {
  std::string file;              ///< of the INI, for messages
  std::string section;           ///< of the INI
  std::uint64_t seed = 0;        ///< of the run
  std::uint64_t number = 0;      ///< hash of the section's name, which identifies the random streams of the sensor
  base::Stamp start;             ///< the stamp of time 0
  double duration = 0;           ///< of the run [s]
  const World* world = nullptr;  ///< world, scenes and map_from_base must outlive the sensor
  const Scenes* scenes = nullptr;
  const Track* map_from_base = nullptr;  ///< the robot's true track
  /// The section as the beginning of a message about one of its options.
  std::string place() const { return file + ": [" + section + "] "; }
};

/// A file of ground truth beside the log.
struct TruthFile {
  std::string name;  ///< path below the folder truth/, such as "labels/camera_000012.png"
  std::string bytes;
};

/// A point of a surface that a beam or pixel measured from nearby and at a moderate angle.
struct VisiblePoint {
  int surface = 0;         ///< number as numberSurfaces() counts
  Eigen::Vector3f in_map;  ///< the true point, without noise [m]
};

/// Whether a measurement at this range [m] and cosine of the angle of incidence shows its surface well: from within 4 m
/// and at 75 deg at most.
bool isSeenWell(double range, double cosine);

/// One measurement with its ground truth.
struct Measurement {
  mrpt::obs::CObservation::Ptr observation;
  std::string truth;  ///< one JSON object on one line, for truth/<label>.jsonl; empty: none
  std::vector<TruthFile> truth_files;
  std::vector<VisiblePoint> seen = {};
  std::vector<SignView> signs = {};  ///< the signs in the picture, if the observation has a picture
  /// The objects in the image of a camera, with depth in the range image.
  std::vector<ObjectView> objects = {};
  /// Lines for truth/<label>_bodies.csv, the beams that ended on people; none: the sensor has no such file.
  std::optional<std::string> body_rows = {};
};

/// Whether a name is not empty and has no '/', no leading '.' and no control characters.
bool isPlainFileName(const std::string& name);

/// A simulated sensor. measure() is const and thread-safe, and depends on nothing but context, options and k.
class Sensor {
 public:
  Sensor(const SensorOptions& options, const SensorContext& context);
  virtual ~Sensor() = default;

  const std::string& label() const { return options_.label; }
  int count() const { return count_; }
  /// Time of measurement k [s].
  double timeOf(int k) const { return options_.first + k / options_.rate; }
  base::Stamp stampOf(int k) const;
  /// Time at which measurement k arrives in the log [s]; negative: never.
  double arrivalOf(int k) const;
  /// Measurement k. Its observation has stamp, label and pose. The observation is null if nothing is in view that it
  /// could report.
  virtual Measurement measure(int k) const = 0;
  /// The view of the colour picture of measurement k; none if the sensor takes no pictures.
  virtual std::optional<CameraView> pictureView(int /*k*/) const { return {}; }
  /// Whether its measurements are images, which show objects.
  virtual bool isCamera() const { return false; }
  /// Approximate size of a measurement in memory [bytes].
  virtual std::size_t sizeOfMeasurement() const { return 16 << 10; }

 protected:
  const SensorOptions& options() const { return options_; }
  const SensorContext& context() const { return context_; }
  const geometry::Se3& baseFromSensor() const { return base_from_sensor_; }
  geometry::Se3 mapFromSensor(double time) const;
  /// A random stream of measurement k; `purpose` distinguishes the streams of one measurement.
  Random randomOf(int k, std::uint64_t purpose = 0) const;
  /// Sets stamp and label.
  void stamp(mrpt::obs::CObservation& observation, int k) const;

 private:
  SensorOptions options_;
  SensorContext context_;
  geometry::Se3 base_from_sensor_;
  int count_;
};

/// A class of sensors, as named in an INI.
struct SensorClass {
  std::string name;                       ///< "Laser2d"
  std::string summary;                    ///< one sentence
  std::vector<base::OptionSpec> options;  ///< its own options, without SensorOptions
  std::function<std::unique_ptr<Sensor>(const base::ConfigSection&, const SensorOptions&, const SensorContext&)> make;
  std::set<std::string> of_model = {};  ///< keys whose default depends on the key `model`
};
/// All classes of sensors, which src/sensors/sensorClasses.cpp lists.
const std::vector<SensorClass>& sensorClasses();

/// Makes the sensor of section [name]. Throws base::Error unknown_plugin, unknown_key, wrong_type or out_of_range.
std::unique_ptr<Sensor> makeSensor(const base::Config& config, const std::string& name, SensorContext context);

/// Entry of sensorClasses() for a sensor that is constructed from (Options, SensorOptions, SensorContext).
template <class SensorType, class Options>
SensorClass sensorClass(const std::string& name, const std::string& summary) {
  return {name, summary, Options::table().specs(),
          [](const base::ConfigSection& section, const SensorOptions& mount, const SensorContext& context) {
            std::vector<std::string> others{"class"};
            for (const auto& spec : SensorOptions::table().specs()) others.push_back(spec.key);
            return std::make_unique<SensorType>(section.read<Options>(others), mount, context);
          }};
}

}  // namespace omnimapper::sim

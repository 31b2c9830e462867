#pragma once

#include <omnimapper/base/Config.h>
#include <omnimapper/sim/Sensor.h>

#include <memory>
#include <string>
#include <vector>

namespace omnimapper::sim {

/// Section [simulation] of an INI.
struct SimulationOptions {
  enum class Format {
    observations,  ///< one observation after another
    frames,        ///< MRPT's pairs of actions (odometry) and sensory frames
  };
  enum class Images {
    embedded,  ///< in the rawlog
    external,  ///< files in <name>_Images beside the rawlog
  };
  int seed = 1;
  double duration = 0;   ///< [s]; 0: until the robot has arrived
  double start = 1.7e9;  ///< Unix time of time 0 [s]
  std::vector<std::string> sensors;
  Format format = Format::observations;
  Images images = Images::embedded;
  static const base::OptionTable<SimulationOptions>& table();
};

/// A world and the true track of the robot's base in it.
struct DrivenWorld {
  World world;
  Track map_from_base;
};
/// Reads [world], [robot] and the sections that they name: the world, the drive, and the people who accompany the robot
/// on it.
DrivenWorld readDrivenWorld(const base::Config& config);

/// A world, a robot that drives through it and its sensors, read from an INI and ready to run.
class Simulation {
 public:
  /// Reads sections [simulation], [world], [robot] and those they name. Throws base::Error with the place in the INI.
  explicit Simulation(const base::Config& config);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  const SimulationOptions& options() const { return options_; }
  const World& world() const { return driven_.world; }
  const Scenes& scenes() const { return scenes_; }
  const Track& mapFromBase() const { return driven_.map_from_base; }
  const std::vector<std::unique_ptr<Sensor>>& sensors() const { return sensors_; }
  double duration() const { return duration_; }
  base::Stamp start() const { return base::stampFromUnix(options_.start); }
  const std::string& iniText() const { return ini_text_; }
  /// What a user should know about the INI.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  SimulationOptions options_;
  DrivenWorld driven_;
  Scenes scenes_;
  double duration_;
  std::string ini_text_;
  std::vector<std::string> warnings_;
  std::vector<std::unique_ptr<Sensor>> sensors_;
};

}  // namespace omnimapper::sim

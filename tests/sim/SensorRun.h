#pragma once

#include <omnimapper/sim/Sensor.h>

#include <map>
#include <memory>
#include <sstream>
#include <string>

/// A sensor on a robot in a world, made from the text of its section.
class SensorRun {
 public:
  SensorRun(omnimapper::sim::World world, omnimapper::sim::Track map_from_base, const std::string& keys,
            double duration = 0, std::uint64_t seed = 1)
      : world_(std::move(world)), map_from_base_(std::move(map_from_base)), scenes_(world_) {
    omnimapper::sim::SensorContext context;
    context.seed = seed;
    context.number = 3;
    context.start = omnimapper::base::stampFromUnix(1.6e9);
    context.duration = duration;
    context.world = &world_;
    context.scenes = &scenes_;
    context.map_from_base = &map_from_base_;
    // If a key is given twice, the last value counts.
    std::map<std::string, std::string> values;
    std::istringstream lines(keys);
    for (std::string line; std::getline(lines, line);) {
      const std::size_t equals = line.find(" = ");
      if (equals != std::string::npos) values[line.substr(0, equals)] = line.substr(equals);
    }
    std::string text = "[sensor]\n";
    for (const auto& [key, value] : values) text += key + value + "\n";
    sensor_ = omnimapper::sim::makeSensor(omnimapper::base::Config::fromText(text, "test.ini"), "sensor", context);
  }
  SensorRun(const SensorRun&) = delete;
  SensorRun& operator=(const SensorRun&) = delete;

  const omnimapper::sim::Sensor& sensor() const { return *sensor_; }
  const omnimapper::sim::World& world() const { return world_; }
  const omnimapper::sim::Track& track() const { return map_from_base_; }
  template <class Observation>
  std::shared_ptr<Observation> measure(int k) const {
    return std::dynamic_pointer_cast<Observation>(sensor_->measure(k).observation);
  }
  std::string truth(int k) const { return sensor_->measure(k).truth; }

 private:
  omnimapper::sim::World world_;
  omnimapper::sim::Track map_from_base_;
  omnimapper::sim::Scenes scenes_;
  std::unique_ptr<omnimapper::sim::Sensor> sensor_;
};

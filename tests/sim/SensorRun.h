#pragma once

#include <omnimapper/sim/Sensor.h>

#include <memory>
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
    sensor_ = omnimapper::sim::makeSensor(omnimapper::base::Config::fromText("[sensor]\n" + keys + "\n", "test.ini"),
                                          "sensor", context);
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

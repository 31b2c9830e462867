#pragma once

#include <omnimapper/sim/Sensor.h>
#include <omnimapper/sim_world/MeshBuilder.h>
#include <omnimapper/sim_world/World.h>

#include <memory>
#include <string>

namespace omnimapper::sim {

/// A small world with a robot and a sensor, made by hand. At first cameras look along the map's x.
class CameraFixture {
 public:
  /// Adds an upright rectangle as a new surface that faces -x, with its centre at (x, y, z) [m].
  void addBoard(const std::string& name, double x, double y, double z, double width, double height,
                const Material& material = {}) {
    addFacing(name, SurfaceKind::wall, {Eigen::Quaterniond::Identity(), {x, y, z}}, width, height, material);
  }
  /// Adds the same with its centre at a pose, facing the pose's -x.
  void addFacing(const std::string& name, SurfaceKind kind, const geometry::Se3& map_from_middle, double width,
                 double height, const Material& material = {}) {
    MeshBuilder builder(name, Track(map_from_middle));
    builder.layout(TextureLayout::fitted());
    const double w = 0.5 * width, h = 0.5 * height;
    builder.addPlane("", kind, material, {{0, w, -h}, {0, -w, -h}, {0, -w, h}, {0, w, h}});
    world.bodies.push_back(builder.build());
  }

  /// Makes the sensor of section [camera]; `ini` begins with its class.
  std::unique_ptr<Sensor> make(const std::string& ini) {
    scenes = std::make_unique<Scenes>(world);
    SensorContext context;
    context.seed = 5;
    context.duration = 10;
    context.world = &world;
    context.scenes = scenes.get();
    context.map_from_base = &map_from_base;
    return makeSensor(base::Config::fromText("[camera]\nclass = " + ini + "\n", "test"), "camera", context);
  }

  World world;
  std::unique_ptr<Scenes> scenes;
  Track map_from_base{geometry::Se3{}};
};

}  // namespace omnimapper::sim

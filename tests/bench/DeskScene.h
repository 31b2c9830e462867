#pragma once

#include <omnimapper/sim_world/MeshBuilder.h>
#include <omnimapper/sim_world/Textures.h>
#include <omnimapper/sim_world/World.h>

#include <string>

namespace omnimapper::bench {

/// Scenes that resemble those of the recordings with a hand-held Kinect: an office with desks, and a table top with
/// boxes and cups.
class DeskScene {
 public:
  /// A room of 6 x 5 m with two desks in a corner, monitors, paper, boxes, a chair and a shelf.
  static sim::World office() {
    DeskScene scene;
    scene.addRoom(6, 5);
    scene.addDesk("desk_1", 1.6, 0.0, 1.6, 0.8, 0.0);
    scene.addDesk("desk_2", 1.6, 1.3, 1.6, 0.8, M_PI / 2);
    scene.addMonitor("monitor_1", 1.75, -0.35, 0.75, -2.9);
    scene.addMonitor("monitor_2", 1.9, 0.55, 0.75, 2.9);
    scene.addClutter(1.3, 0.0, 0.75, 0.55);
    scene.addClutter(1.6, 1.3, 0.75, 0.5);
    scene.addShelf(-2.2, 2.3);
    scene.addChair(0.7, 0.6);
    scene.addChair(0.2, -1.6);
    return scene.world_;
  }

  /// A table of 1.2 x 0.8 m in the same room.
  static sim::World tableTop() {
    DeskScene scene;
    scene.addRoom(6, 5);
    scene.addDesk("table", 0.9, 0, 0.8, 1.2, 0.0);
    scene.addClutter(0.85, 0, 0.75, 0.3);
    return scene.world_;
  }

 private:
  using Vec = Eigen::Vector3d;
  static geometry::Se3 pose(double x, double y, double z, double yaw = 0) {
    return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Vec::UnitZ())), {x, y, z}};
  }
  static sim::Material material(float r, float g, float b, float infrared,
                                std::shared_ptr<const sim::Texture> texture = nullptr) {
    return {{r, g, b}, std::move(texture), infrared, 0};
  }
  void add(sim::MeshBuilder& builder) { world_.bodies.push_back(builder.build()); }
  std::string name(const std::string& kind) { return kind + "_" + std::to_string(count_++); }

  void addRoom(double length, double width) {
    using sim::SurfaceKind;
    using sim::TextureKind;
    sim::MeshBuilder room("room");
    const double x = 0.5 * length, y = 0.5 * width, h = 2.7;
    room.layout({{sim::textureSide(TextureKind::planks), sim::textureSide(TextureKind::planks)}});
    room.addPlane("floor", SurfaceKind::floor, material(1, 1, 1, 0.45f, sim::makeTexture(TextureKind::planks, 1)),
                  {{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}});
    room.layout({{sim::textureSide(TextureKind::plaster), sim::textureSide(TextureKind::plaster)}});
    const sim::Material wall = material(0.95f, 0.95f, 0.92f, 0.7f, sim::makeTexture(TextureKind::plaster, 2));
    room.addPlane("ceiling", SurfaceKind::ceiling, wall, {{-x, -y, h}, {-x, y, h}, {x, y, h}, {x, -y, h}});
    room.addPlane("front", SurfaceKind::wall, wall, {{x, -y, 0}, {x, -y, h}, {x, y, h}, {x, y, 0}});
    room.addPlane("back", SurfaceKind::wall, wall, {{-x, y, 0}, {-x, y, h}, {-x, -y, h}, {-x, -y, 0}});
    room.addPlane("left", SurfaceKind::wall, wall, {{x, y, 0}, {x, y, h}, {-x, y, h}, {-x, y, 0}});
    room.addPlane("right", SurfaceKind::wall, wall, {{-x, -y, 0}, {-x, -y, h}, {x, -y, h}, {x, -y, 0}});
    add(room);
  }

  void addDesk(const std::string& desk_name, double x, double y, double depth, double length, double yaw) {
    sim::MeshBuilder desk(desk_name, sim::Track(pose(x, y, 0, yaw)));
    desk.layout({{sim::textureSide(sim::TextureKind::wood), sim::textureSide(sim::TextureKind::wood)}});
    const double hx = 0.5 * depth, hy = 0.5 * length;
    const int top = desk.addSurface("top", sim::SurfaceKind::table, material(0.85f, 0.83f, 0.8f, 0.65f));
    desk.addBox(top, {-hx, -hy, 0.72}, {hx, hy, 0.75});
    const int legs = desk.addSurface("legs", sim::SurfaceKind::table, material(0.1f, 0.1f, 0.1f, 0.2f));
    for (const double sx : {-1.0, 1.0}) {
      for (const double sy : {-1.0, 1.0}) {
        const Vec middle(sx * (hx - 0.06), sy * (hy - 0.06), 0);
        desk.addBox(legs, middle - Vec(0.025, 0.025, 0), middle + Vec(0.025, 0.025, 0.72));
      }
    }
    add(desk);
  }

  void addMonitor(const std::string& monitor_name, double x, double y, double z, double yaw) {
    sim::MeshBuilder monitor(monitor_name, sim::Track(pose(x, y, z, yaw)));
    const int frame = monitor.addSurface("frame", sim::SurfaceKind::object, material(0.5f, 0.5f, 0.52f, 0.5f));
    monitor.addBox(frame, {-0.04, -0.22, 0.08}, {0.0, 0.22, 0.44});
    monitor.addBox(frame, {-0.1, -0.1, 0}, {0.1, 0.1, 0.015});
    monitor.addBox(frame, {-0.05, -0.03, 0.015}, {-0.02, 0.03, 0.1});
    const int screen = monitor.addSurface("screen", sim::SurfaceKind::object, material(0.02f, 0.02f, 0.025f, 0.01f));
    monitor.addBox(screen, {0.0, -0.2, 0.1}, {0.003, 0.2, 0.42});
    add(monitor);
  }

  /// Paper, books, cups, boxes and balls on a surface around (x, y, z).
  void addClutter(double x, double y, double z, double reach) {
    sim::Random random(7, {static_cast<std::uint64_t>(count_)});
    for (int i = 0; i < 11; ++i) {
      const double angle = 2 * M_PI * (i / 11.0) + random.uniform(-0.2, 0.2), far = reach * random.uniform(0.35, 1);
      sim::MeshBuilder item(name("thing"), sim::Track(pose(x + far * std::cos(angle), y + far * std::sin(angle), z,
                                                           random.uniform(-3, 3))));
      item.layout(sim::TextureLayout::fitted());
      const auto r = static_cast<float>(random.uniform(0.1, 0.9)), g = static_cast<float>(random.uniform(0.1, 0.9)),
                 b = static_cast<float>(random.uniform(0.1, 0.9)), ir = static_cast<float>(random.uniform(0.15, 0.8));
      const bool printed = i % 3 == 0;
      const int surface = item.addSurface(
          "", sim::SurfaceKind::object,
          printed ? material(1, 1, 1, ir, sim::makeTexture(sim::TextureKind::print, i)) : material(r, g, b, ir));
      if (i % 4 == 0) item.addBox(surface, {-0.08, -0.05, 0}, {0.08, 0.05, random.uniform(0.05, 0.25)});
      if (i % 4 == 1) item.addCylinder(surface, random.uniform(0.03, 0.05), 0, random.uniform(0.09, 0.2));
      if (i % 4 == 2) item.addBox(surface, {-0.15, -0.1, 0}, {0.15, 0.1, 0.004});
      if (i % 4 == 3) item.at(pose(0, 0, 0.06)), item.addSphere(surface, 0.06);
      add(item);
    }
  }

  void addShelf(double x, double y) {
    sim::MeshBuilder shelf(name("shelf"), sim::Track(pose(x, y, 0)));
    const int boards = shelf.addSurface("boards", sim::SurfaceKind::shelf, material(0.5f, 0.35f, 0.2f, 0.5f));
    for (int i = 0; i < 5; ++i) shelf.addBox(boards, {-0.5, -0.15, 0.1 + 0.4 * i}, {0.5, 0.15, 0.12 + 0.4 * i});
    shelf.addBox(boards, {-0.52, -0.15, 0}, {-0.5, 0.15, 1.8});
    shelf.addBox(boards, {0.5, -0.15, 0}, {0.52, 0.15, 1.8});
    shelf.layout({{sim::textureSide(sim::TextureKind::books), 0.28}});
    const int books = shelf.addSurface("books", sim::SurfaceKind::clutter,
                                       material(1, 1, 1, 0.4f, sim::makeTexture(sim::TextureKind::books, 3)));
    for (int i = 1; i < 4; ++i) shelf.addBox(books, {-0.45, -0.1, 0.12 + 0.4 * i}, {0.3, 0.12, 0.4 + 0.4 * i});
    add(shelf);
  }

  void addChair(double x, double y) {
    sim::MeshBuilder chair(name("chair"), sim::Track(pose(x, y, 0, 0.7)));
    const int seat = chair.addSurface("seat", sim::SurfaceKind::chair, material(0.05f, 0.05f, 0.12f, 0.12f));
    chair.addBox(seat, {-0.22, -0.22, 0.42}, {0.22, 0.22, 0.48});
    chair.addBox(seat, {-0.24, -0.2, 0.55}, {-0.2, 0.2, 0.95});
    const int foot = chair.addSurface("foot", sim::SurfaceKind::chair, material(0.15f, 0.15f, 0.15f, 0.2f));
    chair.addCylinder(foot, 0.03, 0.05, 0.42);
    chair.addCylinder(foot, 0.25, 0.02, 0.06, 5);
    add(chair);
  }

  sim::World world_;
  int count_ = 0;
};

}  // namespace omnimapper::bench

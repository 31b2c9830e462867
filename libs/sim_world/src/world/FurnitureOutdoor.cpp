#include <omnimapper/sim_world/Furniture.h>

#include <cmath>

namespace omnimapper::sim {

namespace {

using Piece = FurniturePiece;

geometry::Se3 movedTo(double x, double y, double z) {
  return {Eigen::Quaterniond::Identity(), {x, y, z}};
}

// A kerb along its length; its front is the face to the road.
void kerb(Piece& p) {
  p.slab("top", p.part("sides"), {-p.length / 2, -p.width / 2, 0}, {p.length / 2, p.width / 2, p.height});
}

void sidewalk(Piece& p) {
  p.slab("top", p.part("sides", "kerb_stone"), {-p.length / 2, -p.width / 2, 0}, {p.length / 2, p.width / 2, p.height});
}

// Body, cabin and wheels; the front looks to -x.
void car(Piece& p) {
  const double l = p.length / 2, w = p.width / 2;
  const int body = p.part("body"), glass = p.part("windows", "screen"), wheels = p.part("wheels", "black_plastic");
  p.mesh.addPrism(body, rectangle({-l, -w}, {l, w}), 0.28, 0.85);
  const std::vector<Eigen::Vector2d> side{{-l * 0.5, 0.85}, {l * 0.8, 0.85}, {l * 0.6, p.height}, {-l * 0.2, p.height}};
  const auto at = [&](int i, double y) { return Eigen::Vector3d(side[i].x(), y, side[i].y()); };
  const double in = w * 0.88;
  p.mesh.addFace(glass, {at(0, -in), at(1, -in), at(2, -in), at(3, -in)});
  p.mesh.addFace(glass, {at(1, in), at(0, in), at(3, in), at(2, in)});
  p.mesh.addFace(glass, {at(0, in), at(0, -in), at(3, -in), at(3, in)});
  p.mesh.addFace(glass, {at(1, -in), at(1, in), at(2, in), at(2, -in)});
  p.mesh.addFace(body, {at(3, -in), at(2, -in), at(2, in), at(3, in)});
  for (const double x : {-0.62, 0.62}) {
    for (const double y : {-w + 0.1, w - 0.1}) {
      const Eigen::Quaterniond lying(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX()));
      p.mesh.at({lying, {x * l, y, 0.31}}).addCylinder(wheels, 0.31, -0.1, 0.1, 16);
    }
  }
  p.mesh.at({});
}

void tree(Piece& p) {
  p.mesh.addRevolution(p.part("trunk", "bark"), {{0.16, 0}, {0.1, p.height * 0.55}}, 10);
  const int leaves = p.part("leaves");
  for (int i = 0; i < 16; ++i) {
    const double radius = p.random.uniform(0.12, 0.2) * p.length, angle = p.random.uniform(0, 2 * M_PI);
    const double out = p.random.uniform(0, p.length / 2 - radius);
    const double z = p.random.uniform(0.5, 1.0) * (p.height - radius);
    p.mesh.at(movedTo(out * std::cos(angle), out * std::sin(angle), z)).addSphere(leaves, radius, 10);
  }
  p.mesh.at({});
}

void lampPost(Piece& p) {
  const int post = p.part("post");
  p.mesh.addRevolution(post, {{0.09, 0}, {0.05, p.height}}, 10);
  p.box(post, {-0.06, -1.2, p.height - 0.12}, {0.06, 0.06, p.height});
}

void bollard(Piece& p) {
  p.mesh.addCylinder(p.part(""), p.length / 2, 0, p.height, 12);
}

void hedge(Piece& p) {
  const int leaves = p.part("");
  for (double x = -p.length / 2; x < p.length / 2 - 0.05;) {
    const double l = std::min(p.random.uniform(0.3, 0.6), p.length / 2 - x), h = p.height * p.random.uniform(0.88, 1.0);
    p.box(leaves, {x, -p.width / 2 * p.random.uniform(0.85, 1.0), 0}, {x + l, p.width / 2, h});
    x += l;
  }
}

// A front of a house with rows of windows and a door. The true surface of its front is one plane with holes.
void house(Piece& p) {
  const double l = p.length / 2, y = -p.width / 2, back = p.width / 2;
  const int body = p.part("body"), glass = p.part("windows", "screen"), door = p.part("door", "door_wood");
  const int across = std::max(1, static_cast<int>(p.length / 2.6)), up = std::max(1, static_cast<int>(p.height / 2.9));
  const double step = p.length / across;
  const auto quad = [&](double x0, double x1, double z0, double z1, double depth) {
    return std::vector<Eigen::Vector3d>{
        {x0, y + depth, z0}, {x1, y + depth, z0}, {x1, y + depth, z1}, {x0, y + depth, z1}};
  };
  std::vector<std::vector<Eigen::Vector3d>> holes;
  for (int i = 0; i < across; ++i) {
    for (int k = 0; k < up; ++k) {
      const bool is_door = k == 0 && i == across / 2;
      const double middle = -l + step * (i + 0.5), half = is_door ? 0.5 : 0.6;
      const double z0 = is_door ? 0.1 : 2.9 * k + 0.95, z1 = is_door ? 2.2 : 2.9 * k + 2.35;
      holes.push_back(quad(middle - half, middle + half, z0, z1, 0));
      p.mesh.addFace(is_door ? door : glass, quad(middle - half, middle + half, z0, z1, 0.15));
      for (std::size_t e = 0; e < 4; ++e) {
        const Eigen::Vector3d &a = holes.back()[e], &b = holes.back()[(e + 1) % 4], in(0, 0.15, 0);
        p.mesh.addFace(body, {a, b, b + in, a + in});
      }
    }
  }
  const NamedMaterial look = p.material();
  p.mesh.layout(look.layout).addPlane("front", SurfaceKind::wall, look.material, quad(-l, l, 0, p.height, 0), holes);
  p.mesh.addFace(body, {{l, y, 0}, {l, back, 0}, {l, back, p.height}, {l, y, p.height}});
  p.mesh.addFace(body, {{-l, back, 0}, {-l, y, 0}, {-l, y, p.height}, {-l, back, p.height}});
  p.mesh.addFace(body, {{l, back, 0}, {-l, back, 0}, {-l, back, p.height}, {l, back, p.height}});
  p.mesh.addFace(body, {{-l, y, p.height}, {l, y, p.height}, {l, back, p.height}, {-l, back, p.height}});
}

}  // namespace

const std::vector<FurnitureShape>& outdoorShapes() {
  using Kind = SurfaceKind;
  using Class = surfaces::SurfaceClass;
  static const std::vector<FurnitureShape> shapes{
      {"kerb", 4.0, 0.15, 0.12, 0, Kind::kerb, "kerb_stone", kerb, Class::floor, Class::floor, true},
      {"sidewalk", 4.0, 2.0, 0.12, 0, Kind::floor, "pavement", sidewalk, Class::floor, Class::floor, true},
      {"car", 4.3, 1.75, 1.45, 0, Kind::clutter, "car_silver", car, Class::object, Class::object, true},
      {"tree", 2.4, 2.4, 4.5, 0, Kind::clutter, "plant", tree},
      {"lamp_post", 0.2, 0.2, 5.0, 0, Kind::clutter, "black_metal", lampPost},
      {"bollard", 0.2, 0.2, 0.9, 0, Kind::clutter, "steel", bollard},
      {"hedge", 4.0, 0.6, 1.1, 0, Kind::clutter, "plant", hedge},
      {"house", 9.0, 3.0, 6.2, 0, Kind::wall, "plaster", house, Class::wall, Class::wall},
  };
  return shapes;
}

}  // namespace omnimapper::sim

#include <omnimapper/sim_world/Furniture.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::sim {

namespace {

using Piece = FurniturePiece;

geometry::Se3 shifted(double x, double y, double z, double yaw = 0) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ())), {x, y, z}};
}

void table(Piece& p) {
  const int frame = p.part("frame");
  p.slab("top", frame, {-p.length / 2, -p.width / 2, p.height - 0.03}, {p.length / 2, p.width / 2, p.height});
  p.legs(frame, 0.05, p.height - 0.03);
}

void roundTable(Piece& p) {
  const int frame = p.part("frame");
  std::vector<Eigen::Vector3d> rim;
  for (int i = 0; i < 24; ++i) {
    const double angle = 2 * M_PI * i / 24;
    rim.emplace_back(p.length / 2 * std::cos(angle), p.width / 2 * std::sin(angle), p.height);
  }
  std::vector<Eigen::Vector3d> below(rim.rbegin(), rim.rend());
  for (auto& q : below) q.z() -= 0.03;
  p.mesh.addFace(frame, below);
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const auto &a = rim[i], &b = rim[(i + 1) % rim.size()];
    const Eigen::Vector3d down(0, 0, -0.03);
    p.mesh.addFace(frame, {a + down, b + down, b, a});
  }
  p.mesh.addCylinder(frame, 0.05, 0, p.height - 0.03, 12);
  p.mesh.addCylinder(frame, 0.3, 0, 0.03, 16);
  const NamedMaterial look = materialNamed("oak");
  p.mesh.layout(look.layout).addPlane("top", SurfaceKind::table, look.material, rim);
}

// A desk: table with a drawer unit under its right end.
void desk(Piece& p) {
  table(p);
  const int drawers = p.part("drawers", "laminate_grey");
  p.box(drawers, {p.length / 2 - 0.5, -p.width / 2 + 0.1, 0.05}, {p.length / 2 - 0.1, p.width / 2 - 0.05, 0.6});
}

void counter(Piece& p) {
  const double l = p.length / 2, w = p.width / 2;
  const int body = p.part("body");
  p.box(body, {-l, -w + 0.06, 0}, {l, w, 0.1});
  p.box(body, {-l, -w + 0.02, 0.1}, {l, w, p.height - 0.04});
  p.slab("top", p.part("edge", "stone_worktop"), {-l, -w, p.height - 0.04}, {l, w, p.height}, "stone_worktop");
}

// Open to the front, with boards at equal heights; the lowest is above the plinth.
void shelf(Piece& p) {
  const double l = p.length / 2, w = p.width / 2, t = 0.02;
  const int frame = p.part("frame");
  p.box(frame, {-l, -w, 0}, {-l + t, w, p.height});
  p.box(frame, {l - t, -w, 0}, {l, w, p.height});
  p.box(frame, {-l + t, w - 0.01, 0}, {l - t, w, p.height});
  const int count = p.boards > 0 ? p.boards : std::max(2, static_cast<int>(std::lround(p.height / 0.35)));
  for (int i = 0; i < count; ++i) {
    const double top = 0.08 + (p.height - 0.08) * i / (count - 1);
    p.slab("board_" + std::to_string(i + 1), frame, {-l + t, -w, top - t}, {l - t, w - 0.01, top});
  }
}

void bookcase(Piece& p) {
  shelf(p);
  const int count = p.boards > 0 ? p.boards : std::max(2, static_cast<int>(std::lround(p.height / 0.35)));
  const std::array<int, 4> books{p.part("books_1", "cloth_red"), p.part("books_2", "cloth_blue"),
                                 p.part("books_3", "cloth_green"), p.part("books_4", "cardboard")};
  const double step = (p.height - 0.08) / (count - 1);
  for (int i = 0; i + 1 < count; ++i) {
    double x = -p.length / 2 + 0.03;
    while (x < p.length / 2 - 0.12) {
      const double thickness = p.random.uniform(0.02, 0.06), high = p.random.uniform(0.6, 0.85) * step,
                   deep = p.random.uniform(0.6, 0.9) * p.width;
      const double bottom = 0.08 + step * i;
      if (p.random.chance(0.85)) {
        p.box(books[p.random.integer(0, 3)], {x, p.width / 2 - 0.02 - deep, bottom},
              {x + thickness, p.width / 2 - 0.02, bottom + high});
      }
      x += thickness + 0.002;
    }
  }
}

void rack(Piece& p) {
  const int frame = p.part("frame");
  p.legs(frame, 0.04, p.height);
  const int count = p.boards > 0 ? p.boards : 4;
  for (int i = 0; i < count; ++i) {
    const double top = 0.12 + (p.height - 0.14) * i / (count - 1);
    p.slab("board_" + std::to_string(i + 1), frame, {-p.length / 2, -p.width / 2, top - 0.03},
           {p.length / 2, p.width / 2, top});
  }
}

void chair(Piece& p) {
  const double l = p.length / 2, w = p.width / 2;
  const int frame = p.part("frame");
  p.slab("seat", frame, {-l, -w, 0.41}, {l, w, 0.45});
  p.legs(frame, 0.04, 0.41);
  p.box(frame, {-l, w - 0.03, 0.45}, {-l + 0.04, w, p.height});
  p.box(frame, {l - 0.04, w - 0.03, 0.45}, {l, w, p.height});
  p.box(frame, {-l + 0.04, w - 0.03, p.height - 0.25}, {l - 0.04, w - 0.01, p.height - 0.02});
}

void officeChair(Piece& p) {
  const int base = p.part("base", "black_plastic"), cloth = p.part("cloth");
  for (int i = 0; i < 5; ++i) {
    p.mesh.at(shifted(0, 0, 0, 2 * M_PI * i / 5)).addBox(base, {0.02, -0.025, 0.05}, {0.3, 0.025, 0.09});
  }
  p.mesh.at({});
  p.mesh.addCylinder(base, 0.035, 0.05, 0.42, 10);
  p.box(cloth, {-0.24, -0.24, 0.42}, {0.24, 0.24, 0.5});
  p.box(cloth, {-0.22, 0.2, 0.6}, {0.22, 0.26, p.height});
  p.box(base, {-0.03, 0.24, 0.4}, {0.03, 0.27, 0.6});
}

void seatWithArms(Piece& p) {
  const double l = p.length / 2, w = p.width / 2;
  const int cloth = p.part("cloth");
  p.box(cloth, {-l, -w, 0.08}, {-l + 0.18, w, 0.6});
  p.box(cloth, {l - 0.18, -w, 0.08}, {l, w, 0.6});
  p.box(cloth, {-l + 0.18, w - 0.22, 0.08}, {l - 0.18, w, p.height});
  p.slab("seat", cloth, {-l + 0.18, -w, 0.08}, {l - 0.18, w - 0.22, 0.43});
}

void bed(Piece& p) {
  const double l = p.length / 2, w = p.width / 2;
  const int frame = p.part("frame"), linen = p.part("linen", "linen_white");
  p.box(frame, {-l, w - 0.05, 0}, {l, w, 1.0});  // the head is at the wall behind
  p.box(frame, {-l, -w, 0.08}, {l, w - 0.05, 0.3});
  p.slab("top", p.part("mattress", "cloth_blue"), {-l + 0.02, -w + 0.02, 0.3}, {l - 0.02, w - 0.05, p.height},
         "cloth_blue");
  const int pillows = p.length > 1.2 ? 2 : 1;
  for (int i = 0; i < pillows; ++i) {
    const double middle = pillows == 1 ? 0 : (i - 0.5) * l;
    p.box(linen, {middle - 0.3, w - 0.5, p.height}, {middle + 0.3, w - 0.08, p.height + 0.12});
  }
}

void cabinet(Piece& p) {
  p.cabinet({-p.length / 2, -p.width / 2, 0}, {p.length / 2, p.width / 2, p.height});
}

void toilet(Piece& p) {
  const int body = p.part("body");
  p.box(body, {-0.18, p.width / 2 - 0.18, 0.3}, {0.18, p.width / 2, p.height});
  p.mesh.at(shifted(0, -0.08, 0)).addRevolution(body, {{0.12, 0}, {0.11, 0.2}, {0.19, 0.38}, {0.19, 0.42}}, 16);
  p.mesh.at({});
}

void bathtub(Piece& p) {
  const double l = p.length / 2, w = p.width / 2, rim = 0.07;
  const int body = p.part("body");
  p.box(body, {-l, -w, 0}, {l, w, 0.15});
  p.box(body, {-l, -w, 0.15}, {l, -w + rim, p.height});
  p.box(body, {-l, w - rim, 0.15}, {l, w, p.height});
  p.box(body, {-l, -w + rim, 0.15}, {-l + rim, w - rim, p.height});
  p.box(body, {l - rim, -w + rim, 0.15}, {l, w - rim, p.height});
}

void washbasin(Piece& p) {
  const int body = p.part("body");
  p.box(body, {-0.12, p.width / 2 - 0.2, 0}, {0.12, p.width / 2, p.height - 0.18});
  p.box(body, {-p.length / 2, -p.width / 2, p.height - 0.18}, {p.length / 2, p.width / 2, p.height});
}

// A television or screen on a foot.
void television(Piece& p) {
  const int frame = p.part("frame");
  p.box(frame, {-0.2, -0.1, 0}, {0.2, 0.1, 0.03});
  p.box(frame, {-0.05, 0, 0.03}, {0.05, 0.03, 0.15});
  p.box(frame, {-p.length / 2, -0.02, 0.1}, {p.length / 2, 0.03, p.height});
}

void partition(Piece& p) {
  p.cabinet({-p.length / 2, -p.width / 2, 0}, {p.length / 2, p.width / 2, p.height});
}

void glassPane(Piece& p) {
  const double l = p.length / 2;
  const int rail = p.part("rail", "steel");
  p.box(rail, {-l, -p.width / 2, 0}, {l, p.width / 2, 0.04});
  p.box(rail, {-l, -p.width / 2, p.height - 0.04}, {l, p.width / 2, p.height});
  const NamedMaterial glass = materialNamed("glass");
  p.mesh.addPlane("pane", SurfaceKind::window, glass.material,
                  {{-l, 0, 0.04}, {l, 0, 0.04}, {l, 0, p.height - 0.04}, {-l, 0, p.height - 0.04}});
}

void pillar(Piece& p) {
  p.mesh.addCylinder(p.part(""), p.length / 2, 0, p.height, 24);
}

void plant(Piece& p) {
  p.mesh.addRevolution(p.part("pot", "clay"), {{p.length * 0.28, 0}, {p.length * 0.38, 0.3}}, 16);
  const int leaves = p.part("leaves");
  p.mesh.addCylinder(leaves, 0.02, 0.3, p.height * 0.6, 6);
  for (int i = 0; i < 14; ++i) {
    const double angle = p.random.uniform(0, 2 * M_PI), z = p.random.uniform(0.4, 1.0) * (p.height - 0.15);
    const double radius = p.random.uniform(0.05, 0.1), out = p.random.uniform(0, p.length / 2 - radius);
    p.mesh.at(shifted(out * std::cos(angle), out * std::sin(angle), z)).addSphere(leaves, radius, 8);
  }
  p.mesh.at({});
}

void bin(Piece& p) {
  p.mesh.addRevolution(p.part(""), {{p.length * 0.4, 0}, {p.length * 0.5, p.height}}, 16);
}

void radiator(Piece& p) {
  const int body = p.part("");
  p.box(body, {-p.length / 2, -p.width / 2, 0}, {p.length / 2, p.width / 2, p.height});
}

// Cartons and crates as they pile up along walls and on floors, each turned a little.
void clutter(Piece& p) {
  static const char* const looks[] = {"cardboard", "cardboard", "plastic_blue", "laminate_grey", "cloth_black"};
  int count = 0;
  for (double x = -p.length / 2; x < p.length / 2 - 0.15;) {
    const double l = std::min(p.random.uniform(0.2, 0.5), p.length / 2 - x), w = p.random.uniform(0.5, 0.85) * p.width;
    double z = 0;
    for (int layer = 0; layer < 3 && (layer == 0 || p.random.chance(0.45)); ++layer) {
      const double shrink = 1 - 0.12 * layer, h = std::min(p.random.uniform(0.12, 0.4), p.height - z);
      if (h < 0.08) break;
      const int surface = p.part("item_" + std::to_string(++count), looks[p.random.integer(0, 4)]);
      const double turn = p.random.uniform(-0.12, 0.12);
      p.mesh.at(shifted(x + l / 2, 0, z, turn));
      p.mesh.addBox(surface, {-l / 2 * shrink * 0.88, -w / 2 * shrink * 0.88, 0},
                    {l / 2 * shrink * 0.88, w / 2 * shrink * 0.88, h});
      z += h;
    }
    x += l;
  }
  p.mesh.at({});
}

// Apparatus of a laboratory: a block on a frame with drums, pipes and an arm.
void machine(Piece& p) {
  const double l = p.length / 2, w = p.width / 2;
  const int frame = p.part("frame", "black_metal"), body = p.part("body"), pipe = p.part("pipe", "steel");
  p.legs(frame, 0.06, 0.5);
  p.box(body, {-l, -w, 0.5}, {l * 0.4, w, p.height * 0.7});
  p.mesh.at(shifted(l * 0.7, 0, 0)).addCylinder(pipe, std::min(l * 0.28, w * 0.8), 0.5, p.height, 16);
  p.mesh.at(shifted(-l * 0.4, 0, 0)).addCylinder(frame, 0.07, p.height * 0.7, p.height, 12);
  p.mesh.at({});
  p.box(pipe, {-l * 0.4, -0.05, p.height - 0.1}, {l * 0.7, 0.05, p.height});
}

}  // namespace

const std::vector<FurnitureShape>& furnitureShapes() {
  using Kind = SurfaceKind;
  using Class = surfaces::SurfaceClass;
  static const std::vector<FurnitureShape> shapes{
      {"table", 1.6, 0.9, 0.74, 0, Kind::table, "oak", table, Class::table, Class::cabinet},
      {"round_table", 1.1, 1.1, 0.74, 0, Kind::table, "oak", roundTable, Class::table, Class::cabinet},
      {"desk", 1.6, 0.8, 0.73, 0, Kind::table, "birch", desk, Class::table, Class::cabinet},
      {"coffee_table", 1.1, 0.6, 0.42, 0, Kind::table, "walnut", table, Class::table, Class::cabinet},
      {"bedside_table", 0.45, 0.4, 0.5, 0, Kind::table, "birch", table, Class::table, Class::cabinet},
      {"workbench", 2.0, 0.8, 0.9, 0, Kind::table, "laminate_grey", table, Class::table, Class::cabinet},
      {"counter", 2.0, 0.62, 0.91, 0, Kind::counter, "white_board", counter, Class::counter, Class::cabinet},
      {"shelf", 0.9, 0.35, 1.8, 0, Kind::shelf, "birch", shelf, Class::shelf, Class::cabinet},
      {"bookcase", 0.9, 0.32, 2.0, 0, Kind::shelf, "oak", bookcase, Class::shelf, Class::cabinet},
      {"rack", 1.2, 0.5, 2.0, 0, Kind::shelf, "steel", rack, Class::shelf, Class::cabinet},
      {"chair", 0.45, 0.45, 0.9, 0, Kind::chair, "oak", chair, Class::seat, Class::seat},
      {"office_chair", 0.62, 0.62, 1.0, 0, Kind::chair, "cloth_black", officeChair, Class::seat, Class::seat},
      {"armchair", 0.85, 0.85, 0.8, 0, Kind::chair, "leather_brown", seatWithArms, Class::seat, Class::seat},
      {"sofa", 2.1, 0.9, 0.8, 0, Kind::chair, "cloth_grey", seatWithArms, Class::seat, Class::seat},
      {"bed", 1.6, 2.1, 0.5, 0, Kind::clutter, "oak", bed, Class::bed, Class::bed},
      {"cabinet", 0.9, 0.45, 0.85, 0, Kind::shelf, "white_board", cabinet, Class::cabinet, Class::cabinet},
      {"sideboard", 1.6, 0.42, 0.75, 0, Kind::shelf, "walnut", cabinet, Class::cabinet, Class::cabinet},
      {"wardrobe", 1.8, 0.6, 2.1, 0, Kind::shelf, "white_board", cabinet, Class::cabinet, Class::cabinet},
      {"filing_cabinet", 0.47, 0.62, 1.32, 0, Kind::shelf, "laminate_grey", cabinet, Class::cabinet, Class::cabinet},
      {"wall_cabinet", 1.8, 0.35, 0.7, 1.45, Kind::shelf, "white_board", cabinet, Class::cabinet, Class::cabinet},
      {"fridge", 0.6, 0.65, 1.85, 0, Kind::clutter, "enamel_white", cabinet, Class::appliance, Class::appliance},
      {"stove", 0.6, 0.62, 0.91, 0, Kind::counter, "enamel_white", cabinet, Class::appliance, Class::appliance},
      {"printer", 0.6, 0.6, 1.05, 0, Kind::clutter, "laminate_grey", cabinet, Class::appliance, Class::appliance},
      {"toilet", 0.38, 0.68, 0.8, 0, Kind::clutter, "enamel_white", toilet, Class::appliance, Class::appliance},
      {"bathtub", 1.7, 0.75, 0.56, 0, Kind::clutter, "enamel_white", bathtub, Class::appliance, Class::appliance},
      {"washbasin", 0.6, 0.45, 0.85, 0, Kind::clutter, "enamel_white", washbasin, Class::appliance, Class::appliance},
      {"television", 1.1, 0.2, 0.75, 0, Kind::clutter, "screen", television, Class::appliance, Class::appliance},
      {"partition", 1.8, 0.06, 1.5, 0, Kind::wall, "cloth_grey", partition, Class::wall, Class::wall},
      {"glass_pane", 2.0, 0.06, 2.4, 0, Kind::window, "steel", glassPane, Class::window, Class::window},
      {"pillar", 0.5, 0.5, 2.6, 0, Kind::wall, "concrete", pillar, Class::wall, Class::wall},
      {"plant", 0.6, 0.6, 1.3, 0, Kind::clutter, "plant", plant},
      {"bin", 0.3, 0.3, 0.4, 0, Kind::clutter, "black_plastic", bin},
      {"radiator", 1.0, 0.1, 0.5, 0.12, Kind::clutter, "enamel_white", radiator, Class::appliance, Class::appliance},
      {"clutter", 1.2, 0.5, 0.9, 0, Kind::clutter, "cardboard", clutter},
      {"machine", 1.4, 0.9, 1.7, 0, Kind::clutter, "paint_blue", machine, Class::appliance, Class::appliance},
  };
  return shapes;
}

}  // namespace omnimapper::sim

#include "objectShapes.h"

#include <omnimapper/sim_world/Footprint.h>
#include <omnimapper/sim_world/Textures.h>

#include <cmath>

#include "TextureDrawing.h"

namespace omnimapper::sim {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Material plain(Random& random, const Colour& colour) {
  Material material;
  material.colour = colour;
  material.infrared = static_cast<float>(random.uniform(0.3, 0.8));
  return material;
}

Material textured(Random& random, TextureKind kind, int side = 128) {
  Material material = plain(random, Colour::Ones());
  material.texture = makeTexture(kind, random.bits(), side);
  return material;
}

Material patterned(Random& random) {
  constexpr TextureKind kKinds[] = {TextureKind::print, TextureKind::wallpaper, TextureKind::noise};
  return textured(random, kKinds[random.integer(0, 2)]);
}

Material bright(Random& random) {
  return plain(random, randomColour(random, 0.5, 0.95, 0.5, 0.95));
}

int addSurface(MeshBuilder& builder, const std::string& part, const Material& material) {
  return builder.addSurface(part, SurfaceKind::object, material);
}

// A tube with flat ends along a line in the plane y = 0.
void addTube(MeshBuilder& builder, int surface, const std::vector<Vector2d>& line, double radius, int sides = 10) {
  std::vector<std::vector<Vector3d>> rings;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vector2d ahead =
        (line[std::min(i + 1, line.size() - 1)] - line[std::max<std::size_t>(i, 1) - 1]).normalized();
    const Vector3d across(-ahead.y(), 0, ahead.x()), middle(line[i].x(), 0, line[i].y());
    rings.emplace_back();
    for (int side = 0; side < sides; ++side) {
      const double angle = 2 * M_PI * side / sides;
      rings.back().push_back(middle + radius * (std::cos(angle) * across + std::sin(angle) * Vector3d::UnitY()));
    }
  }
  for (std::size_t k = 0; k + 1 < rings.size(); ++k) {
    for (int side = 0; side < sides; ++side) {
      const int next = (side + 1) % sides;
      builder.addFace(surface, {rings[k][side], rings[k + 1][next], rings[k][next]});
      builder.addFace(surface, {rings[k][side], rings[k + 1][side], rings[k + 1][next]});
    }
  }
  builder.addFace(surface, rings.front());
  builder.addFace(surface, {rings.back().rbegin(), rings.back().rend()});
}

void addBall(MeshBuilder& builder, Random& random) {
  const int surface = addSurface(builder, "", textured(random, TextureKind::checker));
  builder.at({Eigen::Quaterniond::Identity(), {0, 0, 0.11}});
  builder.addSphere(surface, 0.11, 28);
}

void addBook(MeshBuilder& builder, Random& random) {
  builder.addBox(addSurface(builder, "", textured(random, TextureKind::print, 256)), {-0.08, -0.115, 0},
                 {0.08, 0.115, 0.03});
  const Material paper = plain(random, Colour(0.9f, 0.88f, 0.8f));
  builder.addBox(addSurface(builder, "pages", paper), {-0.07, -0.117, 0.004}, {0.081, 0.117, 0.026});
}

void addBottle(MeshBuilder& builder, Random& random) {
  const Material glass = bright(random);
  builder.addRevolution(addSurface(builder, "", glass),
                        {{0.036, 0}, {0.038, 0.01}, {0.038, 0.15}, {0.032, 0.18}, {0.014, 0.21}, {0.014, 0.24}});
  builder.addRevolution(addSurface(builder, "label", textured(random, TextureKind::print, 256)),
                        {{0.0388, 0.04}, {0.0388, 0.12}});
  builder.addCylinder(addSurface(builder, "cap", bright(random)), 0.016, 0.235, 0.26);
}

void addBowl(MeshBuilder& builder, Random& random) {
  builder.addRevolution(addSurface(builder, "", patterned(random)), {{0.035, 0},
                                                                     {0.035, 0.006},
                                                                     {0.055, 0.02},
                                                                     {0.075, 0.05},
                                                                     {0.08, 0.075},
                                                                     {0.075, 0.075},
                                                                     {0.069, 0.05},
                                                                     {0.05, 0.025},
                                                                     {0.03, 0.012},
                                                                     {0, 0.01}});
}

void addBox(MeshBuilder& builder, Random& random) {
  builder.addBox(addSurface(builder, "", textured(random, TextureKind::print, 256)), {-0.095, -0.03, 0},
                 {0.095, 0.03, 0.28});
}

void addBrick(MeshBuilder& builder, Random& random) {
  const int surface = addSurface(builder, "", bright(random));
  builder.addBox(surface, {-0.064, -0.032, 0}, {0.064, 0.032, 0.038});
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 2; ++row) {
      builder.at({Eigen::Quaterniond::Identity(), {-0.048 + 0.032 * column, -0.016 + 0.032 * row, 0}});
      builder.addCylinder(surface, 0.0096, 0.03, 0.046, 12);
    }
  }
}

void addCan(MeshBuilder& builder, Random& random) {
  builder.addRevolution(addSurface(builder, "", textured(random, TextureKind::print, 256)),
                        {{0.03, 0}, {0.033, 0.006}, {0.033, 0.112}});
  builder.addRevolution(addSurface(builder, "lid", plain(random, Colour::Constant(0.75f))),
                        {{0.0335, 0.11}, {0.028, 0.121}, {0.025, 0.121}, {0, 0.118}});
}

void addCone(MeshBuilder& builder, Random& random) {
  const Material orange = plain(random, Colour(0.95f, 0.35f, 0.05f)), white = plain(random, Colour::Constant(0.95f));
  const int surface = addSurface(builder, "", orange);
  builder.addBox(surface, {-0.14, -0.14, 0}, {0.14, 0.14, 0.02});
  builder.addRevolution(surface, {{0.11, 0.015}, {0.02, 0.45}});
  builder.addRevolution(addSurface(builder, "band", white), {{0.0795, 0.17}, {0.0565, 0.28}});
}

void addCup(MeshBuilder& builder, Random& random) {
  const int surface = addSurface(builder, "", patterned(random));
  builder.addRevolution(surface, {{0.034, 0}, {0.04, 0.006}, {0.041, 0.095}, {0.037, 0.095}, {0.035, 0.01}, {0, 0.008}},
                        32);
  std::vector<Vector2d> line{{0.0385, 0.075}};
  for (int i = 0; i <= 10; ++i) {
    const double angle = M_PI / 2 - M_PI * i / 10;
    line.emplace_back(0.046 + 0.022 * std::cos(angle), 0.05 + 0.025 * std::sin(angle));
  }
  line.emplace_back(0.0385, 0.025);
  addTube(builder, addSurface(builder, "handle", bright(random)), line, 0.005);
}

void addLamp(MeshBuilder& builder, Random& random) {
  builder.addRevolution(addSurface(builder, "", textured(random, TextureKind::cloth, 256)),
                        {{0.13, 0.25}, {0.09, 0.42}, {0.086, 0.42}, {0, 0.4}}, 32);
  const int stand = addSurface(builder, "stand", plain(random, Colour::Constant(0.15f)));
  builder.addRevolution(stand, {{0.08, 0}, {0.08, 0.01}, {0.02, 0.025}, {0.012, 0.05}, {0.012, 0.34}, {0, 0.36}});
  builder.at({Eigen::Quaterniond::Identity(), {0, 0, 0.33}});
  builder.addBox(stand, {-0.111, -0.003, -0.003}, {0.111, 0.003, 0.003});
}

void addLaptop(MeshBuilder& builder, Random& random) {
  const Material shell = plain(random, Colour::Constant(static_cast<float>(random.uniform(0.15, 0.7))));
  const int surface = addSurface(builder, "", shell);
  builder.addBox(surface, {-0.165, -0.115, 0}, {0.165, 0.115, 0.016});
  const Material dark = plain(random, Colour::Constant(0.06f));
  const int keys = addSurface(builder, "keys", dark);
  for (int row = 0; row < 4; ++row) {
    for (int key = 0; key < 11; ++key) {
      const double x = -0.15 + 0.0275 * key, y = 0.08 - 0.0275 * row;
      builder.addBox(keys, {x, y - 0.022, 0.0155}, {x + 0.023, y, 0.018});
    }
  }
  builder.at({Eigen::Quaterniond(Eigen::AngleAxisd(-0.28, Vector3d::UnitX())), {0, 0.112, 0.012}});
  builder.addBox(surface, {-0.165, -0.004, 0}, {0.165, 0.004, 0.225});
  builder.addBox(addSurface(builder, "screen", textured(random, TextureKind::print, 256)), {-0.153, -0.005, 0.012},
                 {0.153, -0.003, 0.213});
}

void addPlate(MeshBuilder& builder, Random& random) {
  builder.addRevolution(
      addSurface(builder, "", patterned(random)),
      {{0.06, 0}, {0.075, 0.006}, {0.12, 0.02}, {0.12, 0.024}, {0.08, 0.011}, {0.07, 0.007}, {0, 0.006}}, 32);
}

void addPot(MeshBuilder& builder, Random& random) {
  builder.addRevolution(
      addSurface(builder, "", textured(random, TextureKind::bricks)),
      {{0.07, 0}, {0.1, 0.15}, {0.106, 0.15}, {0.106, 0.175}, {0.096, 0.175}, {0.09, 0.155}, {0, 0.155}});
  Material leaf = textured(random, TextureKind::noise);
  leaf.colour = Colour(0.25f, 0.8f, 0.2f);
  leaf.infrared = 0.5f;
  const int leaves = addSurface(builder, "leaves", leaf);
  for (int i = 0; i < 9; ++i) {
    const double turn = 2 * M_PI * i / 9 + random.uniform(-0.2, 0.2), tilt = random.uniform(0.25, 0.75);
    const double length = random.uniform(0.2, 0.3);
    builder.at(
        {Eigen::Quaterniond(Eigen::AngleAxisd(turn, Vector3d::UnitZ()) * Eigen::AngleAxisd(tilt, Vector3d::UnitY())),
         {0.03 * std::cos(turn), 0.03 * std::sin(turn), 0.15}});
    builder.addRevolution(leaves, {{0.004, 0}, {0.03, 0.5 * length}, {0.022, 0.8 * length}, {0, length}}, 6);
  }
}

Ring outlineOfPrism() {
  const double side = 0.09, height = side * std::sqrt(3) / 2;
  return {{-side / 2, -height / 2}, {side / 2, -height / 2}, {0, height / 2}};
}

void addPrism(MeshBuilder& builder, Random& random) {
  builder.addPrism(addSurface(builder, "", textured(random, TextureKind::wood)), outlineOfPrism(), 0, 0.12);
}

LevelTop rectangularTop(double half_length, double half_width, double z) {
  return {rectangle({-half_length, -half_width}, {half_length, half_width}), z};
}

LevelTop roundTop(double radius, double z) {
  constexpr int kCorners = 24;
  LevelTop top{{}, z};
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * M_PI * i / kCorners;
    top.outline_in_body.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return top;
}

}  // namespace

const std::vector<ObjectShape>& shapesOfObjects() {
  static const std::vector<ObjectShape> shapes{
      {"ball", addBall},
      {"book", addBook, rectangularTop(0.08, 0.115, 0.03)},
      {"bottle", addBottle},
      {"bowl", addBowl},
      {"box", addBox, rectangularTop(0.095, 0.03, 0.28)},
      {"brick", addBrick, rectangularTop(0.064, 0.032, 0.046)},  // others stand on its studs
      {"can", addCan, roundTop(0.028, 0.121)},
      {"cone", addCone},
      {"cup", addCup},
      {"lamp", addLamp},
      {"laptop", addLaptop},
      {"plate", addPlate, roundTop(0.07, 0.007)},
      {"pot", addPot},
      {"prism", addPrism, LevelTop{outlineOfPrism(), 0.12}}};
  return shapes;
}

}  // namespace omnimapper::sim

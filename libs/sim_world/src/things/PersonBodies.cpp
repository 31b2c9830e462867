#include "PersonBodies.h"

#include <omnimapper/sim_world/MeshBuilder.h>
#include <omnimapper/sim_world/Textures.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "TextureDrawing.h"

namespace omnimapper::sim {

namespace {

using Eigen::Vector3d;
using geometry::Se3;
using PoseOf = std::function<Se3(const Posture&)>;

constexpr int kSides = 12;  // of a limb; few, because people move, and moving bodies are built anew for each time

struct Clothes {
  Material skin, shirt, trousers, shoes, hair;
};

Material ofColour(const Colour& colour, double infrared) {
  Material material;
  material.colour = colour;
  material.infrared = static_cast<float>(infrared);
  return material;
}

Clothes clothesOf(std::uint64_t seed) {
  constexpr std::uint64_t kStream = 0x9e0913;
  Random random(seed, {kStream});
  Clothes clothes;
  const double tone = random.uniform(0.3, 0.9);
  clothes.skin = ofColour(colourOf(0.06, 0.6 - 0.3 * tone, tone), 0.5);
  clothes.hair = ofColour(colourOf(0.08, 0.5, random.uniform(0.05, 0.6)), 0.2);
  const bool patterned = random.chance(0.5);
  const double shirt_infrared = random.uniform(0.2, 0.8);
  clothes.shirt =
      ofColour(patterned ? Colour::Ones().eval() : randomColour(random, 0.1, 0.8, 0.2, 0.9), shirt_infrared);
  if (patterned) clothes.shirt.texture = makeTexture(TextureKind::cloth, random.bits(), 128);
  const Colour trousers = randomColour(random, 0.1, 0.5, 0.08, 0.5);
  clothes.trousers = ofColour(trousers, random.uniform(0.08, 0.6));
  clothes.shoes = ofColour(Colour::Constant(static_cast<float>(random.uniform(0.05, 0.5))), 0.3);
  return clothes;
}

// A limb along -z from the origin, round at both ends.
std::vector<ProfilePoint> limbProfile(double length, double radius_above, double radius_below) {
  constexpr int kSteps = 3;
  std::vector<ProfilePoint> profile;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = 0.5 * M_PI * i / kSteps;
    profile.push_back({i == 0 ? 0 : radius_below * std::sin(angle), -length - radius_below * std::cos(angle)});
  }
  for (int i = kSteps; i >= 0; --i) {
    const double angle = 0.5 * M_PI * i / kSteps;
    profile.push_back({i == 0 ? 0 : radius_above * std::sin(angle), radius_above * std::cos(angle)});
  }
  return profile;
}

// Frame of a limb: origin at `upper`, -z to `lower`, x as far ahead as that allows.
Se3 limbPose(const Vector3d& upper, const Vector3d& lower, double yaw) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(yaw, Vector3d::UnitZ()));
  const Vector3d down = turn.conjugate() * (lower - upper);
  return {turn * Eigen::Quaterniond::FromTwoVectors(-Vector3d::UnitZ(), down), upper};
}

class Dresser {
 public:
  Dresser(const PersonSpec& spec, const Anatomy& anatomy, const std::vector<Posture>& postures)
      : spec_(spec), anatomy_(anatomy), postures_(postures), clothes_(clothesOf(spec.seed)) {}

  std::vector<Body> dress() {
    addHead();
    addTorso();
    for (const bool right : {false, true}) {
      addLimb(right, "thigh", clothes_.trousers, Limb::hip, Limb::knee, anatomy_.thigh, 0.075, 0.06);
      addLimb(right, "shin", clothes_.trousers, Limb::knee, Limb::foot, anatomy_.shin, 0.06, 0.058);
      addFoot(right);
      addLimb(right, "upper_arm", clothes_.shirt, Limb::shoulder, Limb::elbow, anatomy_.upper_arm, 0.052, 0.042);
      addForearm(right);
    }
    return std::move(bodies_);
  }

 private:
  MeshBuilder builder(const std::string& part, const PoseOf& poseOf) const {
    MeshBuilder builder(spec_.name + "/" + part, trackAlong(postures_, poseOf));
    builder.layout({{0.1, 0.1}});
    return builder;
  }

  // Radii are given for a person of 1.72 m.
  double scaled(double length) const { return length * anatomy_.height / 1.72; }

  static PoseOf poseOfLimb(bool right, Limb from, Limb to) {
    return [=](const Posture& posture) {
      return limbPose(posture.in_map[jointOf(right, from)], posture.in_map[jointOf(right, to)], posture.yaw);
    };
  }

  static std::string sideOf(bool right) { return right ? "right_" : "left_"; }

  void addLimb(bool right, const std::string& part, const Material& material, Limb from, Limb to, double length,
               double above, double below) {
    MeshBuilder mesh = builder(sideOf(right) + part, poseOfLimb(right, from, to));
    mesh.addRevolution(mesh.addSurface("", SurfaceKind::person, material),
                       limbProfile(length, scaled(above), scaled(below)), kSides);
    bodies_.push_back(mesh.build());
  }

  // The sleeve ends in the middle; the hand is a ball about its joint.
  void addForearm(bool right) {
    MeshBuilder mesh = builder(sideOf(right) + "forearm", poseOfLimb(right, Limb::elbow, Limb::hand));
    mesh.addRevolution(mesh.addSurface("", SurfaceKind::person, clothes_.shirt),
                       limbProfile(0.55 * anatomy_.forearm, scaled(0.042), scaled(0.036)), kSides);
    const int skin = mesh.addSurface("hand", SurfaceKind::person, clothes_.skin);
    mesh.addRevolution(skin, limbProfile(anatomy_.forearm, scaled(0.03), scaled(0.028)), kSides);
    mesh.at({Eigen::Quaterniond::Identity(), {0, 0, -anatomy_.forearm}});
    mesh.addSphere(skin, scaled(0.042), 10);
    bodies_.push_back(mesh.build());
  }

  void addFoot(bool right) {
    const PoseOf pose = [right](const Posture& posture) {
      const double yaw = right ? posture.right_foot_yaw : posture.left_foot_yaw;
      return Se3{Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Vector3d::UnitZ())),
                 posture.in_map[jointOf(right, Limb::foot)]};
    };
    MeshBuilder mesh = builder(sideOf(right) + "foot", pose);
    const double h = anatomy_.height, toe = 0.11 * h, heel = -0.042 * h, half = 0.026 * h, sole = -anatomy_.ankle_z;
    // The outline is seen from the side, x ahead and z up; the frame is turned so that the prism lies across.
    mesh.at({Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitX())), {0, 0, 0}});
    mesh.addPrism(mesh.addSurface("", SurfaceKind::person, clothes_.shoes),
                  {{heel, sole}, {toe, sole}, {toe, 0.55 * sole}, {0.035 * h, 0.012 * h}, {heel, 0.012 * h}}, -half,
                  half);
    bodies_.push_back(mesh.build());
  }

  void addTorso() {
    const PoseOf pose = [](const Posture& posture) {
      const Vector3d hips = 0.5 * (posture.in_map[Joint::left_hip] + posture.in_map[Joint::right_hip]);
      const Eigen::Quaterniond upright(Eigen::AngleAxisd(posture.yaw, Vector3d::UnitZ()));
      if (posture.lean == 0) return Se3{upright, hips};
      return Se3{upright * Eigen::Quaterniond(Eigen::AngleAxisd(posture.lean, Vector3d::UnitY())), hips};
    };
    MeshBuilder mesh = builder("torso", pose);
    const double h = anatomy_.height;
    const auto flat = [&](int surface, const std::vector<ProfilePoint>& profile) {
      std::vector<ProfilePoint> scaled;
      for (const ProfilePoint& p : profile) scaled.push_back({p.radius * h, p.z * h});
      mesh.addRevolution(surface, scaled, 20);
    };
    flat(mesh.addSurface("", SurfaceKind::person, clothes_.shirt), {{0, -0.005},
                                                                    {0.095, -0.004},
                                                                    {0.09, 0.07},
                                                                    {0.1, 0.17},
                                                                    {0.118, 0.25},
                                                                    {0.105, 0.295},
                                                                    {0.04, 0.318},
                                                                    {0, 0.322}});
    flat(mesh.addSurface("hips", SurfaceKind::person, clothes_.trousers),
         {{0, -0.055}, {0.07, -0.05}, {0.096, -0.02}, {0.098, 0.01}, {0.088, 0.035}, {0, 0.036}});
    flat(mesh.addSurface("neck", SurfaceKind::person, clothes_.skin), {{0.033, 0.3}, {0.033, 0.37}});
    Body body = mesh.build();
    // The torso is 0.6 times as deep as it is wide.
    for (Vector3d& p : body.vertices_in_body) p.x() *= 0.6;
    bodies_.push_back(std::move(body));
  }

  void addHead() {
    const PoseOf pose = [](const Posture& posture) {
      return Se3{Eigen::Quaterniond(Eigen::AngleAxisd(posture.head_yaw, Vector3d::UnitZ()) *
                                    Eigen::AngleAxisd(-posture.head_pitch, Vector3d::UnitY())),
                 posture.in_map[Joint::head]};
    };
    MeshBuilder mesh = builder("head", pose);
    const double radius = 0.06 * anatomy_.height;
    mesh.addSphere(mesh.addSurface("", SurfaceKind::person, clothes_.skin), radius, 16);
    mesh.at({Eigen::Quaterniond::Identity(), {radius, 0, -0.15 * radius}});
    mesh.addSphere(mesh.addSurface("nose", SurfaceKind::person, clothes_.skin), 0.18 * radius, 8);
    mesh.at({Eigen::Quaterniond::Identity(), {-0.16 * radius, 0, 0.14 * radius}});
    mesh.addSphere(mesh.addSurface("hair", SurfaceKind::person, clothes_.hair), radius, 16);
    Body body = mesh.build();
    for (Vector3d& p : body.vertices_in_body) p = p.cwiseProduct(Vector3d(0.95, 0.8, 1.12));
    bodies_.push_back(std::move(body));
  }

  const PersonSpec& spec_;
  const Anatomy& anatomy_;
  const std::vector<Posture>& postures_;
  Clothes clothes_;
  std::vector<Body> bodies_;
};

}  // namespace

std::vector<Body> bodiesOf(const PersonSpec& spec, const Anatomy& anatomy, const std::vector<Posture>& postures) {
  return Dresser(spec, anatomy, postures).dress();
}

}  // namespace omnimapper::sim

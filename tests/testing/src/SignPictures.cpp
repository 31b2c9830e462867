#include <mrpt/obs/CObservationImage.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/sim/Sensor.h>
#include <omnimapper/sim_world/Building.h>
#include <omnimapper/sim_world/Generators.h>
#include <omnimapper/testing/SignPictures.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "SignWalls.h"

namespace omnimapper::testing {

namespace {

using namespace omnimapper::sim;
using Eigen::Vector3d;
using geometry::Se3;

// Independent streams of random numbers from the seed.
enum Stream : std::uint64_t { kPlaceStream = 0x516e, kViewStream, kLightStream };

WorldPlan planOf(const SignPictureOptions& options, int number, int attempt, Random random) {
  const bool is_dark = options.style == "dark";
  WorldOptions world;
  world.seed = static_cast<int>(1 + number + 100 * options.seed) + 1000000 * attempt;
  world.sign_style = options.style;
  world.move_time = -1;
  world.wear = random.uniform(0, 0.08);
  world.clutter = number % 2 == 0 ? ClutterLevel::low : ClutterLevel::medium;
  if (is_dark || number % 2 == 0) {
    world.generator = is_dark ? "office" : "laboratory";
    const int plan = static_cast<int>(10 * options.seed) + 2 * number + (is_dark ? 0 : 1);
    world.plan_seed = number == 0 && attempt == 0 ? 0 : plan + 1000 * attempt;
  } else {
    world.generator = "loop";
    world.length = 200;
  }
  WorldPlan plan = generate(world, "sign pictures");
  // Buildings with dark signs have painted walls, those with white signs partly coarser ones.
  static const char* const dark_walls[] = {"paint_white", "paint_cream", "paint_grey"};
  static const char* const white_walls[] = {"paint_cream", "paint_green", "concrete", "brick"};
  for (RoomPlan& room : plan.rooms)
    room.wall = is_dark ? dark_walls[random.integer(0, 2)] : white_walls[random.integer(0, 3)];
  for (OpeningPlan& opening : plan.openings) {
    if (opening.kind == OpeningPlan::Kind::door && random.chance(0.6)) opening.leaf = OpeningPlan::Leaf::closed;
  }
  return plan;
}

// Tries other seeds if makeWorld() refuses a plan, because doors of a loop overlap or a sign is wider than its wall.
World worldOf(const SignPictureOptions& options, int number, const Random& random) {
  constexpr int kTries = 20;
  for (int attempt = 0;; ++attempt) {
    try {
      return makeWorld(planOf(options, number, attempt, random));
    } catch (const base::Error& error) {
      if (error.code() != base::ExitCode::out_of_range || attempt == kTries) throw;
    }
  }
}

// The pose of a base whose camera looks along x. `up`: angle above the horizon [rad].
Se3 lookingAt(const Vector3d& eye, double yaw, double up, double roll) {
  return {Eigen::AngleAxisd(yaw, Vector3d::UnitZ()) * Eigen::AngleAxisd(-up, Vector3d::UnitY()) *
              Eigen::AngleAxisd(roll, Vector3d::UnitX()),
          eye};
}

Se3 lookingAt(const Vector3d& eye, const Vector3d& target, Random& random) {
  const Vector3d direction = target - eye;
  const double yaw = std::atan2(direction.y(), direction.x()),
               up = std::atan2(direction.z(), direction.head<2>().norm());
  return lookingAt(eye, yaw + random.uniform(-0.33, 0.33), up + random.uniform(-0.24, 0.24), random.gaussian(0.02));
}

}  // namespace

class SignPictures::Place {
 public:
  Place(const SignPictureOptions& options, int number)
      : options_(options), number_(static_cast<std::uint64_t>(number)), name_("place" + std::to_string(number)) {
    world_ = worldOf(options, number, Random(options.seed, {kPlaceStream, number_, options.style == "dark" ? 0u : 1u}));
    spots_ = addWallObjects(world_, Random(options.seed, {kPlaceStream, number_, 2}));
    scenes_ = std::make_unique<Scenes>(world_);
  }

  SignPicture picture(int k) const {
    Random random(options_.seed, {kViewStream, number_, static_cast<std::uint64_t>(k)});
    const Se3 begin = viewpoint(random);
    // The motion of a hand or a driving robot in a twentieth of a second.
    geometry::Vector6d motion;
    for (int i = 0; i < 3; ++i) motion[i] = random.gaussian(0.01);
    for (int i = 3; i < 6; ++i) motion[i] = random.gaussian(0.004);
    const Track track(Track::Kind::motion, {{0, begin}, {0.05, geometry::plus(begin, motion)}});
    SensorContext context;
    context.seed = options_.seed;
    context.number = static_cast<std::uint64_t>(k);
    context.duration = 1;
    context.world = &world_;
    context.scenes = scenes_.get();
    context.map_from_base = &track;
    const auto camera = makeSensor(base::Config::fromText(cameraIni(random), "sign pictures"), "camera", context);
    const Measurement measurement = camera->measure(0);
    SignPicture picture;
    picture.name = name_ + "_" + std::to_string(k);
    picture.image = dynamic_cast<const mrpt::obs::CObservationImage&>(*measurement.observation).image;
    const auto truth = nlohmann::json::parse(measurement.truth);
    for (const auto& sign : truth["signs"]) picture.signs.push_back(signOf(sign));
    return picture;
  }

 private:
  PicturedSign signOf(const nlohmann::json& json) const {
    PicturedSign sign;
    sign.name = name_ + "_" + json["name"].get<std::string>();
    for (const auto& line : json["lines"]) sign.text += (sign.text.empty() ? "" : "|") + line.get<std::string>();
    for (std::size_t i = 0; i < 4; ++i) {
      const auto& corner = json["corners"][i];
      sign.corners_px[i] = Eigen::Vector2f(corner[0].get<float>(), corner[1].get<float>());
    }
    sign.visible = json["visible"];
    return sign;
  }

  std::string cameraIni(Random& random) const {
    return "[camera]\nclass = ColourCamera\nfirst_s = 0.025\nwidth_px = " + std::to_string(options_.width) +
           "\nheight_px = " + std::to_string(options_.height) +
           "\nfocal_px = " + base::fixed(random.uniform(500, 720), 1) +
           "\ngain = " + base::fixed(random.uniform(0.45, 1.25), 3) +
           "\nexposure_s = " + base::fixed(random.uniform(0.001, 0.02), 4) +
           "\nnoise = " + base::fixed(random.uniform(0.005, 0.03), 4) +
           "\nvignetting = " + base::fixed(random.uniform(0, 0.4), 3) + "\n";
  }

  // A random pose that looks at a sign, at another object on a wall, or anywhere.
  Se3 viewpoint(Random& random) const {
    const Scene scene = scenes_->at(0);
    const double what = random.uniform();
    for (int attempt = 0; attempt < 60; ++attempt) {
      const bool of_sign = what < 0.6 && !world_.signs.empty();
      if (!of_sign && what > 0.85) break;
      const Se3& target =
          of_sign
              ? world_.signs[static_cast<std::size_t>(random.integer(0, static_cast<int>(world_.signs.size()) - 1))]
                    .map_from_sign
              : spots_[static_cast<std::size_t>(random.integer(0, static_cast<int>(spots_.size()) - 1))].map_from_spot;
      const double distance = 0.8 * std::pow(5.0, random.uniform()), aside = random.uniform(-1.0, 1.0);
      const Vector3d direction(std::sin(aside), 0, std::cos(aside));
      Vector3d eye = target * (distance * direction);
      eye.z() += random.uniform(-0.5, 0.2);
      const Vector3d from = target * Vector3d(0, 0, 0.03), to_eye = eye - from;
      if (!roomAt(world_.rooms, eye.head<2>())) continue;
      if (scene.cast(Ray{from, to_eye.normalized()}).range < to_eye.norm() + 0.1) continue;
      return lookingAt(eye, target.translation, random);
    }
    const auto eye = standpoint(world_, scene, random);
    return lookingAt(
        eye.value_or(Vector3d(world_.rooms[0].outline[0].x() + 0.5, world_.rooms[0].outline[0].y() + 0.5, 1.4)),
        random.uniform(-M_PI, M_PI), random.uniform(-0.2, 0.1), random.gaussian(0.02));
  }

  const SignPictureOptions& options_;
  std::uint64_t number_;
  std::string name_;
  World world_;
  std::vector<WallSpot> spots_;
  std::unique_ptr<Scenes> scenes_;
};

SignPictures::SignPictures(const SignPictureOptions& options) : options_(options) {
  for (int i = 0; i < options.places; ++i) places_.push_back(std::make_unique<Place>(options_, i));
}

SignPictures::~SignPictures() = default;

SignPicture SignPictures::picture(int k) const {
  return places_[static_cast<std::size_t>(k) % places_.size()]->picture(k);
}

}  // namespace omnimapper::testing

// The cost of a key frame in maps of 100, 200, 400 and 800 landmarks. The robot drives along a row of rooms with four
// walls each and back, with odometry and the lines of a laser. Prints a Markdown table, which doc/results/planes.md
// shows.
//
//   bench-landmark_cost
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/obs/CObservationLaserLines.h>
#include <omnimapper/testing/MapperRun.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <random>

namespace {

using namespace omnimapper;
using Eigen::Vector2d;
using geometry::Segment2;

const std::string kIni = R"(
[mapper]
pose_plugins        = odometry
measurement_plugins = walls
solve_every         = 10
solve_growth        = 0.02
[odometry]
class = OdometryPlugin
[walls]
class = PlaneLandmarksPlugin
form  = wall
)";

constexpr double kRoom = 4;  // [m]

/// The walls that are visible from a position in the corridor: those of its room, and one side of the doors ahead and
/// behind.
std::vector<Segment2> wallsAround(double x) {
  const double from = kRoom * std::floor(x / kRoom), to = from + kRoom;
  // Rooms alternate in width, so that no wall continues in the next room.
  const double half = std::fmod(from / kRoom, 2) == 0 ? 2.0 : 2.4;
  return {
      {{to, half}, {from, half}}, {{from, -half}, {to, -half}}, {{to, 0.6}, {to, half}}, {{from, half}, {from, 0.6}}};
}

class Drive {
 public:
  explicit Drive(unsigned seed) : random_(seed) {}

  std::vector<mrpt::obs::CObservation::Ptr> throughRooms(int rooms) {
    const double end = kRoom * rooms - 1;
    for (double x = 1; x < end; x += 0.5) step({x, 0, 0});
    for (double x = end; x > 1; x -= 0.5) step({x, 0, geometry::kPi});
    return std::move(log_);
  }

 private:
  double normal(double sigma) { return sigma * std::normal_distribution<double>()(random_); }

  void step(const geometry::Se2& truth) {
    const auto stamp = base::stampFromUnix(1e9 + static_cast<double>(log_.size()));
    if (!log_.empty()) {
      const geometry::Se2 moved = inverse(truth_) * truth;
      believed_ = plus(believed_ * moved, {normal(0.01), normal(0.01), normal(0.003)});
    }
    truth_ = truth;
    auto odometry = mrpt::obs::CObservationOdometry::Create();
    odometry->timestamp = stamp;
    odometry->sensorLabel = "odometry";
    odometry->odometry = mrpt::poses::CPose2D(believed_.x, believed_.y, believed_.yaw);
    log_.push_back(odometry);
    auto lines = std::make_shared<obs::CObservationLaserLines>();
    lines->timestamp = stamp;
    lines->sensorLabel = lines->source_label = "laser";
    for (const Segment2& wall : wallsAround(truth.x)) lines->lines.push_back(lineOf(wall));
    log_.push_back(lines);
  }

  obs::LaserLine lineOf(const Segment2& wall) {
    const geometry::Se2 base_from_map = inverse(truth_);
    const Vector2d shift(normal(0.005), normal(0.005));
    const Vector2d a = base_from_map * wall.from + shift, b = base_from_map * wall.to + shift;
    obs::LaserLine line;
    line.segment_in_sensor = {a, b};
    Vector2d out((b - a).normalized().y(), -(b - a).normalized().x());
    if (out.dot(a) < 0) out = -out;
    line.angle = std::atan2(out.y(), out.x());
    line.distance = out.dot(a);
    line.covariance = Vector2d(1e-5, 5e-5).asDiagonal();
    line.inliers = 50;
    return line;
  }

  std::mt19937 random_;
  geometry::Se2 truth_{1, 0, 0}, believed_{};
  std::vector<mrpt::obs::CObservation::Ptr> log_;
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures the cost of a key frame in maps of many landmarks.");
  unsigned seed = 1;
  std::vector<int> rooms_of_runs = {25, 50, 100, 200};
  app.add_option("--seed", seed);
  app.add_option("--rooms", rooms_of_runs, "number of rooms of each run; each has four landmarks");
  CLI11_PARSE(app, argc, argv);
  std::printf(
      "| rooms | landmarks | key frames | walls plugin | engine | solves | per key frame in all |\n"
      "|---|---|---|---|---|---|---|\n");
  for (const int rooms : rooms_of_runs) {
    const auto log = Drive(seed).throughRooms(rooms);
    const auto engine = testing::makeEngine(kIni, {"trigger.distance_m=0.3"});
    const mapper::StopWatch watch;
    testing::run(*engine, log);
    const double seconds = watch.seconds();
    const auto view = engine->view();
    std::size_t landmarks = 0;
    for (const auto& [id, landmark] : view.map.landmarks) landmarks += landmark.state == map::Landmark::State::active;
    const auto n = static_cast<double>(view.map.key_frames.size());
    const auto milliseconds = [&](const std::string& stage) {
      const auto found = view.times.totals().find(stage);
      return found == view.times.totals().end() ? 0 : 1e3 * found->second.seconds / n;
    };
    std::printf("| %d | %zu | %.0f | %.2f ms | %.2f ms | %.2f ms | %.2f ms |\n", rooms, landmarks, n,
                milliseconds("plugin walls"), milliseconds("engine"), milliseconds("solve"), 1e3 * seconds / n);
    std::fflush(stdout);
  }
}

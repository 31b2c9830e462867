// Motion between consecutive images of a depth camera by every kind of registration, against motion capture: the
// thesis's Table 8, with the methods of PCL (if bench-registration was built with PCL) and OpenCV in the same run.
// Prints a Markdown table. Times are processor times of one thread, without reading files. The guess of a pair is the
// motion that the same method found for the pair before, or no motion (--from-rest). With --simulated-pairs each pair
// is from another simulated place.
//
// Example: bench-registration --tum tum_fr1_rpy
//          bench-registration --rawlog out/home/home.rawlog --truth out/home/truth.tum
//          bench-registration --simulated-pairs 20 --place rawlogs/home_handheld.ini --only GICP
#include <omnimapper/base/Memory.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/matching/CloudMatcher.h>
#include <omnimapper/matching/CloudSource.h>
#include <omnimapper/matching/DenseMatcher.h>
#include <omnimapper/matching/FeatureMatcher.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/rgbd.hpp>

#include "RawlogFrames.h"
#include "RegistrationPeers.h"
#include "SimulatedPairs.h"
#include "Timing.h"
#include "WrittenPairs.h"

namespace {

using namespace omnimapper;
using namespace omnimapper::bench;
using geometry::Se3;
using matching::CloudMethod;
using matching::CloudSource;

camera::DepthImage depthOf(const RgbdFrame& frame) {
  return {frame.units.data(), frame.metres_per_unit, frame.width, frame.height, frame.camera};
}

camera::ColourImage colourOf(const RgbdFrame& frame) {
  return {frame.rgb.data(), frame.width, frame.height, 3 * frame.width, camera::ColourImage::Order::rgb};
}

RegistrationPeer clouds(const std::string& name, const std::string& row, CloudSource source, double voxel,
                        CloudMethod method) {
  matching::CloudSourceOptions from;
  from.source = source;
  from.voxel = voxel;
  matching::CloudMatcherOptions by;
  by.method = method;
  return {
      name, row, 1,
      [from, matcher = matching::IteratedClosestPoints(by)](const RgbdFrame& first, const RgbdFrame& second,
                                                            const Se3& guess) -> std::optional<Registered> {
        const auto cloud = [&from](const RgbdFrame& frame) {
          const auto colour = colourOf(frame);
          return matching::cloudOf(depthOf(frame), &colour, from);
        };
        const matching::MatchCloud target(cloud(first)), moved(cloud(second));
        const auto match = matcher.match(target, moved, guess);
        return match.succeeded ? std::optional(Registered{match.target_from_source, match.covariance}) : std::nullopt;
      }};
}

RegistrationPeer dense(const std::string& name, bool depth, bool grey) {
  matching::DenseMatcherOptions options;
  options.use_depth = depth;
  options.use_grey = grey;
  return {
      name, "dense", 1,
      [matcher = matching::DenseMatcher(options)](const RgbdFrame& first, const RgbdFrame& second,
                                                  const Se3& guess) -> std::optional<Registered> {
        const auto first_colour = colourOf(first), second_colour = colourOf(second);
        const matching::RgbdPyramid a(depthOf(first), &first_colour), b(depthOf(second), &second_colour);
        const auto reference = matcher.prepare(a);
        const auto match = matcher.match(*reference, b, {guess});
        return match.succeeded ? std::optional(Registered{match.reference_from_image, match.covariance}) : std::nullopt;
      }};
}

matching::RgbdPyramid pyramidOf(const RgbdFrame& frame) {
  const auto colour = colourOf(frame);
  return {depthOf(frame), &colour};
}

// Registration by corners alone, or by corners and then by the whole images, starting at the motion that the corners
// give.
RegistrationPeer features(const std::string& name, bool then_dense) {
  return {
      name, "SIFT", 1,
      [then_dense, by_corners = matching::FeatureMatcher(), by_all = matching::DenseMatcher()](
          const RgbdFrame& first, const RgbdFrame& second, const Se3&) -> std::optional<Registered> {
        const auto a = pyramidOf(first), b = pyramidOf(second);
        const auto coarse = by_corners.match(*by_corners.prepare(a), *by_corners.prepare(b));
        if (!coarse.succeeded) return std::nullopt;
        if (!then_dense) return Registered{coarse.reference_from_image, coarse.covariance};
        const auto fine = by_all.match(*by_all.prepare(a), b, {coarse.reference_from_image});
        return fine.succeeded ? std::optional(Registered{fine.reference_from_image, fine.covariance}) : std::nullopt;
      }};
}

cv::Mat greyOf(const RgbdFrame& frame) {
  const cv::Mat rgb(frame.height, frame.width, CV_8UC3, const_cast<std::uint8_t*>(frame.rgb.data()));
  cv::Mat grey;
  cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
  return grey;
}

cv::Mat metresOf(const RgbdFrame& frame) {
  const cv::Mat units(frame.height, frame.width, CV_16UC1, const_cast<std::uint16_t*>(frame.units.data()));
  cv::Mat metres;
  units.convertTo(metres, CV_32F, frame.metres_per_unit);
  metres.setTo(std::numeric_limits<float>::quiet_NaN(), units == 0);
  return metres;
}

Se3 toSe3(const cv::Mat& matrix) {
  Eigen::Matrix4d values;
  for (int r = 0; r < 4; ++r) {
    for (int c = 0; c < 4; ++c) values(r, c) = matrix.at<double>(r, c);
  }
  return {Eigen::Quaterniond(Eigen::Matrix3d(values.topLeftCorner<3, 3>())).normalized(),
          values.topRightCorner<3, 1>()};
}

RegistrationPeer openCvDense() {
  return {"OpenCV RgbdICPOdometry", "dense", 1, [](const RgbdFrame& first, const RgbdFrame& second, const Se3& guess) {
            const auto& c = first.camera;
            const cv::Mat camera = (cv::Mat_<float>(3, 3) << c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1);
            auto odometry = cv::rgbd::RgbdICPOdometry::create(camera);
            const auto frame = [](const RgbdFrame& given) {
              return cv::rgbd::OdometryFrame::create(greyOf(given), metresOf(given));
            };
            cv::Mat start = cv::Mat::eye(4, 4, CV_64F), found;
            const Eigen::Matrix3d rotation = guess.rotation.toRotationMatrix();
            for (int r = 0; r < 3; ++r) {
              for (int k = 0; k < 3; ++k) start.at<double>(r, k) = rotation(r, k);
              start.at<double>(r, 3) = guess.translation(r);
            }
            // OpenCV's result maps points of its first frame to its second one.
            auto from = frame(second), to = frame(first);
            return odometry->compute(from, to, found, start) && !found.empty()
                       ? std::optional(Registered{toSe3(found), {}})
                       : std::nullopt;
          }};
}

// The rigid motion of pairs of points, by least squares (Kabsch).
Se3 rigid(const std::vector<Eigen::Vector3d>& to, const std::vector<Eigen::Vector3d>& from) {
  Eigen::Map<const Eigen::Matrix3Xd> a(from.front().data(), 3, static_cast<Eigen::Index>(from.size())),
      b(to.front().data(), 3, static_cast<Eigen::Index>(to.size()));
  const Eigen::Matrix4d found = Eigen::umeyama(a, b, false);
  return {Eigen::Quaterniond(Eigen::Matrix3d(found.topLeftCorner<3, 3>())).normalized(), found.topRightCorner<3, 1>()};
}

// SIFT by OpenCV: nearest descriptors with Lowe's ratio test, then the motion by RANSAC over three pairs of points (3
// cm).
std::optional<Registered> bySift(const RgbdFrame& first, const RgbdFrame& second, const Se3&) {
  auto sift = cv::SIFT::create();
  std::vector<cv::KeyPoint> keys_a, keys_b;
  cv::Mat of_a, of_b;
  sift->detectAndCompute(greyOf(first), {}, keys_a, of_a);
  sift->detectAndCompute(greyOf(second), {}, keys_b, of_b);
  if (of_a.rows < 3 || of_b.rows < 3) return std::nullopt;
  std::vector<std::vector<cv::DMatch>> matches;
  cv::FlannBasedMatcher().knnMatch(of_b, of_a, matches, 2);
  const auto point = [](const RgbdFrame& frame, const cv::Point2f& at) {
    const int u = cvRound(at.x), v = cvRound(at.y);
    const double z = frame.units[static_cast<std::size_t>(v) * frame.width + u] * frame.metres_per_unit;
    return Eigen::Vector3d((at.x - frame.camera.cx) / frame.camera.fx * z,
                           (at.y - frame.camera.cy) / frame.camera.fy * z, z);
  };
  std::vector<Eigen::Vector3d> to, from;
  for (const auto& match : matches) {
    if (match.size() < 2 || match[0].distance > 0.8F * match[1].distance) continue;
    const auto a = point(first, keys_a[match[0].trainIdx].pt), b = point(second, keys_b[match[0].queryIdx].pt);
    if (a.z() <= 0 || b.z() <= 0) continue;
    to.push_back(a);
    from.push_back(b);
  }
  if (to.size() < 3) return std::nullopt;
  cv::RNG random(1);
  std::vector<std::size_t> best;
  for (int i = 0; i < 300; ++i) {
    std::vector<Eigen::Vector3d> some_to, some_from;
    for (int k = 0; k < 3; ++k) {
      const auto j = static_cast<std::size_t>(random.uniform(0, static_cast<int>(to.size())));
      some_to.push_back(to[j]);
      some_from.push_back(from[j]);
    }
    const Se3 motion = rigid(some_to, some_from);
    std::vector<std::size_t> inliers;
    for (std::size_t j = 0; j < to.size(); ++j) {
      if ((motion * from[j] - to[j]).norm() < 0.03) inliers.push_back(j);
    }
    if (inliers.size() > best.size()) best = std::move(inliers);
  }
  if (best.size() < 3) return std::nullopt;
  std::vector<Eigen::Vector3d> best_to, best_from;
  for (const auto j : best) best_to.push_back(to[j]), best_from.push_back(from[j]);
  return Registered{rigid(best_to, best_from), {}};
}

std::vector<RegistrationPeer> methods() {
  const auto edges = [](const std::string& row, CloudSource source) {
    return std::vector{clouds("ours, point to point", row, source, 0, CloudMethod::point_to_point),
                       clouds("ours, GICP", row, source, 0, CloudMethod::gicp)};
  };
  const auto points = [](const std::string& row, CloudSource source, double voxel) {
    return std::vector{clouds("ours, point to point", row, source, voxel, CloudMethod::point_to_point),
                       clouds("ours, point to plane", row, source, voxel, CloudMethod::point_to_plane),
                       clouds("ours, GICP", row, source, voxel, CloudMethod::gicp)};
  };
  std::vector<std::vector<RegistrationPeer>> rows{
      edges("occluding edges", CloudSource::occluding_edges),
      edges("RGB edges", CloudSource::rgb_edges),
      edges("high-curvature edges", CloudSource::high_curvature_edges),
      points("points, voxels of 2 cm", CloudSource::voxels, 0.02),
      points("points, voxels of 1 cm", CloudSource::voxels, 0.01),
      points("all points", CloudSource::all_points, 0),
      {features("ours, ORB", false),
       features("ours, ORB, then depth and brightness", true),
       {"OpenCV SIFT, RANSAC", "SIFT", 4, bySift}},
      {dense("ours, depth and brightness", true, true), dense("ours, depth", true, false),
       dense("ours, brightness", false, true), openCvDense()}};
  std::vector<RegistrationPeer> all;
  const auto pcl = pclRegistrations();
  for (auto& row : rows) {
    for (const auto& peer : pcl) {
      if (peer.row == row.front().row) row.push_back(peer);
    }
    all.insert(all.end(), row.begin(), row.end());
  }
  return all;
}

struct Errors {
  std::vector<double> position, angle, time;  // [mm] [deg] [ms]
  std::size_t failed = 0;
  std::vector<double> normalized;  // squared error in standard deviations, per degree of freedom
  void add(const Registered& estimate, const Se3& truth) {
    const auto off = geometry::minus(estimate.first_from_second, truth);
    if (estimate.covariance) normalized.push_back(off.dot(estimate.covariance->ldlt().solve(off)) / 6);
    position.push_back(1e3 * off.head<3>().norm());
    angle.push_back(off.tail<3>().norm() * 180 / M_PI);
  }
};

double rms(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v * v;
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, values.size())));
}

// `late`: delay [s] of the stamps of images after the exposure.
PosedFrames readTumPosed(const std::string& folder, const camera::Pinhole& camera, double late) {
  PosedFrames posed{readRgbd(folder, 1, camera), {}};
  const auto truth = eval::readTum(folder + "/groundtruth.txt");
  for (const auto& frame : posed.frames) {
    posed.poses.push_back(
        eval::interpolatedPose(truth, base::stampFromUnix(frame.stamp - late), base::durationFromSeconds(0.1)));
  }
  return posed;
}

PosedFrames thinned(const PosedFrames& all, std::size_t every) {
  PosedFrames some;
  for (std::size_t i = 0; i < all.frames.size(); i += every) {
    some.frames.push_back(all.frames[i]);
    some.poses.push_back(all.poses[i]);
  }
  return some;
}

// Which images are pairs: images i - 1 and i, for i = 1, 1 + step, ...
struct Pairing {
  bool is_all = false;        // slow methods use all pairs, too
  bool are_disjoint = false;  // each image belongs to one pair only
  bool from_rest = false;     // the guess is no motion
  std::size_t stepOf(const RegistrationPeer& method) const {
    return are_disjoint ? 2 : is_all ? 1 : static_cast<std::size_t>(method.every);
  }
};

Errors errorsOf(const RegistrationPeer& method, const PosedFrames& posed, const Pairing& pairing) {
  const auto& [frames, poses] = posed;
  const auto step = pairing.stepOf(method);
  Errors errors;
  Se3 guess;
  for (std::size_t i = 1; i < frames.size(); i += step) {
    const bool is_known = poses[i] && poses[i - 1];
    // A method that skips pairs has no result for the pair before. Its guess is the true motion of that pair.
    if (step > 1 && i > 1 && poses[i - 2] && poses[i - 1]) guess = inverse(*poses[i - 2]) * *poses[i - 1];
    if (pairing.from_rest) guess = {};
    const double begin = processorTime();
    const auto found = method.run(frames[i - 1], frames[i], guess);
    errors.time.push_back(processorTime() - begin);
    errors.failed += !found;
    // If the method fails, the guess counts as its result, and the next guess is no motion.
    const Registered taken = found.value_or(Registered{guess, {}});
    if (is_known) errors.add(taken, inverse(*poses[i - 1]) * *poses[i]);
    guess = found ? found->first_from_second : Se3{};
  }
  return errors;
}

void printRow(const RegistrationPeer& method, const Errors& errors) {
  const auto p = spreadOf(errors.position), a = spreadOf(errors.angle);
  std::printf("| %s | %s | %zu (%zu) | %.2f | %.2f ± %.2f | %.3f | %.3f ± %.3f | %.2f | %.2f | %s |\n",
              method.row.c_str(), method.name.c_str(), errors.position.size(), errors.failed, rms(errors.position),
              p.mean, p.deviation, rms(errors.angle), a.mean, a.deviation, quantile(errors.time, 0.5),
              quantile(errors.time, 0.95),
              errors.normalized.empty() ? "" : base::fixed(std::sqrt(spreadOf(errors.normalized).mean), 2).c_str());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::string tum, rawlog, truth, place = "rawlogs/home_handheld.ini", written, only;
  std::vector<double> camera{517.3, 516.5, 318.6, 255.3};
  double late = 0;
  int every = 1, simulated = 0;
  Pairing pairing;
  CLI::App app("Compares methods that estimate the motion between consecutive depth images.");
  app.add_option("--tum", tum, "folder of the TUM RGB-D benchmark, with depth, rgb and groundtruth.txt");
  app.add_option("--camera", camera, "fx fy cx cy of its camera [px]; the default is freiburg1's")->expected(4);
  app.add_option("--late", late,
                 "[s] delay of its stamps after the exposure; 0.025 to 0.03 for the depths of freiburg1");
  app.add_option("--rawlog", rawlog, "a rawlog, instead of --tum");
  app.add_option("--truth", truth, "TUM file with the true poses of the rawlog's base");
  app.add_option("--every", every, "use only every n-th frame")->check(CLI::PositiveNumber);
  app.add_option("--simulated-pairs", simulated,
                 "number of simulated pairs, instead of --tum or --rawlog: images that are 2 to 3 cm and 1 to 2 deg "
                 "apart, each pair in another place; the guess is no motion")
      ->check(CLI::PositiveNumber);
  app.add_option("--place", place,
                 "INI of the simulated places, whose seeds are 1, 2, ...; its first sensor must be an RgbdCamera")
      ->check(CLI::ExistingFile)
      ->capture_default_str();
  app.add_option("--only", only, "only methods whose row or name contains this text");
  app.add_flag("--all-pairs", pairing.is_all, "slow methods use all pairs, too");
  app.add_flag("--from-rest", pairing.from_rest, "the guess of each pair is no motion");
  app.add_option(
      "--write-pairs", written,
      "write the pairs to this folder for other programs and register none: N_first.pcd and N_second.pcd, "
      "binary x y z [m] in optical frames, and first_from_second at stamp N of truth.tum, N from 1 on; their "
      "guess is no motion, as by --from-rest");
  CLI11_PARSE(app, argc, argv);
  base::keepFreedMemory();  // as our programs do
  cv::setNumThreads(1);
  pairing.are_disjoint = simulated > 0;
  pairing.from_rest = pairing.from_rest || pairing.are_disjoint;
  const auto read = [&] {
    if (simulated > 0) return simulatedPairs(place, simulated);
    return thinned(rawlog.empty() ? readTumPosed(tum, {camera[0], camera[1], camera[2], camera[3]}, late)
                                  : readRawlog(rawlog, truth),
                   static_cast<std::size_t>(every));
  };
  const PosedFrames posed = read();
  if (!written.empty()) {
    writePairs(written, posed, pairing.are_disjoint ? 2 : 1);
    return 0;
  }
  std::printf(
      "%zu frames\n\n| points | method | pairs (failed) | position RMSE [mm] | mean ± s.d. | angle RMSE [deg] | mean ± "
      "s.d. | median [ms] | 95 %% | normalized error |\n|---|---|---|---|---|---|---|---|---|---|\n",
      posed.frames.size());
  for (const auto& method : methods()) {
    if (!only.empty() && (method.row + " " + method.name).find(only) == std::string::npos) continue;
    printRow(method, errorsOf(method, posed, pairing));
  }
}

// Motion of a hand-held depth camera, from one image to the next and along a whole recording of the TUM RGB-D
// benchmark, against its motion capture. Prints Markdown tables. Times are processor times of one thread, without
// reading files.
//
// Example: bench-visual_odometry --tum tum_fr1_rpy -o rpy.tum
//          omnimapper-eval ate rpy.tum tum_fr1_rpy/groundtruth.txt --align se3
#include <omnimapper/base/AtomicFile.h>
#include <omnimapper/base/Memory.h>
#include <omnimapper/eval/TumFile.h>
#include <omnimapper/geometry/TumLine.h>
#include <omnimapper/matching/RgbdTracker.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "RgbdFrames.h"
#include "Timing.h"

namespace {

using namespace omnimapper;
using namespace omnimapper::bench;
using geometry::Se3;

struct Recording {
  std::vector<RgbdFrame> frames;
  std::vector<std::optional<Se3>> truth;  // world_from_camera (optical frame)
};

Recording read(const std::string& folder, const camera::Pinhole& camera, int every) {
  Recording recording{readRgbd(folder, every, camera), {}};
  const auto truth = eval::readTum(folder + "/groundtruth.txt");
  for (const auto& frame : recording.frames)
    recording.truth.push_back(
        eval::interpolatedPose(truth, base::stampFromUnix(frame.stamp), base::durationFromSeconds(0.1)));
  return recording;
}

camera::DepthImage depthOf(const RgbdFrame& frame) {
  return {frame.units.data(), frame.metres_per_unit, frame.width, frame.height, frame.camera};
}

matching::RgbdPyramid pyramidOf(const RgbdFrame& frame) {
  const camera::ColourImage colour{frame.rgb.data(), frame.width, frame.height, 3 * frame.width,
                                   camera::ColourImage::Order::rgb};
  return {depthOf(frame), &colour};
}

struct Errors {
  std::vector<double> position, angle, time;  // [mm] [deg] [ms]
  void add(const Se3& estimate, const Se3& truth) {
    const auto off = geometry::minus(estimate, truth);
    position.push_back(1e3 * off.head<3>().norm());
    angle.push_back(off.tail<3>().norm() * 180 / M_PI);
  }
  void print(const std::string& name) const {
    const auto rms = [](const std::vector<double>& values) {
      double sum = 0;
      for (const double v : values) sum += v * v;
      return std::sqrt(sum / static_cast<double>(values.size()));
    };
    const auto p = spreadOf(position), a = spreadOf(angle);
    std::printf("| %s | %.2f | %.2f ± %.2f | %.3f | %.3f ± %.3f | %.2f | %.2f |\n", name.c_str(), rms(position), p.mean,
                p.deviation, rms(angle), a.mean, a.deviation, quantile(time, 0.5), quantile(time, 0.95));
  }
};

void pairs(const Recording& recording, const std::string& name, const matching::DenseMatcherOptions& options) {
  const matching::DenseMatcher matcher(options);
  Errors errors;
  geometry::Se3 velocity;
  for (std::size_t i = 1; i < recording.frames.size(); ++i) {
    const double begin = processorTime();
    const auto a = pyramidOf(recording.frames[i - 1]), b = pyramidOf(recording.frames[i]);
    const auto reference = matcher.prepare(a);
    const auto match = matcher.match(*reference, b, {velocity});
    velocity = match.reference_from_image;
    errors.time.push_back(processorTime() - begin);
    if (recording.truth[i] && recording.truth[i - 1])
      errors.add(match.reference_from_image, inverse(*recording.truth[i - 1]) * *recording.truth[i]);
  }
  errors.print(name);
}

void track(const Recording& recording, const std::string& output) {
  matching::RgbdTracker tracker({}, {});
  std::vector<double> times;
  std::size_t key_frames = 0, lost = 0;
  std::string trajectory;
  for (const auto& frame : recording.frames) {
    const double begin = processorTime();
    const auto tracked = tracker.track(base::stampFromUnix(frame.stamp), pyramidOf(frame));
    times.push_back(processorTime() - begin);
    key_frames += tracked.is_key_frame;
    lost += tracked.how == matching::RgbdTracker::Tracked::How::lost;
    trajectory += geometry::tumLine(base::stampFromUnix(frame.stamp), tracked.map_from_camera);
  }
  std::printf("\ntracked: %zu of %zu images lost, %zu key frames, median %.2f ms, 95 %% %.2f ms, largest %.2f ms\n",
              lost, times.size(), key_frames, quantile(times, 0.5), quantile(times, 0.95), quantile(times, 1));
  if (!output.empty()) base::writeFile(output, [&](std::ostream& out) { out << trajectory; });
}

}  // namespace

int main(int argc, char** argv) {
  std::string tum, output;
  std::vector<double> camera{517.3, 516.5, 318.6, 255.3};
  int every = 1;
  CLI::App app("Evaluates the estimated motion of a hand-held depth camera.");
  app.add_option("--tum", tum, "folder of the TUM RGB-D benchmark, with depth, rgb and groundtruth.txt")->required();
  app.add_option("--camera", camera, "fx fy cx cy [px]; the default is freiburg1's")->expected(4);
  app.add_option("--every", every, "use only every n-th of its frames")->check(CLI::PositiveNumber);
  app.add_option("-o,--output", output, "file for the trajectory of the camera's optical frame, which looks along z");
  CLI11_PARSE(app, argc, argv);
  base::keepFreedMemory();  // as our programs do
  const auto recording = read(tum, {camera[0], camera[1], camera[2], camera[3]}, every);
  std::printf(
      "%zu frames\n\n| method | position RMSE [mm] | mean ± s.d. | angle RMSE [deg] | mean ± s.d. | median [ms] | 95 "
      "%% |\n"
      "|---|---|---|---|---|---|---|\n",
      recording.frames.size());
  matching::DenseMatcherOptions both, depth, grey;
  depth.use_grey = false;
  grey.use_depth = false;
  pairs(recording, "dense, depth and brightness", both);
  pairs(recording, "dense, depth", depth);
  pairs(recording, "dense, brightness", grey);
  track(recording, output);
}

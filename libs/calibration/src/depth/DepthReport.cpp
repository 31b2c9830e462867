#include "DepthReport.h"

#include <omnimapper/base/Config.h>
#include <omnimapper/base/Numbers.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "../Outputs.h"

namespace omnimapper::calibration {

namespace {

using base::fixed;
using camera::DepthDistortion;

constexpr int kPartsAcross = 8, kPartsDown = 6;  // parts of the image for which a standard deviation is reported
constexpr double kSure = 5e-4;                   // [1/m] largest standard deviation that counts as small: 2 mm at 2 m

double middleOf(int part, int parts) {
  return (2.0 * part + 1) / parts - 1;
}

/// A summary over the parts of the image.
struct Overview {
  double largest = 0;          ///< [1/m] of the distortion
  double worst_sigma = 0;      ///< [1/m]
  double sure = 0;             ///< share of the parts with a small standard deviation
  std::vector<double> sigmas;  ///< [1/m] row by row
};

Overview overviewOf(const DistortionFit& fit) {
  Overview all;
  for (int row = 0; row < kPartsDown; ++row) {
    for (int column = 0; column < kPartsAcross; ++column) {
      const double x = middleOf(column, kPartsAcross), y = middleOf(row, kPartsDown);
      all.largest = std::max(all.largest, std::abs(fit.distortion.at(x, y)));
      all.sigmas.push_back(fit.sigmaAt(x, y));
      all.worst_sigma = std::max(all.worst_sigma, all.sigmas.back());
      all.sure += (all.sigmas.back() < kSure ? 1.0 : 0.0) / (kPartsAcross * kPartsDown);
    }
  }
  return all;
}

// Writes an error of inverse depth, and the errors that follow from it at depths of 1, 2 and 3 m.
void writeRow(std::ostream& out, const std::string& name, double per_metre) {
  out << "  " << std::left << std::setw(10) << name << std::right << std::setw(10) << fixed(1000 * per_metre, 2);
  for (const int metres : {1, 2, 3}) out << std::setw(9) << fixed(1000 * per_metre * metres * metres, 1);
  out << "\n";
}

// The INI's distortion plus the one that was found. The INI's distortion and then its scale were applied to the log's
// depths; the one that was found is of the depths after both.
std::vector<double> combined(const DepthCalibration& calibration, const DepthLog& log) {
  auto sum = calibration.fit.distortion.coefficients();
  for (double& one : sum) one *= log.ini_scale;
  // The coefficients of a lower degree are the first ones of a higher degree.
  sum.resize(std::max(sum.size(), log.ini_distortion.size()), 0);
  for (std::size_t i = 0; i < log.ini_distortion.size(); ++i) sum[i] += log.ini_distortion[i];
  return sum;
}

}  // namespace

std::string depthIni(const DepthCalibration& calibration, const DepthLog& log, const std::string& title) {
  std::ostringstream out;
  out << base::kWrittenFromALog << ", " << title << ", by omnimapper-calibrate; report.txt says how well.\n"
      << "; omnimapper-graphslam -i INI -i calibration.ini -r LOG -o FOLDER\n"
      << "[calibration]\n"
      << labelLine(log.label);
  for (const auto& [key, text] : log.ini_values) out << key << " = " << text << "\n";
  out << distortionLine(combined(calibration, log));
  return out.str();
}

std::string depthReport(const DepthCalibration& calibration, const DepthLog& log, const std::string& title) {
  const auto& c = calibration;
  const auto overview = overviewOf(c.fit);
  std::ostringstream out;
  out << "distortion of the depths of '" << log.label << "' from " << title << "\n"
      << base::counted(log.scans, "depth image") << ", of which " << c.images << " different ones were used and "
      << c.held_images << " of these held back\n"
      << base::counted(c.patches, "plane") << " in the others, " << c.held_patches << " in those held back, "
      << fixed(c.nearest, 1) << " to " << fixed(c.farthest, 1) << " m away\n"
      << "inverse depths are off by a polynomial of degree " << c.fit.distortion.degree() << " over the image, "
      << c.fit.distortion.coefficients().size()
      << " coefficients; planes\ndetermine neither its constant nor its slope, which are left out\n\n"
      << "                1/1000     mm at    mm at    mm at\n"
      << "                of 1/m       1 m      2 m      3 m\n";
  writeRow(out, "largest", overview.largest);
  writeRow(out, "rms", c.rms);
  writeRow(out, "halves", c.halves_differ_rms);
  out << "rms is over the image; \"halves\" is the rms difference between the estimates of the two halves of the log\n";
  out << "planes of held-back images, each fitted separately; rms over cells of " << c.cell_pixels << " x "
      << c.cell_pixels << " px\n";
  writeRow(out, "before", c.before.rms);
  writeRow(out, "after", c.after.rms);
  out << "  flatter in " << c.flatter_images << " of " << base::counted(c.before.rms_of_image.size(), "image") << "\n"
      << "standard deviation over the image, 1/1000 of 1/m; below " << fixed(1000 * kSure, 1) << " in "
      << fixed(100 * overview.sure, 0) << " % of it\n";
  for (int row = 0; row < kPartsDown; ++row) {
    out << " ";
    for (int column = 0; column < kPartsAcross; ++column)
      out << std::setw(7) << fixed(1000 * overview.sigmas[static_cast<std::size_t>(row * kPartsAcross + column)], 2);
    out << "\n";
  }
  out << "verdict: held-back planes are " << fixed(100 * (1 - c.after.rms / c.before.rms), 0)
      << " % flatter: calibration.ini has the distortion\n";
  return out.str();
}

std::string depthJson(const DepthCalibration& calibration, const DepthLog& log) {
  const auto& c = calibration;
  const auto overview = overviewOf(c.fit);
  nlohmann::ordered_json json;
  json["label"] = log.label;
  json["depth_images"] = log.scans;
  json["images"] = c.images;
  json["images_held_back"] = c.held_images;
  json["planes"] = c.patches;
  json["planes_held_back"] = c.held_patches;
  json["nearest_m"] = c.nearest;
  json["farthest_m"] = c.farthest;
  json["degree"] = c.fit.distortion.degree();
  json["coefficients_per_m"] = c.fit.distortion.coefficients();
  for (Eigen::Index i = 0; i < c.fit.covariance.rows(); ++i)
    json["sigmas_per_m"].push_back(std::sqrt(std::max(0.0, c.fit.covariance(i, i))));
  json["largest_per_m"] = overview.largest;
  json["rms_per_m"] = c.rms;
  json["halves_differ_rms_per_m"] = c.halves_differ_rms;
  json["sigma_by_part_per_m"] = overview.sigmas;
  json["sure_share"] = overview.sure;
  json["held_back_before_rms_per_m"] = c.before.rms;
  json["held_back_after_rms_per_m"] = c.after.rms;
  json["held_back_images_with_planes"] = c.before.rms_of_image.size();
  json["held_back_images_flatter"] = c.flatter_images;
  return json.dump(2) + "\n";
}

std::vector<std::string> depthWarnings(const DepthCalibration& calibration, const DepthLog& log) {
  std::vector<std::string> all;
  if (!log.report.message.empty()) all.push_back(log.report.message);
  for (auto& sentence : log.report.unusableText()) all.push_back(std::move(sentence));
  if (log.left_out > 0)
    all.push_back(base::counted(log.left_out, "depth image") + " left out, the first because " + log.why_left_out);
  constexpr double kOneDepth = 1.5, kUnsure = 2e-3;  // [-] [1/m]
  if (calibration.farthest < kOneDepth * calibration.nearest)
    all.push_back(
        "all planes are " + fixed(calibration.nearest, 1) + " to " + fixed(calibration.farthest, 1) +
        " m away, so it is not tested whether the error grows with the square of the depth: record planes from "
        "near and far");
  // The standard deviation of each half is sqrt(2) times that of the whole, so half of their difference is about the
  // error of the whole.
  constexpr double kMuch = 2.0 / 3;
  if (calibration.halves_differ_rms > kMuch * calibration.rms)
    all.push_back("the two halves of the log give distortions that differ by " +
                  fixed(1000 * calibration.halves_differ_rms, 1) + " of " + fixed(1000 * calibration.rms, 1) +
                  " in 1/1000 of 1/m, so the correction may be wrong by a third or more: record longer, and more "
                  "planes in every part of the image");
  if (overviewOf(calibration.fit).worst_sigma > kUnsure)
    all.push_back(
        "in a part of the image the distortion is hardly known (report.txt shows where): record planes that "
        "fill the image");
  return all;
}

}  // namespace omnimapper::calibration

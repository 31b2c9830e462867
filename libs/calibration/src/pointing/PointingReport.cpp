#include "PointingReport.h"

#include <omnimapper/base/Names.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/draw/Markup.h>
#include <omnimapper/draw/Svg.h>

#include <cmath>
#include <map>
#include <set>

namespace omnimapper::calibration {

namespace {

using interaction::AngleError;
using interaction::PointingSample;

std::string degrees(double angle) {
  return base::fixed(angle * 180 / M_PI, 1);
}

std::string cell(const AngleError& error, const AngleError& known) {
  return degrees(error.mean) + " (" + degrees(known.mean) + ") " + degrees(error.sigma);
}

void drawRay(draw::Svg& svg, const std::vector<PointingSample>& samples,
             const std::map<std::string, std::string>& colours, interaction::PointingError PointingSample::*ray,
             double left, const std::string& name) {
  constexpr double kMost = 45;  // [deg]
  const auto axes = draw::Axes::withEqualScale({left, 40}, {360, 360}, {-kMost, -kMost}, {kMost, kMost});
  axes.draw(svg, name + ": theta [deg]", "psi [deg]");
  for (const PointingSample& sample : samples) {
    const auto& error = sample.*ray;
    const Eigen::Vector2d at = Eigen::Vector2d(error.theta, error.psi) * 180 / M_PI;
    if (at.cwiseAbs().maxCoeff() <= kMost) svg.dot(axes.pixel(at), 1.5, colours.at(sample.person));
  }
}

}  // namespace

std::string pointingReport(const interaction::PointingFit& fit, std::size_t frames, const std::string& title) {
  std::string text = title + ": " + base::counted(frames, "frame") + " of " +
                     base::counted(fit.targets.size(), "target") +
                     "\nmean (standard deviation of the mean, by the people) and sigma [deg]\n"
                     "target: elbow-hand theta | psi | head-hand theta | psi\n";
  for (std::size_t i = 0; i < fit.targets.size(); ++i) {
    const auto& row = fit.model.rows[i];
    const auto& known = fit.targets[i];
    text += base::printable(row.target) + " (" + std::to_string(known.people) +
            (known.people == 1 ? " person, " : " people, ") + base::counted(known.frames, "frame") +
            "): " + cell(row.elbow_hand.theta, known.elbow_hand.theta) + " | " +
            cell(row.elbow_hand.psi, known.elbow_hand.psi) + " | " + cell(row.head_hand.theta, known.head_hand.theta) +
            " | " + cell(row.head_hand.psi, known.head_hand.psi) + "\n";
  }
  return text + "correlation of both rays: theta " + base::fixed(fit.model.theta_correlation, 2) + ", psi " +
         base::fixed(fit.model.psi_correlation, 2) + "\n";
}

std::vector<std::string> pointingWarnings(const interaction::PointingFit& fit) {
  constexpr std::size_t kFewest = 3;
  std::vector<std::string> warnings;
  for (const auto& target : fit.targets) {
    if (target.people < kFewest)
      warnings.push_back("at '" + base::printable(target.target) + "' point only " + std::to_string(target.people) +
                         ": sigma says little of others");
  }
  return warnings;
}

void drawPointing(const std::vector<PointingSample>& samples, std::ostream& out) {
  std::map<std::string, std::string> colours;
  for (const PointingSample& sample : samples) colours[sample.person];
  double share = 0;
  for (auto& [person, colour] : colours) {
    colour = draw::heatColour(share / static_cast<double>(colours.size()));
    ++share;
  }
  draw::Svg svg(out, 1020, 460);
  drawRay(svg, samples, colours, &PointingSample::elbow_hand, 70, "elbow-hand");
  drawRay(svg, samples, colours, &PointingSample::head_hand, 500, "head-hand");
  double y = 60;
  for (const auto& [person, colour] : colours) {
    svg.dot({890, y - 4}, 4, colour);
    svg.text({900, y}, base::printable(person).substr(0, 16), draw::Svg::Anchor::start);
    y += 18;
  }
}

}  // namespace omnimapper::calibration

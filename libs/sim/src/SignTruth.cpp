#include "SignTruth.h"

#include <omnimapper/base/CsvTable.h>
#include <omnimapper/base/Numbers.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::sim {

namespace {

std::string textOf(const Sign& sign) {
  std::string text;
  for (const std::string& line : sign.lines) text += (text.empty() ? "" : "|") + line;
  return text;
}

std::string row(const Sensor& sensor, int k, const Sign& sign, const SignView& view) {
  std::string text = base::formatUnix(sensor.stampOf(k)) + "," + base::csvField(sensor.label()) + "," +
                     std::to_string(k) + "," + base::csvField(sign.name) + "," + base::csvField(textOf(sign));
  for (const Eigen::Vector2d& corner : view.corners)
    text += "," + base::fixed(corner.x(), 2) + "," + base::fixed(corner.y(), 2);
  for (const double value : {view.capitals, view.least_capitals, view.distance, view.incidence * 180 / M_PI})
    text += "," + base::fixed(value, 3);
  return text + "," + base::fixed(view.visible, 2) + (isLegible(view) ? ",1\n" : ",0\n");
}

}  // namespace

SignTruth::SignTruth(const Simulation& simulation)
    : world_(simulation.world()),
      is_wanted_(!world_.signs.empty() &&
                 std::any_of(simulation.sensors().begin(), simulation.sensors().end(),
                             [](const auto& sensor) { return sensor->pictureView(0).has_value(); })),
      counter_(world_.signs.size()),
      table_(
          "stamp,sensor,measurement,sign,text,x1,y1,x2,y2,x3,y3,x4,y4,capitals_px,least_capitals_px,distance_m,"
          "incidence_deg,visible,legible\n") {}

void SignTruth::add(const Sensor& sensor, int k, const std::vector<SignView>& signs) {
  counter_.add(sensor.timeOf(k), signs);
  for (const SignView& view : signs) table_ += row(sensor, k, world_.signs[static_cast<std::size_t>(view.sign)], view);
}

}  // namespace omnimapper::sim

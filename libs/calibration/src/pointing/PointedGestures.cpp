#include "PointedGestures.h"

#include <omnimapper/base/CsvTable.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Names.h>

#include <map>

namespace omnimapper::calibration {

namespace {

base::Stamp stampIn(const base::CsvTable& table, std::size_t row, const std::string& column) {
  const std::string& text = table.text(row, column);
  try {
    const auto stamp = base::parseUnix(text);
    if (base::isValid(stamp)) return stamp;
  } catch (const base::Error&) {
  }
  table.refuse(row, column + " is '" + base::printable(text) + "', which is no Unix time");
}

PointedGesture gestureIn(const base::CsvTable& table, std::size_t row) {
  PointedGesture gesture;
  gesture.person = table.text(row, "person");
  gesture.target = table.text(row, "target");
  if (gesture.person.empty() || gesture.target.empty()) table.refuse(row, "person and target need a name");
  gesture.target_in_base = {table.number(row, "x_m"), table.number(row, "y_m"), table.number(row, "z_m")};
  gesture.begin = stampIn(table, row, "begin_s");
  if (table.has("end_s") && !table.text(row, "end_s").empty()) {
    gesture.end = stampIn(table, row, "end_s");
    if (gesture.end <= gesture.begin) table.refuse(row, "end_s is not after begin_s");
  }
  const std::string arm = table.has("arm") ? table.text(row, "arm") : "";
  if (!arm.empty() && arm != "right" && arm != "left")
    table.refuse(row, "arm is '" + base::printable(arm) + "'; it is right or left");
  gesture.is_right_arm = arm != "left";
  return gesture;
}

}  // namespace

std::vector<PointedGesture> readPointedGestures(const std::string& path) {
  constexpr double kOnePlace = 1;  // [m]
  const base::CsvTable table(path, "table of gestures");
  std::vector<PointedGesture> gestures;
  std::map<std::string, Eigen::Vector3d> places;
  for (std::size_t row = 0; row < table.size(); ++row) {
    gestures.push_back(gestureIn(table, row));
    const PointedGesture& gesture = gestures.back();
    const Eigen::Vector3d& place = places.emplace(gesture.target, gesture.target_in_base).first->second;
    if ((place - gesture.target_in_base).norm() > kOnePlace)
      table.refuse(row, "the target '" + base::printable(gesture.target) +
                            "' is more than 1 m from where an earlier line has it; targets at other places need other "
                            "names");
  }
  if (gestures.empty())
    throw base::Error(base::ExitCode::unreadable_input,
                      path +
                          ": the table of gestures has no row; each gesture is a row under "
                          "person,target,x_m,y_m,z_m,begin_s");
  return gestures;
}

}  // namespace omnimapper::calibration

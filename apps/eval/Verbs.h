#pragma once

#include <string>
#include <vector>

namespace omnimapper::evaluation {

struct Arguments {
  std::string estimate, reference, output_folder, json_file;
  double tolerance = 0.01, interpolate = 0;          // [s]
  std::vector<double> base_from_sensor = {0, 0, 0};  // x y [m] yaw [deg]
  std::string alignment = "none", unit = "frames";
  double delta = 1;
  std::string log;          // log of the verb views
  std::size_t views = 200;  // largest number of views
};

/// Prints and writes the result of the verb; returns the exit code.
int run(const std::string& verb, const Arguments& arguments);

/// The verbs map and views: compare the surfaces of a map with the true ones, and with the depth images of a log.
int judgeMap(const Arguments& arguments);
int judgeByViews(const Arguments& arguments);

}  // namespace omnimapper::evaluation

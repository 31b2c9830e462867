// to-csv IN OUT.csv: writes the odometry and the scans of a log, of any format that OmniMapper reads, as the log of
// this example.
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/source/openLogs.h>

#include <fstream>
#include <iostream>
#include <limits>

namespace {

void write(const mrpt::obs::CObservation& observation, std::ostream& out) {
  const auto stamp = omnimapper::base::formatUnix(observation.timestamp, 7);
  if (const auto* odometry = dynamic_cast<const mrpt::obs::CObservationOdometry*>(&observation)) {
    const auto& pose = odometry->odometry;
    out << "odom," << stamp << ',' << pose.x() << ',' << pose.y() << ',' << pose.phi() << '\n';
  } else if (const auto* scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan*>(&observation)) {
    out << "scan," << stamp << ',' << scan->aperture;
    for (std::size_t i = 0; i < scan->getScanSize(); ++i)
      out << ',' << (scan->getScanRangeValidity(i) ? scan->getScanRange(i) : 0.F);
    out << '\n';
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: to-csv IN OUT.csv\n";
    return 2;
  }
  try {
    const auto log = omnimapper::source::openLogs({argv[1]}, {});
    std::ofstream out(argv[2]);
    out.precision(std::numeric_limits<double>::max_digits10);
    out << "csv_log 1\n";
    while (const auto observation = log->next()) write(*observation, out);
    return out.flush() ? 0 : 1;
  } catch (const omnimapper::base::Error& error) {
    std::cerr << "to-csv: " << error.what() << "\n";
    return static_cast<int>(error.code());
  }
}

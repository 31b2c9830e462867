// tag-log OUT.rawlog STAMP NAME [STAMP NAME ...]: writes the log of a reader of RFID tags that reads a tag with that
// name at each Unix time.
#include <mrpt/obs/CObservationRFID.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/source/RawlogWriter.h>

#include <iostream>
#include <string>
#include <vector>

namespace {

void writeReadings(const std::string& path, const std::vector<std::string>& stamps_and_names) {
  omnimapper::source::writeRawlog(path, [&](omnimapper::source::RawlogWriter& log) {
    for (std::size_t i = 0; i < stamps_and_names.size(); i += 2) {
      mrpt::obs::CObservationRFID read;
      read.sensorLabel = "tags";
      read.timestamp = omnimapper::base::parseUnix(stamps_and_names[i]);
      read.tag_readings.push_back({-50, stamps_and_names[i + 1], ""});
      log.add(read);
    }
  });
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4 || argc % 2 != 0) {
    std::cerr << "usage: tag-log OUT.rawlog STAMP NAME [STAMP NAME ...]\n";
    return 2;
  }
  try {
    writeReadings(argv[1], {argv + 2, argv + argc});
  } catch (const omnimapper::base::Error& error) {
    std::cerr << "tag-log: " << error.what() << "\n";
    return static_cast<int>(error.code());
  }
}

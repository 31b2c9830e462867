#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/source/ImageSettings.h>

#include <string>
#include <vector>

namespace omnimapper::live {

/// Section [live] of an INI file: which drivers a run reads, and how it records their data.
struct LiveOptions {
  std::vector<std::string> sensors;    ///< names of the drivers' sections
  std::string grabber;                 ///< an INI of rawlog-grabber whose sensors are read, too
  std::vector<std::string> libraries;  ///< shared libraries that register drivers
  bool record = true;
  source::ColourImages images = source::ColourImages::lossless;
  int compression = 1;            ///< level of zlib
  double split_mb = 2000;         ///< [MB] size of a rawlog at which the next one is begun; 0: never
  double queue_mb = 256;          ///< [MB] size of the write buffer; when it is full, camera frames are discarded
  int camera_queue = 3;           ///< largest number of frames of one camera that wait for the mapper
  double silent_after = 0.8;      ///< [s] without data after which a sensor counts as silent
  double reopen_after = 3;        ///< [s] without data after which a sensor is reopened
  double max_clock_offset = 0.5;  ///< [s] largest difference between stamp and arrival if both are by the same clock
  double checkpoint = 60;         ///< [s] between two checkpoints; 0: none
  double check = 10;              ///< [s] that --check --live records

  static const base::OptionTable<LiveOptions>& table();
};

}  // namespace omnimapper::live

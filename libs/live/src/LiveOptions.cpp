#include <omnimapper/live/LiveOptions.h>

namespace omnimapper::live {

const base::OptionTable<LiveOptions>& LiveOptions::table() {
  using base::Range;
  static const auto table =
      base::OptionTable<LiveOptions>()
          .list("sensors", &LiveOptions::sensors,
                "Sections of the sensors that --live reads, in the order in which they are opened. Each names an MRPT "
                "driver (driver = CHokuyoURG) and has that driver's own keys.")
          .text("grabber", &LiveOptions::grabber,
                "An INI of MRPT's rawlog-grabber, whose sensors are read as they stand there; a relative path "
                "counts from the folder of the first INI.")
          .list("libraries", &LiveOptions::libraries,
                "Shared libraries that register drivers (classes of mrpt::hwdrivers::CGenericSensor) when they are "
                "loaded.")
          .flag("record", &LiveOptions::record,
                "Writes what the sensors say into rawlogs in the folder recording of the output folder, with a journal "
                "from which --replay makes the same map again.")
          .choice("images", &LiveOptions::images,
                  {{"lossless", source::ColourImages::lossless}, {"jpeg", source::ColourImages::jpeg}},
                  "How colour images are recorded. The mapper sees what was recorded: with jpeg that of quality 95.")
          .integer("compression", &LiveOptions::compression, Range{0, 9},
                   "Compression level of the recording by zlib: 0 none, 1 the fastest, 9 the smallest files.")
          .number("split_mb", &LiveOptions::split_mb, Range::notNegative(),
                  "Size of a file on the disk at which a new rawlog is begun; 0 never splits a recording.")
          .number("queue_mb", &LiveOptions::queue_mb, Range::positive(),
                  "Size of the write buffer. When it is full because the disk is too slow, frames of cameras are "
                  "discarded, neither recorded nor mapped, and counted.")
          .integer(
              "camera_queue", &LiveOptions::camera_queue, Range{1, 1000},
              "Frames of one camera that wait for the mapper; of more than that the oldest is left out of the map, "
              "and counted. It stays in the recording. Lasers and odometry are never left out.")
          .number("silent_after_s", &LiveOptions::silent_after, Range::positive(),
                  "A sensor is reported as silent after this time without data, or after twice the longest of its last "
                  "ten intervals if that is longer.")
          .number("reopen_after_s", &LiveOptions::reopen_after, Range::positive(),
                  "A sensor is closed and opened again, until it answers, after this time without data, or after three "
                  "times the longest of its last ten intervals if that is longer.")
          .number("max_clock_off_s", &LiveOptions::max_clock_off, Range::positive(),
                  "Largest difference between a stamp and its arrival that still counts as the same clock; beyond it "
                  "the offset of the sensor's clock is estimated, and again where it jumps.")
          .number("checkpoint_s", &LiveOptions::checkpoint, Range::notNegative(),
                  "Time between two checkpoints of the map, checkpoint.omnimap in the output folder, which stays there "
                  "if the run is killed; 0 writes none.")
          .number("check_s", &LiveOptions::check, Range::positive(),
                  "Time for which --check --live reads the sensors before it judges what they sent.");
  return table;
}

}  // namespace omnimapper::live

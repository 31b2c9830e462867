#include <omnimapper/live/LiveOptions.h>

namespace omnimapper::live {

const base::OptionTable<LiveOptions>& LiveOptions::table() {
  using base::Range;
  static const auto table =
      base::OptionTable<LiveOptions>()
          .list("sensors", &LiveOptions::sensors,
                "INI sections of the sensors that --live reads, in the order in which they are opened. Each section "
                "names an MRPT driver, such as driver = CHokuyoURG, and has that driver's own keys.")
          .text("grabber", &LiveOptions::grabber,
                "INI file for MRPT's program rawlog-grabber; its sensor sections are used unchanged. A relative path "
                "starts at the folder of the INI that has this key or, if there is no such file, at the folder of the "
                "first INI.")
          .list("libraries", &LiveOptions::libraries,
                "Shared libraries that register drivers (classes of mrpt::hwdrivers::CGenericSensor) when they are "
                "loaded.")
          .flag("record", &LiveOptions::record,
                "Records the sensor data as rawlogs in the folder recording of the output folder, with a journal "
                "from which --replay makes the same map again.")
          .choice("images", &LiveOptions::images,
                  {{"lossless", source::ColourImages::lossless}, {"jpeg", source::ColourImages::jpeg}},
                  "How colour images are recorded: lossless, or as JPEG at quality 95. The mapper gets the images as "
                  "they are recorded.")
          .integer("compression", &LiveOptions::compression, Range{0, 9},
                   "zlib compression level of the recording: 0 for none, 1 for the fastest, 9 for the smallest "
                   "files.")
          .number("split_mb", &LiveOptions::split_mb, Range::notNegative(),
                  "Size of a rawlog on the disk at which a new one is begun; 0 never splits a recording.")
          .number("queue_mb", &LiveOptions::queue_mb, Range::positive(),
                  "Size of the buffer for data that wait to be written to the disk. While it is full, because the disk "
                  "is too slow, images are neither recorded nor mapped; their number is reported.")
          .integer("camera_queue", &LiveOptions::camera_queue, Range{1, 1000},
                   "Largest number of images of one camera that wait for the mapper. If another image comes, the "
                   "oldest one is still recorded, but left out of the map; the number of such images is reported. Data "
                   "of lasers and odometry are never left out.")
          .number("silent_after_s", &LiveOptions::silent_after, Range::positive(),
                  "A sensor is reported as silent if it sends no data for this time, or for twice the longest of its "
                  "last ten intervals between data, whichever is longer.")
          .number("reopen_after_s", &LiveOptions::reopen_after, Range::positive(),
                  "A sensor is closed and opened again until it answers if it sends no data for this time, or for "
                  "three times the longest of its last ten intervals between data, whichever is longer.")
          .number("max_clock_offset_s", &LiveOptions::max_clock_offset, Range::positive(),
                  "Largest difference between an observation's stamp and its arrival at which the stamp is used as it "
                  "is. If the difference is larger, the offset of the sensor's clock is estimated; it is estimated "
                  "again when it changes abruptly.")
          .number("checkpoint_s", &LiveOptions::checkpoint, Range::notNegative(),
                  "Time between two checkpoints. A checkpoint is a copy of the growing map, the file "
                  "checkpoint.omnimap in the output folder; it remains if the run is killed. 0 writes none.")
          .number("check_s", &LiveOptions::check, Range::positive(),
                  "Time for which --check --live reads the sensors before it judges what they sent.");
  return table;
}

}  // namespace omnimapper::live

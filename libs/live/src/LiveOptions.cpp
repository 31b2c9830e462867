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
                "An INI of MRPT's rawlog-grabber, whose sensors are read as they stand there; its path counts from the "
                "folder of the INI that names it.")
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
                   "How hard the recording is compressed: 0 not at all, 1 fast, 9 small.")
          .number("split_mb", &LiveOptions::split_mb, Range::notNegative(),
                  "Size on the disk from which on a recording goes on in another rawlog; 0 never splits it.")
          .number("queue_mb", &LiveOptions::queue_mb, Range::positive(),
                  "Memory for what waits to be written. Where the disk is slower than the cameras for longer, their "
                  "frames are left out of the recording and of the map, and counted.")
          .integer(
              "camera_queue", &LiveOptions::camera_queue, Range{1, 1000},
              "Frames of one camera that wait for the mapper; of more than that the oldest is left out of the map, "
              "and counted. It stays in the recording. Lasers and odometry are never left out.")
          .number("silent_after_s", &LiveOptions::silent_after, Range::positive(),
                  "A sensor that has sent nothing for so long, and for twice as long as its last ten observations were "
                  "apart, "
                  "is said to be silent.")
          .number("reopen_after_s", &LiveOptions::reopen_after, Range::positive(),
                  "A sensor that has sent nothing for so long, and for three times as long as its last ten "
                  "observations were "
                  "apart, is closed and opened again, until it answers.")
          .number("max_clock_off_s", &LiveOptions::max_clock_off, Range::positive(),
                  "Stamps that are farther from the time of their arrival are by another clock, whose offset is "
                  "estimated, and again where it jumps.")
          .number("checkpoint_s", &LiveOptions::checkpoint, Range::notNegative(),
                  "Time between two checkpoints of the map, checkpoint.omnimap in the output folder, which stays there "
                  "if the run is killed; 0 writes none.");
  return table;
}

}  // namespace omnimapper::live

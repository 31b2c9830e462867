#include "RosLogOptions.h"

namespace omnimapper::ros {

const base::OptionTable<RosLogOptions>& RosLogOptions::table() {
  using Options = RosLogOptions;
  static const auto table =
      base::OptionTable<Options>()
          .list("topics", &Options::topics,
                "Topics to read; empty: all whose types are known. Transforms (tf, tf_static) are always read.")
          .list("labels", &Options::labels,
                "Sensor labels, as /topic=label. A topic that is not listed is labelled with its name, without the "
                "first slash.")
          .text("base_frame", &Options::base_frame,
                "Frame of the robot's base. Empty: the child frame of the odometry, else base_footprint, base_link or "
                "base, whichever the transforms have, else the root of the transforms of the first sensor.")
          .text("odometry", &Options::odometry,
                "automatic: of the topics of Odometry in a frame that is not map, the one with most messages; without "
                "one, tf. tf: the transform that moves the base. none: no odometry. Or the name of a topic.")
          .choice<StampsOf>("stamps", &Options::stamps,
                            {{"header", StampsOf::header}, {"recorded", StampsOf::recorded}},
                            "Time of an observation: header: when it was measured, as its header says; recorded: when "
                            "it was recorded. Headers of a topic whose clock differs by more than 1 s from that of the "
                            "first laser or camera are moved by the difference.")
          .list("pose_topics", &Options::pose_topics,
                "Topics of PoseStamped, PoseWithCovarianceStamped or Odometry whose poses are given to the mapper as "
                "poses of the base. By default such poses are left out.")
          .text("truth_topic", &Options::truth_topic,
                "Topic of PoseStamped, PoseWithCovarianceStamped or Odometry whose poses are the true ones, which "
                "omnimapper-import writes beside its rawlog.");
  return table;
}

}  // namespace omnimapper::ros

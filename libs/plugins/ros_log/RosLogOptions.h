#pragma once

#include <omnimapper/base/OptionTable.h>

#include <string>
#include <vector>

namespace omnimapper::ros {

enum class StampsOf {
  header,    ///< when the sensor measured, as the header of the message says
  recorded,  ///< when the message was recorded
};

struct RosLogOptions {
  std::vector<std::string> topics;     ///< to read; empty: all whose types are known
  std::vector<std::string> labels;     ///< "TOPIC=LABEL"; a topic without one is labelled with its name
  std::string base_frame;              ///< empty: found in the log
  std::string odometry = "automatic";  ///< automatic, none, tf, or a topic
  StampsOf stamps = StampsOf::header;
  std::vector<std::string> pose_topics;  ///< topics whose poses are given to the mapper
  std::string truth_topic;               ///< topic whose poses are the truth; empty: none
  static const base::OptionTable<RosLogOptions>& table();
};

}  // namespace omnimapper::ros

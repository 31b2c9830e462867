#pragma once

#include <omnimapper/base/OptionTable.h>
#include <omnimapper/source/ObservationSource.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace omnimapper::source {

/// The span of time that an action of MRPT's action / sensory-frame format covers.
enum class ActionSpan {
  automatic,  ///< `own` if the first actions have stamps, else `frames`
  frames,     ///< from the stamp of the frame before the action to the stamp of the frame after it
  own,        ///< from the stamp of the previous action, or of the first frame, to the action's own stamp
};

/// Time from which start_s and end_s are counted.
enum class TimeReference {
  log_start,  ///< the first stamp of the earliest log
  unix_epoch  ///< 1970
};

/// Opens a log of one format at a path. Throws Error(unreadable_input) if it is no such log.
using OpenLog = std::function<std::unique_ptr<ObservationSource>(const std::string& path)>;

/// Section [source] of an INI file.
struct SourceOptions {
  std::vector<std::string> formats;  ///< formats that a log may have; empty: all that are known
  std::vector<std::string> labels;   ///< sensor labels to hand out; empty: all
  double start = 0;                  ///< [s] observations before this time are left out
  double end = 0;                    ///< [s] observations after this time are left out; 0: none are left out
  TimeReference time_reference = TimeReference::log_start;
  double step = 0;  ///< [s] time between the steps of a log whose stamps stand still; 0: the log's own stamps
  ActionSpan action_span = ActionSpan::automatic;
  std::string action_label = "odometry";  ///< label of the motions that actions become
  std::string images_folder;              ///< empty: <rawlog without extension>_Images beside the rawlog

  /// Time [s] to add to all stamps of a sensor, by label; no key of [source], because it belongs to the sensor. The
  /// sensors are then sorted by their corrected stamps, for which the log is read once more for each different offset.
  std::map<std::string, double> clock_offsets;

  /// What opens logs with the options of [source_FORMAT], by format; no key of [source]. A registered format that is
  /// not here has its default options.
  std::map<std::string, OpenLog> openers;

  static const base::OptionTable<SourceOptions>& table();
};

}  // namespace omnimapper::source

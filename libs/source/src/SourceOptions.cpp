#include <omnimapper/source/SourceOptions.h>

namespace omnimapper::source {

const base::OptionTable<SourceOptions>& SourceOptions::table() {
  static const auto table =
      base::OptionTable<SourceOptions>()
          .list(
              "formats", &SourceOptions::formats,
              "Formats that a log may have: rawlog and those of --list-plugins, whose own options are in the sections "
              "[source_FORMAT]. Empty for all of them. It decides where a log looks like one of several formats.")
          .list("labels", &SourceOptions::labels,
                "Labels of the sensors to read; empty reads all. The motions in a rawlog's actions have the label that "
                "action_label sets.")
          .number("start_s", &SourceOptions::start, base::Range::notNegative(),
                  "Time before which observations are left out.")
          .number("end_s", &SourceOptions::end, base::Range::notNegative(),
                  "Time after which observations are left out; 0 reads to the end.")
          .choice("time_reference", &SourceOptions::time_reference,
                  {{"log_start", TimeReference::log_start}, {"unix", TimeReference::unix_epoch}},
                  "Time from which start_s and end_s are counted: the first stamp of the earliest log, or the Unix "
                  "epoch (1970).")
          .number(
              "step_s", &SourceOptions::step, base::Range{0, 1e6},
              "Time from one step of a rawlog to the next, for a rawlog whose own stamps do not advance; 0 uses the "
              "rawlog's own stamps. A step ends when a sensor, or an action, occurs in it for the second time, so the "
              "fastest sensor determines the steps.")
          .choice("action_span", &SourceOptions::action_span,
                  {{"automatic", ActionSpan::automatic}, {"frames", ActionSpan::frames}, {"own", ActionSpan::own}},
                  "Time span that the motion of a rawlog's action gets, because the action states none. frames: from "
                  "the observations before the action to those after it. own: from the stamp of the previous action to "
                  "the action's own stamp. automatic: own if the actions have stamps, else frames.")
          .text("action_label", &SourceOptions::action_label,
                "Sensor label of the motions that a rawlog's actions are converted to.")
          .text("images_folder", &SourceOptions::images_folder,
                "Folder of the images that a rawlog refers to as separate files. Empty for MRPT's usual folder beside "
                "the rawlog: the one with the rawlog's name and _Images in place of the extension, or else the one "
                "called Images.");
  return table;
}

}  // namespace omnimapper::source

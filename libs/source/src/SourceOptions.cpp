#include <omnimapper/source/SourceOptions.h>

namespace omnimapper::source {

const base::OptionTable<SourceOptions>& SourceOptions::table() {
  static const auto table =
      base::OptionTable<SourceOptions>()
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
          .number("step_s", &SourceOptions::step, base::Range{0, 1e6},
                  "Time between the steps of a log whose stamps do not advance; 0 uses the log's own stamps. A new "
                  "step begins when a sensor, or an action, appears for the second time, so the fastest sensor "
                  "determines the steps.")
          .choice("action_span", &SourceOptions::action_span,
                  {{"automatic", ActionSpan::automatic}, {"frames", ActionSpan::frames}, {"own", ActionSpan::own}},
                  "Time span of a rawlog's action, which is a motion without a span: from the observations before it "
                  "to those after it (frames), or from the stamp of the previous action to its own (own). automatic "
                  "means own if the actions have stamps, else frames.")
          .text("action_label", &SourceOptions::action_label,
                "Sensor label given to the motions that actions are converted to.")
          .text("images_folder", &SourceOptions::images_folder,
                "Folder of external images; empty for the folder beside the rawlog that has its name with _Images "
                "appended, as MRPT uses it.");
  return table;
}

}  // namespace omnimapper::source

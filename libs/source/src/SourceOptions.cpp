#include <omnimapper/source/SourceOptions.h>

namespace omnimapper::source {

const base::OptionTable<SourceOptions>& SourceOptions::table() {
  static const auto table =
      base::OptionTable<SourceOptions>()
          .list("labels", &SourceOptions::labels,
                "Sensor labels to read, the motions of actions (action_label) included; empty reads all.")
          .number("start_s", &SourceOptions::start, base::Range::notNegative(), "Leaves out what is before this time.")
          .number("end_s", &SourceOptions::end, base::Range::notNegative(),
                  "Leaves out what is after this time; 0 reads to the end.")
          .choice("time_reference", &SourceOptions::time_reference,
                  {{"log_start", TimeReference::log_start}, {"unix", TimeReference::unix_epoch}},
                  "What start_s and end_s count from: the first stamp of the earliest log, or 1970.")
          .number(
              "step_s", &SourceOptions::step, base::Range{0, 1e6},
              "For a log whose stamps stand still: a step so long after the one before it, in the order of the log, "
              "where a step ends when a sensor or an action comes again, so that the fastest sets the pace; 0 takes "
              "the log's own stamps.")
          .choice("action_span", &SourceOptions::action_span,
                  {{"automatic", ActionSpan::automatic}, {"frames", ActionSpan::frames}, {"own", ActionSpan::own}},
                  "Time an action of a rawlog spans: between the frames around it, or between stamps of actions; "
                  "automatic is own for actions that have stamps.")
          .text("action_label", &SourceOptions::action_label, "Sensor label of the motions that actions become.")
          .text("images_folder", &SourceOptions::images_folder,
                "Folder of external images; empty: <rawlog>_Images beside the rawlog.");
  return table;
}

}  // namespace omnimapper::source

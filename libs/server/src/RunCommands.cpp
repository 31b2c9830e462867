#include <omnimapper/base/Error.h>
#include <omnimapper/map/LabelEdits.h>
#include <omnimapper/server/RunCommands.h>

namespace omnimapper::server {

namespace {

[[noreturn]] void refuseCommand(const std::string& reason) {
  throw base::Error(base::ExitCode::command_line, reason);
}

}  // namespace

void RunCommands::give(obs::CommandKind kind, const std::string& text, double expiry, base::Stamp now) {
  obs::CObservationCommand command;
  command.timestamp = now;
  command.kind = kind;
  command.text = text;
  command.origin = "page";
  command.expiry = expiry;
  file_.append(command);
}

void RunCommands::goTo(const std::string& goal, const std::string& ticket, base::Stamp now) {
  if (const auto why = map::whyNoLabel(goal)) refuseCommand("the goal " + *why);
  if (!tickets_.use(ticket, now)) refuseCommand("this command was given already, or too long ago; ask for it again");
  give(obs::CommandKind::go_to, goal, kDriveExpiry, now);
}

void RunCommands::stop(base::Stamp now) {
  give(obs::CommandKind::stop, "", 0, now);
}

void RunCommands::label(const std::vector<std::string>& words, base::Stamp now) {
  const std::string text = map::LabelEdits::commandOf(words);
  if (text.empty())
    refuseCommand(
        "a change of labels is one of: name ID TEXT, rename OLD NEW, delete TEXT, undo; a text has 1 to 200 bytes and "
        "no control characters, and the old name no \" = \"");
  give(obs::CommandKind::edit, text, 0, now);
}

}  // namespace omnimapper::server

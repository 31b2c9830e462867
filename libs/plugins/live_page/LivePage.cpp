#include "LivePage.h"

#include <omnimapper/base/Error.h>

#include <exception>
#include <filesystem>
#include <system_error>
#include <utility>

namespace omnimapper::plugins {

const base::OptionTable<LivePageOptions>& LivePageOptions::table() {
  using Options = LivePageOptions;
  static const auto table =
      base::OptionTable<Options>()
          .integer("port", &Options::port, {0, 65535},
                   "Port of this machine at which a browser finds the page; 0 takes a free one.")
          .number(
              "every_s", &Options::every, {0.1, 3600},
              "The page shows the map anew after this time. If the map is so large that this would take more than a "
              "twentieth of a core, it takes longer.")
          .text("commands", &Options::commands,
                "Table to which goals, stop and names are appended that are given on the page; a live run reads it by "
                "the driver CCommandFile. Empty: the page gives none.")
          .list("hosts", &Options::hosts,
                "Further names under which the page is reached, with their ports: those of a reverse proxy that "
                "encrypts.")
          .flag("read_only", &Options::read_only, "The page cannot change the map.")
          .flag("keep_open", &Options::keep_open,
                "Keeps the page at the end, when all output is written, until the program is interrupted.");
  return table;
}

namespace {

constexpr double kShare = 0.05;  // of the time of a core, for what the page shows

std::vector<std::string> argumentsOf(const LivePageOptions& options, const mapper::PluginContext& context) {
  if (context.run_folder.empty())
    throw base::Error(base::ExitCode::unwritable_output, "[" + context.section +
                                                             "] shows the folder of a run, but the run has no output "
                                                             "folder: give one with -o.");
  std::vector<std::string> arguments{context.run_folder,     "--growing", context.growing_folder,
                                     "--until-end-of-input", "--port",    std::to_string(options.port)};
  for (const auto& host : options.hosts) arguments.insert(arguments.end(), {"--host", host});
  if (!options.commands.empty()) arguments.insert(arguments.end(), {"--commands", options.commands});
  if (options.read_only) arguments.push_back("--read-only");
  return arguments;
}

}  // namespace

LivePage::LivePage(const LivePageOptions& options, const mapper::PluginContext& context)
    : options_(options),
      say_(context.say),
      folder_(context.run_folder),
      title_(context.title),
      growing_(context.growing_folder),
      server_(argumentsOf(options, context)),
      writer_([this](const mapper::State& state) { growing_.write(state, about()); }, options.every, kShare) {
  hearServer();
}

void LivePage::say(const std::string& sentence) const {
  if (say_) say_(sentence);
}

void LivePage::sayOnce(const std::string& problem) {
  if (problem.empty() || problem == last_problem_) return;
  say("the page does not show the newest map: " + problem);
  last_problem_ = problem;
}

void LivePage::hearServer() {
  for (const auto& line : server_.takeLines()) say(line);
  if (has_fallen_ || server_.isRunning()) return;
  has_fallen_ = true;
  say("the server of the page has ended (" + server_.howItEnded() + "); the run goes on without the page. " +
      "omnimapper-serve " + folder_ + " shows the map when the run has ended");
}

// Called often, so it looks at the server ten times a second only.
void LivePage::attend(const mapper::View& view) {
  constexpr auto kBetween = std::chrono::milliseconds(100);
  const auto now = Clock::now();
  if (has_fallen_ || now < next_look_) return;
  next_look_ = now + kBetween;
  hearServer();
  setAbout(view);
  const auto count = writer_.count();
  sayOnce(writer_.offer(view));
  if (writer_.count() > count) last_problem_.clear();
}

// Only once in the time between two maps, because it looks at all key frames.
void LivePage::setAbout(const mapper::View& view) {
  const auto now = Clock::now();
  if (now < next_about_) return;
  next_about_ = now + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options_.every));
  std::string text = aboutRun(view, title_);
  const std::lock_guard lock(mutex_);
  about_ = std::move(text);
}

std::string LivePage::about() {
  const std::lock_guard lock(mutex_);
  return about_;
}

void LivePage::finish(const mapper::View& view) {
  writer_.wait();
  if (has_fallen_ || view.map.key_frames.empty()) return;
  try {
    growing_.write(view, aboutRun(view, title_));
  } catch (const std::exception& error) {
    sayOnce(error.what());
  }
}

void LivePage::published(const std::string& folder) {
  hearServer();
  std::error_code none;
  if (folder == folder_ && std::filesystem::exists(folder_ + "/map.omnimap", none)) growing_.remove();
}

}  // namespace omnimapper::plugins

#include <omnimapper/base/Error.h>
#include <omnimapper/base/FeatureLibraries.h>
#include <omnimapper/source/MergedSource.h>
#include <omnimapper/source/RawlogSource.h>
#include <omnimapper/source/SourceFactory.h>
#include <omnimapper/source/describeInput.h>
#include <omnimapper/source/openLogs.h>
#include <omnimapper/source/refuse.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "GuardedSource.h"
#include "SensorClocks.h"
#include "recognizedFormats.h"

namespace omnimapper::source {

namespace {

// A log that is being opened, or with offsets of clocks one of its readers.
struct Opening {
  std::string path;
  OpenLog opener;  // empty: it is a rawlog
  double clock_offset;
  std::unique_ptr<SandboxedReader> reader;  // of no rawlog
  std::unique_ptr<LogSource> log;
};

std::string listed(const std::vector<std::string>& names) {
  return base::option_text::format(names);
}

// The format of a log. A file that no format recognizes counts as a rawlog, whose reader says what is wrong with it.
std::string formatOf(const std::string& path, const std::vector<std::string>& allowed) {
  const auto look = LogLook::at(path);
  if (isFolderOfRun(look)) refuse(path, describeInput(path));
  auto formats = recognizedFormats(look);
  const auto is_allowed = [&](const std::string& format) {
    return allowed.empty() || std::find(allowed.begin(), allowed.end(), format) != allowed.end();
  };
  const auto all = formats;
  formats.erase(std::remove_if(formats.begin(), formats.end(), [&](const auto& format) { return !is_allowed(format); }),
                formats.end());
  if (formats.size() == 1) return formats.front();
  if (formats.size() > 1)
    throw base::Error(base::ExitCode::command_line,
                      path + ": looks like a log of several formats: " + listed(formats) +
                          "; name the right one with [source] formats = " + formats.front() +
                          ", or on the command line with --set source.formats=" + formats.front());
  if (!all.empty())
    refuse(path, "is a log of the format " + listed(all) + ", but [source] formats allows only " + listed(allowed) +
                     "; add it there");
  if (look.is_folder || !is_allowed(kRawlog)) refuse(path, describeInput(path));
  return kRawlog;
}

OpenLog openerOf(const std::string& format, const SourceOptions& options) {
  if (const auto found = options.openers.find(format); found != options.openers.end()) return found->second;
  const auto formats = registeredFormats();
  const auto found =
      std::find_if(formats.begin(), formats.end(), [&](const auto& one) { return one->name() == format; });
  if (found == formats.end())
    throw base::Error(base::ExitCode::unknown_plugin,
                      "no format of logs is called '" + format + "' (known: " + formatsAsText() + ")");
  const auto defaults = base::Config::fromText("", "");
  return (*found)->opener(defaults.section(sectionOfFormat(format)));
}

std::unique_ptr<ObservationSource> opened(std::vector<Opening> openings, const SourceOptions& options,
                                          const StopOpening& stop) {
  // All child processes are started before a reader of a registered format, which may use threads, runs in this one.
  for (auto& one : openings) {
    if (one.opener)
      one.reader = startReader(one.path, one.opener);
    else
      one.log = std::make_unique<RawlogSource>(one.path, options, stop, one.clock_offset);
  }
  std::optional<base::Stamp> start;
  for (auto& one : openings) {
    if (one.opener)
      one.log =
          std::make_unique<GuardedSource>(one.path, one.opener, std::move(one.reader), options, one.clock_offset, stop);
    const auto first = one.log->firstStamp();
    if (first && (!start || *first < *start)) start = first;
  }
  if (start && options.time_reference == TimeReference::log_start)
    for (auto& one : openings) one.log->setLogStart(*start);
  if (openings.size() == 1) return std::move(openings.front().log);
  std::vector<std::unique_ptr<ObservationSource>> logs;
  for (auto& one : openings) logs.push_back(std::move(one.log));
  return std::make_unique<MergedSource>(std::move(logs));
}

void addOpenings(const std::string& path, const OpenLog& opener, const SourceOptions& options,
                 std::vector<Opening>& openings) {
  for (const double offset : SensorClocks::offsetsIn(options.clock_offsets))
    openings.push_back({path, opener, offset, nullptr, nullptr});
}

}  // namespace

std::unique_ptr<ObservationSource> openLogs(const std::vector<std::string>& paths, const SourceOptions& options,
                                            const StopOpening& stop) {
  if (paths.empty()) throw base::Error(base::ExitCode::command_line, "no log is named; give one with -r.");
  std::vector<Opening> openings;
  for (const auto& path : paths) {
    const auto format = formatOf(path, options.formats);
    addOpenings(path, format == kRawlog ? OpenLog() : openerOf(format, options), options, openings);
  }
  return opened(std::move(openings), options, stop);
}

std::unique_ptr<ObservationSource> openLogAs(const std::string& format, const std::string& path,
                                             const SourceOptions& options, const StopOpening& stop) {
  std::vector<Opening> openings;
  addOpenings(path, openerOf(format, options), options, openings);
  return opened(std::move(openings), options, stop);
}

SourceOptions readSourceOptions(const base::Config& config) {
  auto options = config.section("source").read<SourceOptions>();
  for (const auto& format : registeredFormats())
    options.openers[format->name()] = format->opener(config.section(sectionOfFormat(format->name())));
  for (const auto& name : base::namesOfFeatures(base::Registered::format))
    config.section(sectionOfFormat(name));  // may be there, although the format is not available
  const auto known = knownFormats();
  for (const auto& name : options.formats) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const auto near = base::nearestName(name, known);
    throw base::Error(base::ExitCode::unknown_plugin,
                      config.placeOf("source", "formats") + ": [source] formats: no format of logs is called '" + name +
                          "'" + (near.empty() ? "" : "; did you mean '" + near + "'?") + " (known: " + formatsAsText() +
                          "; others come from [mapper] plugin_libraries)");
  }
  return options;
}

}  // namespace omnimapper::source

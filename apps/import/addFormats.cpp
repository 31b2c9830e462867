#include <omnimapper/base/FeatureLibraries.h>
#include <omnimapper/source/SourceFactory.h>

#include <algorithm>
#include <map>

#include "ImportArguments.h"

namespace {

using namespace omnimapper;

// Names of tasks that are shorter than those of their formats.
const std::map<std::string, std::string> kShortNames = {{"carmen_log", "carmen"},   {"command_table", "commands"},
                                                        {"rgbd_folder", "tum"},     {"pcd_folder", "pcd"},
                                                        {"image_folder", "images"}, {"ros_log", "ros"}};

// --rate-hz for rate_hz, and also --rate, without the unit.
std::string flagsOf(const std::string& key) {
  std::string flag = "--" + key;
  std::replace(flag.begin(), flag.end(), '_', '-');
  for (const std::string unit : {"-hz", "-s", "-px", "-per-m", "-m", "-deg"}) {
    if (flag.size() > unit.size() && flag.compare(flag.size() - unit.size(), unit.size(), unit) == 0)
      return flag + "," + flag.substr(0, flag.size() - unit.size());
  }
  return flag;
}

void addOptions(CLI::App& task, const std::vector<base::OptionSpec>& options, Arguments::Format& format) {
  format.values.reserve(options.size());  // CLI11 keeps pointers to the values
  for (const auto& option : options) {
    auto& value = format.values.emplace_back(option.key, "").second;
    const auto range = option.range.empty() ? "" : " (" + option.range + ")";
    task.add_option(flagsOf(option.key), value, option.help + range)->default_str(option.default_value);
  }
}

CLI::App* addTask(CLI::App& app, const std::string& name, const std::string& summary, Arguments& arguments) {
  const auto found = kShortNames.find(name);
  auto* task = app.add_subcommand(found == kShortNames.end() ? name : found->second, summary);
  task->add_option("IN", arguments.input, summary)->required();
  task->add_option("OUT", arguments.output,
                   "rawlog to write; a ground truth is written beside it: out.rawlog, out.truth.tum")
      ->required();
  auto& format = *arguments.formats.emplace_back(std::make_unique<Arguments::Format>());
  format.name = name;
  format.task = task;
  return task;
}

}  // namespace

const Arguments::Format& Arguments::chosen() const {
  return **std::find_if(formats.begin(), formats.end(), [](const auto& format) { return format->task->parsed(); });
}

void addFormats(CLI::App& app, Arguments& arguments) {
  for (const auto& factory : source::registeredFormats()) {
    auto* task = addTask(app, factory->name(), factory->summary(), arguments);
    addOptions(*task, factory->options(), *arguments.formats.back());
    task->add_option("--images", arguments.images, "embedded: images are in the rawlog; external: in files beside it")
        ->check(CLI::IsMember({"embedded", "external"}))
        ->capture_default_str();
    task->add_flag("--poses", arguments.poses,
                   "also write the true poses into the rawlog, as observations that a map can use");
  }
  // A format that is left out says so, with the remedy, when it is named.
  for (const auto& name : base::namesOfFeatures(base::Registered::format)) {
    if (const auto why = base::whyUnavailable(name); !why.empty())
      addTask(app, name, "not available: " + why, arguments)->allow_extras();
  }
}

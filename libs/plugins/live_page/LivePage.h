#pragma once

#include <omnimapper/derived/SnapshotWriter.h>
#include <omnimapper/plugin/PluginFactory.h>

#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "GrowingMap.h"
#include "PageServer.h"

namespace omnimapper::plugins {

struct LivePageOptions {
  int port = 8080;
  double every = 1;  ///< [s]
  std::string commands;
  std::vector<std::string> hosts;
  bool read_only = false, keep_open = true;

  static const base::OptionTable<LivePageOptions>& table();
};

/// Shows the map in browsers while it grows (thesis 6.2.5): starts omnimapper-serve as a child process, which serves a
/// copy of the map that is written from time to time in a thread of its own, and the files of the run when it has
/// ended. If the server falls, the run goes on.
class LivePage : public mapper::OutputPlugin {
 public:
  static constexpr const char* kName = "LivePage";
  static constexpr const char* kSummary = "Shows the map in browsers while it grows (--page).";
  static constexpr bool kNeedsTrust = true;

  /// Throws as PageServer, and Error(unwritable_output) if the run has no output folder.
  LivePage(const LivePageOptions& options, const mapper::PluginContext& context);
  void update(const mapper::View& view) override { attend(view); }
  void keyFrameAdded(const mapper::View& view) override { attend(view); }
  void frameAdded(const mapper::View& view) override { attend(view); }
  /// The map is shown as it is without its files, in case that the run writes none.
  void finish(const mapper::View& view) override;
  void published(const std::string& folder) override;
  /// Whether the server is there and should stay.
  bool isLookedAt() const override { return options_.keep_open && server_.isRunning(); }

 private:
  using Clock = std::chrono::steady_clock;
  void attend(const mapper::View& view);
  void hearServer();
  void setAbout(const mapper::View& view);
  std::string about();
  void say(const std::string& sentence) const;
  /// Not again until a map was written.
  void sayOnce(const std::string& problem);

  LivePageOptions options_;
  std::function<void(const std::string&)> say_;
  std::string folder_, title_;
  GrowingMap growing_;
  mutable PageServer server_;
  Clock::time_point next_look_ = Clock::now(), next_about_ = next_look_;
  bool has_fallen_ = false;
  std::string last_problem_;
  std::mutex mutex_;
  std::string about_;               // guarded by mutex_
  derived::SnapshotWriter writer_;  // last, because its thread uses the others
};

}  // namespace omnimapper::plugins

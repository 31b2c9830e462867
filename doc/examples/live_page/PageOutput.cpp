#include <omnimapper/base/AtLoad.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/derived/PlacesOfMap.h>
#include <omnimapper/draw/Markup.h>
#include <omnimapper/plugin/PluginFactory.h>
#include <omnimapper/query/Verbs.h>
#include <poll.h>

#include <atomic>
#include <memory>
#include <mutex>
#include <sstream>
#include <thread>

#include "Http.h"
#include "Rooms.h"

namespace base = omnimapper::base;
namespace mapper = omnimapper::mapper;
namespace query = omnimapper::query;
using omnimapper::draw::escapeMarkup;

namespace live_page {

struct PageOptions {
  int port = 8080, request_port = 7710;

  static const base::OptionTable<PageOptions>& table() {
    static const auto table =
        base::OptionTable<PageOptions>()
            .integer("port", &PageOptions::port, {0, 65535},
                     "Port of this machine at which a browser finds the page; 0 takes a free one.")
            .integer("request_port", &PageOptions::request_port, {1, 65535}, "Port of the driver NameRequests.");
    return table;
  }
};

// Step 2: the output. The thread of the engine copies what is shown into Shown; the thread of the page reads that.

/// Serves a page that shows the numbers of key frames and landmarks and the rooms, answers queries, and lets the user
/// name the room where the robot is. Only programs on this machine reach it.
class PageOutput : public mapper::OutputPlugin {
 public:
  explicit PageOutput(const PageOptions& options)
      : options_(options),
        listening_(omnimapper::live::listenTcp({"127.0.0.1", static_cast<std::uint16_t>(options.port)})),
        thread_([this] { serve(); }) {}
  ~PageOutput() override {
    stopping_ = true;
    thread_.join();
  }

  // An update comes after a solve, which may take many key frames; a room may be named while the robot stands still.
  void update(const mapper::View& view) override { show(view); }
  void keyFrameAdded(const mapper::View& view) override { show(view); }
  void frameAdded(const mapper::View& view) override {
    const auto* layer = view.map.layers.find<rooms_layer::Rooms>();
    if (layer && layer->rooms.size() != latest()->room_count) show(view);
  }
  void finish(const mapper::View& view) override { show(view); }

 private:
  struct Shown {
    std::size_t key_frames = 0;
    query::MapToAsk map;  // without a file: only its places
    std::string rooms;    // HTML
    std::size_t room_count = 0;
  };

  // A View is valid during the call only, so nothing of it is kept.
  void show(const mapper::View& view) {
    auto shown = std::make_shared<Shown>();
    shown->key_frames = view.map.key_frames.size();
    shown->map.places = omnimapper::derived::placesOf(view);
    if (const auto* layer = view.map.layers.find<rooms_layer::Rooms>()) {
      shown->room_count = layer->rooms.size();
      for (const auto& [name, room] : layer->rooms) {
        const auto at = room.inMap(view.map);
        shown->rooms +=
            "<li>" + escapeMarkup(name) + " at " + base::fixed(at.x(), 2) + " " + base::fixed(at.y(), 2) + "</li>";
      }
    }
    const std::lock_guard lock(mutex_);
    shown_ = shown;
  }

  void serve() {
    while (!stopping_) {
      pollfd readable{listening_.get(), POLLIN, 0};
      if (::poll(&readable, 1, 100) <= 0) continue;
      answerClient(listening_, [this](const HttpRequest& request) { return pageFor(request); });
    }
  }

  std::optional<std::string> pageFor(const HttpRequest& request) {
    if (request.path == "/") return page();
    if (request.path == "/state") return state();
    const auto question = request.values.find("q");
    if (request.path != "/query" || question == request.values.end()) return std::nullopt;
    return "<pre>" + escapeMarkup(answerTo(question->second)) + "</pre>";
  }

  std::string page() const {
    return "<!DOCTYPE html><title>OmniMapper</title><iframe src=/state></iframe>"
           "<form action=/query target=answer><input name=q placeholder='list wall'><button>Ask</button></form>"
           "<form onsubmit=\"fetch('http://127.0.0.1:" +
           std::to_string(options_.request_port) +
           "/?room=' + encodeURIComponent(this.room.value), {method: 'POST', mode: 'no-cors'}); return false\">"
           "<input name=room placeholder=kitchen><button>Name this room</button></form>"
           "<iframe name=answer width=900></iframe>";
  }

  std::string state() {
    const auto shown = latest();
    return "<meta http-equiv=refresh content=1>" + std::to_string(shown->key_frames) + " key frames, " +
           std::to_string(shown->map.places.places.size()) + " landmarks<ul>" + shown->rooms + "</ul>";
  }

  // A question as omnimapper-query takes it. A goal needs the files of a finished map.
  std::string answerTo(const std::string& question) {
    const auto shown = latest();
    query::Request request;
    std::istringstream in(question);
    for (std::string word; in >> word;) request.words.push_back(word);
    const auto* verb = &query::verbs().front();
    for (const auto& known : query::verbs()) {
      const bool needs_file = known.name == "goal" || known.name == "layers";
      if (needs_file || request.words.empty() || request.words.front() != known.name) continue;
      verb = &known;
      request.words.erase(request.words.begin());
      break;
    }
    try {
      query::expectWords(*verb, request);
      return verb->answer(shown->map, request).text;
    } catch (const base::Error& error) {
      return error.what();
    }
  }

  std::shared_ptr<const Shown> latest() {
    const std::lock_guard lock(mutex_);
    return shown_;
  }

  PageOptions options_;
  std::mutex mutex_;
  std::shared_ptr<const Shown> shown_ = std::make_shared<Shown>();  // guarded by mutex_
  std::atomic<bool> stopping_ = false;
  omnimapper::live::Descriptor listening_;
  std::thread thread_;  // last, because it uses all others
};

class PageOutputFactory : public mapper::OutputPluginFactory {
  DEFINE_MRPT_OBJECT(PageOutputFactory, live_page)
 public:
  std::string name() const override { return "PageOutput"; }
  std::string summary() const override { return "Serves a page that shows the map as it grows."; }
  const std::vector<base::OptionSpec>& options() const override { return PageOptions::table().specs(); }
  std::unique_ptr<mapper::OutputPlugin> make(const base::ConfigSection& section,
                                             const mapper::PluginContext&) const override {
    return std::make_unique<PageOutput>(section.read<PageOptions>(mapper::sectionKeysOfEngine()));
  }
};

}  // namespace live_page

IMPLEMENTS_MRPT_OBJECT(PageOutputFactory, omnimapper::mapper::OutputPluginFactory, live_page)

namespace live_page {
const base::AtLoad kRegisterPage([] { mrpt::rtti::registerClass(CLASS_ID(PageOutputFactory)); });
}  // namespace live_page

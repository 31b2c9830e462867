#include <mrpt/config/CConfigFileBase.h>
#include <mrpt/hwdrivers/CGenericSensor.h>
#include <mrpt/obs/CObservationRFID.h>
#include <omnimapper/base/AtLoad.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/drivers/CheckedSensor.h>
#include <omnimapper/live/HostClock.h>

#include "Http.h"

namespace live_page {

// Step 1: the driver. A request that changes the map is an observation, so that it is recorded, and replayed where it
// came. It is of a class of MRPT: a recording with a class of our own could be read by other programs only up to the
// first request.

/// Takes names of rooms over HTTP from this machine: POST /?room=kitchen. Each becomes a CObservationRFID, as if the
/// tag of that room were read where the robot is. As a CheckedSensor that waits for others it is not opened again when
/// nobody asks for anything.
class NameRequests : public mrpt::hwdrivers::CGenericSensor, public omnimapper::drivers::CheckedSensor {
  DEFINE_GENERIC_SENSOR(NameRequests)
 public:
  void initialize() override {
    listening_.close();
    listening_ = omnimapper::live::listenTcp({"127.0.0.1", port_});
  }
  void doProcess() override {
    answerClient(listening_, [this](const HttpRequest& request) { return take(request); });
  }

  std::uint64_t leftOut() const override { return left_out_; }
  std::string leftOutByReason() const override {
    return left_out_ > 0 ? std::to_string(left_out_) + " that name no room" : "";
  }
  bool waitsForOthers() const override { return true; }

 protected:
  void loadConfig_sensorSpecific(const mrpt::config::CConfigFileBase& ini, const std::string& section) override {
    port_ = static_cast<std::uint16_t>(ini.read_int(section, "port", port_));
  }

 private:
  std::optional<std::string> take(const HttpRequest& request);

  std::uint16_t port_ = 7710;
  omnimapper::live::Descriptor listening_;
  std::uint64_t left_out_ = 0;
};

std::optional<std::string> NameRequests::take(const HttpRequest& request) {
  const auto room = request.values.find("room");
  // A browser names the page that asks. One of somebody else, open in the same browser, must not change the map.
  const bool is_ours = request.origin.empty() || request.origin.rfind("http://127.0.0.1:", 0) == 0;
  if (!is_ours || request.method != "POST" || room == request.values.end() || room->second.size() > 200) {
    ++left_out_;
    return std::nullopt;
  }
  const auto tag = mrpt::obs::CObservationRFID::Create();
  tag->timestamp = omnimapper::live::hostNow();
  tag->sensorLabel = m_sensorLabel;
  tag->tag_readings.push_back({0, omnimapper::base::printable(room->second), ""});
  appendObservation(tag);
  return "";
}

}  // namespace live_page

IMPLEMENTS_GENERIC_SENSOR(NameRequests, live_page)

namespace live_page {
const omnimapper::base::AtLoad kRegisterDriver([] { NameRequests::doRegister(); });
}  // namespace live_page

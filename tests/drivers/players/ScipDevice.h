#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "HokuyoModel.h"

namespace omnimapper::players {

/// The SCIP 2.0 side of a Hokuyo: it converts the host's bytes to the device's bytes, and reads neither clocks nor
/// sockets. It implements SCIP2.0, VV, PP, II, BM, QT, RS, RT, TM, SS, CR, HS, MD, MS, ME, GD, GS and GE, and refuses
/// everything else with status 0E. It uses SCIP 2.0 from the start, as all models since the UTM do.
class ScipDevice {
 public:
  explicit ScipDevice(HokuyoModel model) : model_(std::move(model)) {}

  /// The answers to all commands that end in these bytes. `now_ms` is the time of the device's clock.
  std::string receive(std::string_view bytes, std::uint32_t now_ms);

  /// Whether the host has asked for scans.
  bool isMeasuring() const { return request_.has_value(); }

  /// The message of a scan that was measured at `now_ms`; empty if the host did not ask for it.
  std::string measured(const HokuyoScan& scan, std::uint32_t now_ms);

  const HokuyoModel& model() const { return model_; }

 private:
  /// The command MDSSSSEEEECCIRR and similar ones.
  struct Request {
    std::string name;         // "MD"
    int first = 0, last = 0;  // steps
    int cluster = 1;          // number of steps that are combined to their smallest range; 0: as 1
    int interval = 0;         // number of scans left out after each
    int remaining = 0;        // number of scans; 0: no limit
    std::string text;         // the host's own text, with its semicolon
    int until_next = 0;       // number of scans to be left out before the next
    bool is_single = false;   // GD and similar commands
  };

  std::string answer(const std::string& command, std::uint32_t now_ms);
  std::string startMeasuring(const std::string& command, const std::string& text);
  std::string timeMode(const std::string& command, std::uint32_t now_ms);
  std::string productInformation() const;
  std::string versionInformation() const;
  std::string stateInformation(std::uint32_t now_ms) const;
  std::string data(const HokuyoScan& scan) const;

  HokuyoModel model_;
  std::string unfinished_;
  std::optional<Request> request_;
  bool laser_is_on_ = false;
};

}  // namespace omnimapper::players

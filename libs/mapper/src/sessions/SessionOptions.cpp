#include <omnimapper/base/Error.h>
#include <omnimapper/mapper/SessionOptions.h>
#include <omnimapper/plugin/Batch.h>

#include <string>

namespace omnimapper::mapper {

namespace {
// A session that is localized in a map has the number after its last, and the largest of all is for provisional ids.
constexpr int kLargestNumber = Batch::kProvisionalSession - 2;
}  // namespace

const base::OptionTable<SessionOptions>& SessionOptions::table() {
  using Options = SessionOptions;
  static const auto table =
      base::OptionTable<Options>()
          .integer(
              "number", &Options::number, base::Range{0, kLargestNumber},
              "Number of the session, which the id of everything that it adds contains. Logs that are mapped apart "
              "with different numbers have no id in common. It must be larger than the numbers of the sessions of "
              "a map that is continued. Without it, the session of a new map is number 0, and one that continues a "
              "map has the number after the last. With --localize it has no effect.")
          .choice("start", &Options::start,
                  {{"end", Options::Start::end},
                   {"origin", Options::Start::origin},
                   {"pose", Options::Start::pose},
                   {"anywhere", Options::Start::anywhere}},
                  "Start of a session that continues a map or is localized in one. end: where the previous session "
                  "ended. origin: at the origin of the map. pose: at start_x_m, start_y_m and start_yaw_deg. anywhere: "
                  "at an unknown place, for which the whole map is searched.")
          .number("start_x_m", &Options::start_x, {},
                  "x coordinate in the map at which the session starts, for start = pose.")
          .number("start_y_m", &Options::start_y, {},
                  "y coordinate in the map at which the session starts, for start = pose.")
          .number("start_yaw_deg", &Options::start_yaw, {},
                  "Heading in the map at which the session starts, for start = pose.")
          .number("start_sigma_m", &Options::start_sigma, base::Range::positive(),
                  "Standard deviation of each coordinate of the session's start position. The larger it is, the "
                  "farther away loop closures are searched for.")
          .number("start_sigma_deg", &Options::start_angle_sigma, base::Range::positive(),
                  "Standard deviation of the angles of the session's start pose.")
          .integer("window_key_frames", &Options::window_key_frames, base::Range{5, 1e6},
                   "With --localize, number of the newest key frames whose poses are estimated; the poses of older key "
                   "frames are held fixed.");
  return table;
}

SessionStart SessionOptions::startOn(const map::Map& map) const {
  if (start == Start::anywhere) return startAnywhere(map);
  SessionStart session{{}, start_sigma, start_angle_sigma};
  if (start == Start::pose) session.map_from_base = mrpt::poses::CPose3D(start_x, start_y, 0, start_yaw, 0, 0);
  if (start != Start::end) return session;
  const auto& last = map.key_frames.back();
  session.map_from_base = last.map_from_base;
  if (!last.dependents.empty()) session.map_from_base = last.map_from_base + last.dependents.back().keyframe_from_base;
  return session;
}

std::uint16_t SessionOptions::numberIn(const map::Map& map) const {
  const int next = map.sessions.empty() ? 0 : map.sessions.back().number + 1;
  if (next > kLargestNumber) {
    throw base::Error(base::ExitCode::out_of_range,
                      "the last session of the map has the largest number that there is, " +
                          std::to_string(kLargestNumber) + ": the map can be localized in, but not continued");
  }
  if (number && *number < next) {
    throw base::Error(base::ExitCode::out_of_range,
                      "[session] number = " + std::to_string(*number) +
                          ": the map that is continued has sessions up to " + "number " + std::to_string(next - 1) +
                          ". Give a larger number (--set session.number=" + std::to_string(next) +
                          "), or none for the next one");
  }
  return static_cast<std::uint16_t>(number.value_or(next));
}

}  // namespace omnimapper::mapper

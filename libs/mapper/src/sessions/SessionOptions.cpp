#include <omnimapper/mapper/SessionOptions.h>

namespace omnimapper::mapper {

const base::OptionTable<SessionOptions>& SessionOptions::table() {
  using Options = SessionOptions;
  static const auto table =
      base::OptionTable<Options>()
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

}  // namespace omnimapper::mapper

// truth/<label>_bodies.csv names the beams that end on people.
#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <omnimapper/sim_world/People.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "SensorRun.h"
#include "SmallWorlds.h"

namespace person_beams_test {
namespace {

using namespace omnimapper;
using namespace small_worlds;

// A room of 10 x 6 m with a person 2 m before the robot, who walks to the left after 1 s.
sim::World withPerson() {
  sim::World world = oneRoom(10, 6);
  sim::PersonSpec spec;
  spec.name = "anna";
  spec.waypoints = {{{4, 3}, 0}, {{4, 3}, 1}, {{4, 5}, 3}};
  sim::MadePerson made = sim::makePerson(spec);
  for (sim::Body& body : made.bodies) world.bodies.push_back(std::move(body));
  world.people.push_back(std::move(made.person));
  return world;
}

const std::string kLaser = "class = Laser2d\nmodel = ideal\nz_m = 0.35\nrate_hz = 10\n";

struct Row {
  std::string stamp, measurement, person, body, echo;
  double speed = 0;
  int first = 0, count = 0;
};

std::vector<Row> rowsOf(const std::string& text) {
  std::vector<Row> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string> cells;
    std::istringstream words(line);
    for (std::string word; std::getline(words, word, ',');) cells.push_back(word);
    if (cells.size() != 8) throw std::runtime_error("a line of " + std::to_string(cells.size()) + " cells");
    rows.push_back({cells[0], cells[1], cells[2], cells[3], cells[7], std::stod(cells[4]), std::stoi(cells[5]),
                    std::stoi(cells[6])});
  }
  return rows;
}

TEST(PersonBeams, thosePointsOfAScanAreNamedThatLieOnThePerson) {
  const SensorRun run(withPerson(), sim::Track(at(2, 3)), kLaser, 3);
  for (const int k : {0, 20}) {
    const auto scan = run.measure<mrpt::obs::CObservation2DRangeScan>(k);
    const auto text = run.sensor().measure(k).body_rows;
    ASSERT_TRUE(text);
    std::vector<char> is_person(scan->getScanSize(), 0);
    for (const Row& row : rowsOf(*text)) {
      EXPECT_EQ(row.person, "anna");
      EXPECT_EQ(row.body.rfind("anna/", 0), 0u) << row.body;
      EXPECT_EQ(row.measurement, std::to_string(k));
      EXPECT_EQ(row.echo, "clear");
      EXPECT_NEAR(row.speed, k == 0 ? 0 : 1, 0.02);
      for (int i = row.first; i < row.first + row.count; ++i) is_person.at(static_cast<std::size_t>(i)) = 1;
    }
    // The person is within 0.6 m of her place; nothing else is.
    const Eigen::Vector2d place(4, k == 0 ? 3 : 4);
    for (std::size_t i = 0; i < scan->getScanSize(); ++i) {
      const double angle = scan->getScanAngle(i), range = scan->getScanRange(i);
      const Eigen::Vector2d point(2 + range * std::cos(angle), 3 + range * std::sin(angle));
      EXPECT_EQ(is_person[i] != 0, (point - place).norm() < 0.6) << "beam " << i << " of scan " << k;
    }
    EXPECT_GE(std::count(is_person.begin(), is_person.end(), 1), 5);
  }
}

TEST(PersonBeams, aWorldWithoutPeopleHasNoSuchFile) {
  const SensorRun run(oneRoom(10, 6), sim::Track(at(2, 3)), kLaser, 1);
  EXPECT_FALSE(run.sensor().measure(0).body_rows);
}

}  // namespace
}  // namespace person_beams_test

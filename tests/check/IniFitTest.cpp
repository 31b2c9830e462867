// What the headers of INIs say about the logs that they fit.
#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>

#include "CheckedLog.h"
#include "IniFit.h"

namespace omnimapper::check::ini_fit_test {
namespace {

using Names = std::vector<std::string>;

const std::string kIni = R"(; For a robot.
; Fits 3 (settings, a guess): laser or odometry, no CObservationImage or CObservationGPS: walls; needs
;   --set a.b=c
; Fits 12: laser: a grid: of scans
[mapper]
)";

TEST(IniFit, IsReadFromTheHeader) {
  const auto fits = fitsOf(kIni, "some.ini");
  ASSERT_EQ(fits.size(), 2U);
  EXPECT_EQ(fits[0].place, 3);
  EXPECT_TRUE(fits[0].needs_settings && fits[0].is_a_guess);
  ASSERT_EQ(fits[0].needs.size(), 2U);
  EXPECT_EQ(fits[0].needs[0].one_of, (Names{"laser", "odometry"}));
  EXPECT_FALSE(fits[0].needs[0].is_absent);
  EXPECT_EQ(fits[0].needs[1].one_of, (Names{"CObservationImage", "CObservationGPS"}));
  EXPECT_TRUE(fits[0].needs[1].is_absent);
  EXPECT_EQ(fits[0].what, "walls; needs --set a.b=c");
  EXPECT_EQ(fits[1].place, 12);
  EXPECT_FALSE(fits[1].needs_settings || fits[1].is_a_guess);
  EXPECT_EQ(fits[1].what, "a grid: of scans");
}

TEST(IniFit, ALogMustHaveOneOfEachAndNoneOfTheOthers) {
  const auto facts = Checked(halfALap()).facts;  // a laser and odometry
  const auto fits = [&](const std::string& needs) {
    return fitsOf("; Fits 1: " + needs + ": something\n", "some.ini").front().fits(facts);
  };
  EXPECT_TRUE(fits("laser"));
  EXPECT_TRUE(fits("laser, odometry"));
  EXPECT_TRUE(fits("CObservation2DRangeScan"));
  EXPECT_TRUE(fits("CObservationImage or laser"));
  EXPECT_TRUE(fits("laser, no CObservationImage"));
  EXPECT_FALSE(fits("CObservationImage"));
  EXPECT_FALSE(fits("laser, CObservationImage"));
  EXPECT_FALSE(fits("no laser"));
  EXPECT_FALSE(fits("odometry, no CObservationImage or laser"));
}

TEST(IniFit, OfAnotherFormIsAnErrorThatNamesTheFile) {
  for (const char* line :
       {"; Fits: laser: walls", "; Fits 1 laser", "; Fits 1 (maybe): laser: walls", "; Fits 1: laser"}) {
    try {
      fitsOf(line, "some.ini");
      ADD_FAILURE() << line;
    } catch (const base::Error& error) {
      EXPECT_NE(std::string(error.what()).find("some.ini"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace omnimapper::check::ini_fit_test

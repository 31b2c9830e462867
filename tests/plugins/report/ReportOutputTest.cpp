#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <omnimapper/draw/Image.h>
#include <omnimapper/draw/Markup.h>
#include <omnimapper/obs/SceneDrawing.h>
#include <omnimapper/testing/BoxWorld.h>
#include <omnimapper/testing/Fixtures.h>

#include <cmath>

#include "report/Chart.h"
#include "report/Html.h"
#include "report/ReportOutput.h"

namespace report_output_test {
namespace {

using namespace box_world;
using omnimapper::testing::ScratchFolder;

std::string reportOf(const RunRecord& run, const plugins::ReportOptions& options = {}) {
  ScratchFolder folder;
  plugins::ReportOutput(options, contextFor(folder.path())).finish(run.view());
  return contentOf(folder / "report.html");
}

/// The first error in the tags of a page; empty if each tag is closed by its own name in order.
std::string tagFault(std::string html) {
  const std::string kind = "<!DOCTYPE html>";
  if (html.rfind(kind, 0) == 0) html.erase(0, kind.size());
  for (const char* opaque : {"script", "style"}) {
    const std::string open = std::string("<") + opaque + ">", close = std::string("</") + opaque + ">";
    for (std::size_t at; (at = html.find(open)) != std::string::npos;) {
      html.erase(at, html.find(close, at) + close.size() - at);
    }
  }
  std::vector<std::string> open;
  for (std::size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at)) {
    const std::size_t end = html.find('>', at);
    if (end == std::string::npos) return "an unended tag";
    const std::string tag = html.substr(at + 1, end - at - 1);
    at = end;
    const std::string name = tag.substr(tag[0] == '/' ? 1 : 0, tag.find_first_of(" /\n", 1) - (tag[0] == '/' ? 1 : 0));
    if (tag[0] == '/') {
      if (open.empty() || open.back() != name)
        return "</" + name + "> closes <" + (open.empty() ? "" : open.back()) + ">";
      open.pop_back();
    } else if (tag.back() != '/') {
      open.push_back(name);
    }
  }
  return open.empty() ? "" : "<" + open.back() + "> is not closed";
}

std::size_t countOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

double attribute(const std::string& html, const std::string& name) {
  return numberAfter(html, name + "=\"");
}

TEST(Report, isWellFormedAndRefersToNothingOutside) {
  RunRecord run = boxRun();
  run.warnings = {"the log \"a&b\" ends in the middle"};
  const std::string html = reportOf(run);
  EXPECT_EQ(tagFault(html), "");
  EXPECT_EQ(html.find("http"), std::string::npos);
  EXPECT_EQ(html.find("src="), std::string::npos);
  EXPECT_EQ(tagFault(reportOf(RunRecord())), "");
  EXPECT_EQ(tagFault("<p><b></p></b>"), "</p> closes <b>");
}

TEST(Report, namesOfLogsAndReasonsCannotBreakThePage) {
  const std::string html = reportOf(boxRun());
  EXPECT_NE(html.find("box &lt;world&gt;"), std::string::npos);
  EXPECT_NE(html.find("turned &lt;too&gt; far"), std::string::npos);
  EXPECT_NE(html.find("motion = planar &amp; flat"), std::string::npos);
  EXPECT_EQ(html.find("<world>"), std::string::npos);
}

TEST(Report, theTrajectoryIsRegisteredWithThePicture) {
  const RunRecord run = boxRun();
  const std::string html = reportOf(run);
  const double scale = attribute(html, "data-metres-per-pixel"), min_x = attribute(html, "data-min-x"),
               max_y = attribute(html, "data-max-y");
  const std::size_t begin = html.find("class=\"track\" d=\"M"), end = html.find("\"/>", begin);
  ASSERT_NE(begin, std::string::npos);
  const std::string path = html.substr(begin, end - begin);
  const auto expectAt = [&](const std::string& command, std::size_t at, double x, double y) {
    EXPECT_NEAR(min_x + numberAfter(path, command, at) * scale, x, 0.1 * scale);
    EXPECT_NEAR(max_y - numberAfter(path, " ", at) * scale, y, 0.1 * scale);
  };
  expectAt("M", path.find("M"), 0, 0);
  expectAt("L", path.rfind("L"), 0.5, 1.25);
}

TEST(Report, thePictureOfTheMapShowsWallsTrackAndClosureWhereTheyAre) {
  ScratchFolder folder;
  plugins::ReportOutput({}, contextFor(folder.path())).finish(boxRun().view());
  const std::string html = contentOf(folder / "report.html");
  const double scale = attribute(html, "data-metres-per-pixel"), min_x = attribute(html, "data-min-x"),
               max_y = attribute(html, "data-max-y");
  mrpt::img::CImage picture;
  ASSERT_TRUE(picture.loadFromFile(folder / "map.png"));
  const auto colourAt = [&](double x, double y) {
    const auto column = static_cast<unsigned>((x - min_x) / scale), row = static_cast<unsigned>((max_y - y) / scale);
    return draw::Rgb{picture.at<std::uint8_t>(column, row, 2), picture.at<std::uint8_t>(column, row, 1),
                     picture.at<std::uint8_t>(column, row, 0)};
  };
  const auto floor = colourAt(1.5, -0.5);
  EXPECT_EQ(floor.r + floor.g + floor.b, 3 * 255);
  const auto track = colourAt(0.75, 0.75);  // half way from (1, 0.25) to (0.5, 1.25)
  EXPECT_GT(track.b, track.r + 80);
  const auto closure = colourAt(0.25, 0.625);  // half way from (0, 0) to (0.5, 1.25)
  EXPECT_GT(closure.g, closure.r + 60);
}

// The box, whose first two key frames are of an earlier session.
RunRecord continuedRun() {
  RunRecord run = boxRun();
  map::Map map;
  map.sessions.resize(2);
  map.sessions[1].number = 1;
  for (std::size_t i = 0; i < run.map.key_frames.size(); ++i) {
    map::KeyFrame frame = run.map.key_frames[i];
    frame.id.session = i < 2 ? 0 : 1;
    map.key_frames.insert(frame);
  }
  run.map = map;
  run.decisions.clear();
  return run;
}

TEST(Report, sessionsHaveTwoColoursAndALegend) {
  ScratchFolder folder;
  plugins::ReportOutput({}, contextFor(folder.path())).finish(continuedRun().view());
  const std::string html = contentOf(folder / "report.html");
  EXPECT_NE(html.find("<path class=\"earlier\" d=\"M"), std::string::npos);
  EXPECT_NE(html.find("<path class=\"track\" d=\"M"), std::string::npos);
  EXPECT_NE(html.find("earlier sessions: 1"), std::string::npos);
  EXPECT_EQ(reportOf(boxRun()).find("earlier sessions"), std::string::npos) << "there is one session";
  mrpt::img::CImage picture;
  ASSERT_TRUE(picture.loadFromFile(folder / "map.png"));
  int earlier = 0, newest = 0;
  for (unsigned row = 0; row < picture.getHeight(); ++row) {
    for (unsigned column = 0; column < picture.getWidth(); ++column) {
      const int red = picture.at<std::uint8_t>(column, row, 2), green = picture.at<std::uint8_t>(column, row, 1),
                blue = picture.at<std::uint8_t>(column, row, 0);
      earlier += red > green + 100 && red > blue;
      newest += blue > red + 100 && blue > green + 60;
    }
  }
  EXPECT_GT(earlier, 50);
  EXPECT_GT(newest, 50);
}

TEST(Report, chartsSayWhatTheyShowInWordsOfUsers) {
  RunRecord run = boxRun();
  run.times.add(mapper::Stage::engine, "", 0.03);
  run.times.add(mapper::Stage::perception_wait, "", 0.04);
  run.times.add(mapper::Stage::job_wait, "", 0.04);
  run.times.add(mapper::Stage::source, "", 0.04);
  run.times.add(mapper::Stage::plugin, "loop_closure", 0.02);
  run.times.add(mapper::Stage::output, "map", 0.02);
  const std::string html = reportOf(run);
  for (const auto& [stage, total] : run.times.totals())
    EXPECT_EQ(html.find(">" + stage + "<"), std::string::npos) << stage << " is a name from the code";
  for (const char* words : {"optimizing the map", "reading the log", "measuring by loop closure", "writing map"})
    EXPECT_NE(html.find(words), std::string::npos) << words;
}

TEST(Report, thePaceIsThatOfTheMappingBeforeTheOutputs) {
  RunRecord run = boxRun();
  EXPECT_EQ(reportOf(run).find("own pace"), std::string::npos) << "it is not known";
  const double seconds = base::secondsBetween(run.map.key_frames.front().stamp, run.map.key_frames.back().stamp);
  run.times.setMappingSeconds(seconds / 6.3);
  EXPECT_NE(reportOf(run).find("6.3 &#215;"), std::string::npos);
}

TEST(Report, closuresStateTheirReasons) {
  const std::string html = reportOf(boxRun());
  const std::size_t refused = html.find("<g class=\"refused\">"), accepted = html.find("<g class=\"accepted\">");
  ASSERT_LT(refused, accepted);
  EXPECT_EQ(countOf(html.substr(refused, accepted - refused), "<line "), 1u);
  EXPECT_NE(html.find("loop closure 0:2 to 0:0: refused: turned &lt;too&gt; far\ncorrection 2 m"), std::string::npos);
  EXPECT_NE(html.find("loop closure 0:2 to 0:0: accepted\ncorrection 0.125 m"), std::string::npos);
}

TEST(Report, aLongLogIsCutWithANoteAndCountedWhole) {
  RunRecord run = boxRun();
  mapper::Decision near(run.map.key_frames[1], "laser", "gate");
  near.accepted = true;
  near.reason = "near enough";
  run.decisions.insert(run.decisions.begin(), 3000, near);
  const std::string html = reportOf(run);
  const std::string log = html.substr(html.find("id=\"log\""));
  EXPECT_EQ(countOf(log, "<tr data-verdict"), 2000u);
  EXPECT_NE(log.find("turned &lt;too&gt; far"), std::string::npos) << "refusals are not cut off";
  EXPECT_NE(html.find("2&#8239;000 of 3&#8239;004 decisions are listed"), std::string::npos);
  EXPECT_NE(html.find("<td>near enough</td><td class=\"num\">3&#8239;000</td>"), std::string::npos);
}

TEST(Report, aMapWithoutScansShowsItsTrajectory) {
  RunRecord run = boxRun();
  clearObservations(run);
  const std::string html = reportOf(run);
  EXPECT_EQ(tagFault(html), "");
  EXPECT_NE(html.find("class=\"track\" d=\"M"), std::string::npos);
}

TEST(Html, base64OfKnownTexts) {
  EXPECT_EQ(draw::encodeBase64(""), "");
  EXPECT_EQ(draw::encodeBase64("f"), "Zg==");
  EXPECT_EQ(draw::encodeBase64("fo"), "Zm8=");
  EXPECT_EQ(draw::encodeBase64("foo"), "Zm9v");
  EXPECT_EQ(draw::encodeBase64("foob"), "Zm9vYg==");
}

TEST(Html, thousandsAreGrouped) {
  EXPECT_EQ(plugins::grouped(999), "999");
  EXPECT_EQ(plugins::grouped(1234567), "1&#8239;234&#8239;567");
}

TEST(Chart, thinsLongCurvesButKeepsPeaks) {
  plugins::Chart chart{"t", "x", "y", false, {{"s", 1, plugins::ChartSeries::Form::line, {}, {}}}};
  for (int i = 0; i < 100000; ++i) {
    chart.series[0].x.push_back(i);
    chart.series[0].y.push_back(i == 54321 ? 1000 : 1);
  }
  const std::string html = plugins::drawChart(chart);
  EXPECT_LT(html.size(), 40000u);
  EXPECT_EQ(tagFault(html), "");
  // 4 % of the range of 204 units is free above the peak.
  EXPECT_NE(html.find(" 17.8L"), std::string::npos) << html;
}

TEST(Chart, nothingFiniteIsNoChart) {
  plugins::Chart chart{"t", "x", "y", false, {{"s", 1, plugins::ChartSeries::Form::line, {0, 1}, {NAN, INFINITY}}}};
  EXPECT_EQ(plugins::drawChart(chart), "");
  chart.logarithmic = true;
  chart.series[0].y = {0, -1};
  EXPECT_EQ(plugins::drawChart(chart), "");
}

}  // namespace
}  // namespace report_output_test

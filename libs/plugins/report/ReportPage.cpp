#include "ReportPage.h"

#include <omnimapper/base/Numbers.h>
#include <omnimapper/derived/RunMetrics.h>
#include <omnimapper/draw/Markup.h>

#include <cmath>

#include "Html.h"
#include "ReportCurves.h"
#include "ReportLandmarks.h"
#include "ReportMap.h"
#include "ReportStyle.h"
#include "ReportTables.h"

namespace omnimapper::plugins {

namespace {

constexpr std::size_t kMostRefusedClosures = 1500;

std::string metricTile(const std::string& value, const std::string& name) {
  return "<div><b>" + value + "</b><span>" + name + "</span></div>";
}

std::string duration(double seconds) {
  if (seconds < 120) return base::fixed(seconds, seconds < 10 ? 2 : 1) + " s";
  const auto minutes = static_cast<long>(std::lround(seconds / 60));
  if (minutes < 120) return std::to_string(minutes) + " min";
  return base::fixed(seconds / 3600, 1) + " h";
}

std::string large(double value) {
  return value < 1000 || value > 1e15 ? base::brief(value, 4) : grouped(static_cast<std::size_t>(std::llround(value)));
}

std::string drawMetrics(const ReportInput& input, const derived::RunMetrics& metrics) {
  const mapper::View& view = input.view;
  std::string html =
      metricTile(grouped(view.map.key_frames.size()), "key frames") +
      metricTile(base::fixed(metrics.travel, metrics.travel < 100 ? 1 : 0) + " m", "distance travelled") +
      metricTile(duration(metrics.log_seconds), "recorded");
  if (view.map_is_held) {
    html += metricTile(grouped(metrics.located) + " of " + grouped(metrics.localized), "new key frames located");
  }
  if (input.picture) {
    html += metricTile(base::fixed(input.picture->maxX() - input.picture->min_x, 0) + " &#215; " +
                           base::fixed(input.picture->max_y - input.picture->minY(), 0) + " m",
                       "mapped");
  }
  if (!input.landmarks.empty()) html += metricTile(grouped(input.landmarks.size()), "landmarks");
  html += metricTile(grouped(metrics.closures), "loop closures") +
          metricTile(grouped(metrics.refused_closures), "closures refused") +
          metricTile(grouped(view.graph.factors().size()), "factors") +
          metricTile(large(view.graph.chi2()), "chi-square") +
          metricTile(duration(metrics.mapping_seconds), "of mapping");
  if (const auto pace = derived::paceText(metrics.run_seconds, metrics.mapping_seconds); !pace.empty())
    html += metricTile(pace + " &#215;", "the log's own pace");
  return "<div class=\"figures\">" + html + "</div>\n";
}

std::string drawWarnings(const std::vector<std::string>& warnings) {
  if (warnings.empty()) return {};
  std::string items;
  for (const std::string& warning : warnings) items += "<li>" + draw::escapeMarkup(warning) + "</li>";
  return "<section class=\"card warnings\"><h2>Warnings</h2><ul>" + items + "</ul></section>\n";
}

// The numbers behind the verdict are in summary.json.
std::string drawVerdict(const mapper::Verdict& verdict) {
  if (verdict.evidence.empty()) return {};
  return "<section class=\"card\"><h2>Verdict: " + mapper::toString(verdict.answer) + "</h2><p>" +
         draw::escapeMarkup(sentenceOf(verdict)) + "</p></section>\n";
}

std::string drawConfig(const std::string& text) {
  if (text.empty()) return {};
  return "<details class=\"card\"><summary>Settings of this run (INI)</summary><pre>" + draw::escapeMarkup(text) +
         "</pre></details>\n";
}

std::string charts(const std::string& title, const std::string& html) {
  return html.empty() ? "" : "<h2>" + title + "</h2>\n<div class=\"charts\">\n" + html + "</div>\n";
}

}  // namespace

std::string drawReport(const ReportInput& input) {
  const mapper::View& view = input.view;
  const std::string title = draw::escapeMarkup(input.context.title.empty() ? "Map" : input.context.title);
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n<meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\"/>\n<title>" +
      title + " - OmniMapper</title>\n<style>";
  html += kReportStyle;
  html +=
      "</style>\n</head>\n<body>\n<main>\n<header><h1>" + title + "</h1><p>Mapping report of OmniMapper</p></header>\n";
  html += drawVerdict(view.verdict) + drawWarnings(view.warnings) +
          drawMetrics(input, derived::metricsOf(view, input.trajectory));
  if (input.picture)
    html +=
        drawReportMap(*input.picture, input.drawn_landmarks, input.trajectory, input.closures, kMostRefusedClosures);
  html += drawLandmarkTable(input.landmarks, startOf(view.map)) +
          charts("Measurements", drawSensorBars(input.landmarks) + drawFeatureCurves(view));
  html += charts("Error", drawErrorCurves(view)) + charts("Time", drawTimeCurves(view));
  html += drawSessionTable(view.map) + drawReasonTable(view.decisions) +
          drawDecisionTable(view.map, view.decisions, input.max_rows);
  html += drawCountTables(view) + drawConfig(input.context.config_text);
  html += "</main>\n<script>";
  html += kReportScript;
  return html + "</script>\n</body>\n</html>\n";
}

}  // namespace omnimapper::plugins

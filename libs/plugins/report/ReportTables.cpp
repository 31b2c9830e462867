#include "ReportTables.h"

#include <omnimapper/base/Numbers.h>
#include <omnimapper/derived/SessionAlignment.h>
#include <omnimapper/draw/Markup.h>
#include <omnimapper/map/SessionMetrics.h>

#include <algorithm>
#include <set>

#include "DecisionText.h"
#include "Html.h"

namespace omnimapper::plugins {

namespace {

std::string verdict(bool accepted) {
  return accepted ? "<td><span class=\"yes\">accepted</span></td>" : "<td><span class=\"no\">refused</span></td>";
}

std::string row(const mapper::Decision& d, base::Stamp start) {
  return "<tr data-verdict=\"" + std::string(d.accepted ? "accepted" : "refused") + "\" data-kind=\"" +
         draw::escapeMarkup(d.kind) + "\">" + numberCell(toString(d.from)) +
         numberCell(base::fixed(base::secondsBetween(start, d.stamp), 1)) + cell(draw::escapeMarkup(d.plugin)) +
         cell(draw::escapeMarkup(d.kind)) + numberCell(d.to ? toString(*d.to) : "") + verdict(d.accepted) +
         cell(draw::escapeMarkup(d.reason)) + cell(draw::escapeMarkup(numbersText(d))) + "</tr>\n";
}

/// The decisions to list: all, or if there are too many, refusals and those about two key frames first.
std::vector<const mapper::Decision*> listed(const mapper::DecisionLog& decisions, std::size_t max_rows) {
  std::vector<const mapper::Decision*> rows;
  for (const bool is_important : {true, false}) {
    for (const mapper::Decision& d : decisions) {
      if (rows.size() < max_rows && is_important == (!d.accepted || d.to.has_value())) rows.push_back(&d);
    }
  }
  std::sort(rows.begin(), rows.end());  // back in the order of the log, which is contiguous
  return rows;
}

std::string options(const mapper::DecisionLog& decisions) {
  std::set<std::string> kinds;
  for (const mapper::Decision& d : decisions) kinds.insert(d.kind);
  std::string html = "<option value=\"\">every kind</option>";
  for (const std::string& kind : kinds) {
    html += "<option value=\"" + draw::escapeMarkup(kind) + "\">" + draw::escapeMarkup(kind) + "</option>";
  }
  return html;
}

template <class Counts>
std::string countTable(const std::string& title, const Counts& counts) {
  std::string rows;
  for (const auto& [name, count] : counts) {
    if (count == 0) continue;
    std::string words = name;
    std::replace(words.begin(), words.end(), '_', ' ');
    rows += "<tr>" + cell(draw::escapeMarkup(words)) + numberCell(grouped(count)) + "</tr>";
  }
  return rows.empty() ? ""
                      : "<section class=\"card\"><h3>" + title + "</h3><table class=\"plain\"><tbody>" + rows +
                            "</tbody></table></section>\n";
}

}  // namespace

std::string drawSessionTable(const map::Map& map) {
  if (map.sessions.size() < 2) return {};
  std::string rows;
  for (const auto& metrics : map::sessionMetrics(map)) {
    const auto session = std::find_if(map.sessions.begin(), map.sessions.end(),
                                      [&](const auto& other) { return other.number == metrics.number; });
    if (session == map.sessions.end()) continue;
    const bool first = session == map.sessions.begin();
    rows += "<tr>" + numberCell(std::to_string(metrics.number)) + cell(draw::escapeMarkup(session->title)) +
            numberCell(grouped(metrics.key_frames)) + numberCell(base::fixed(metrics.travel, 1)) +
            numberCell(base::fixed(metrics.seconds, 1)) +
            cell(first ? "" : draw::escapeMarkup(derived::alignedText(*session))) + "</tr>\n";
  }
  return "<section class=\"card\"><h2>Sessions</h2><div class=\"scroll\"><table class=\"sortable\"><thead><tr><th "
         "class=\"num\">session</th><th>log</th><th class=\"num\">key frames</th><th class=\"num\">travel [m]</th><th "
         "class=\"num\">time [s]</th><th>aligned</th></tr></thead><tbody>\n" +
         rows + "</tbody></table></div></section>\n";
}

base::Stamp startOf(const map::Map& map) {
  const auto& frames = map.key_frames;
  return frames.empty() ? base::Stamp() : frames[frames.lowerBound(frames.back().id.session, base::Stamp())].stamp;
}

std::string drawReasonTable(const mapper::DecisionLog& decisions) {
  if (decisions.empty()) return {};
  std::string rows;
  for (const derived::ReasonCount& count : derived::countReasons(decisions)) {
    rows += "<tr>" + cell(draw::escapeMarkup(count.plugin)) + cell(draw::escapeMarkup(count.kind)) +
            verdict(count.accepted) + cell(draw::escapeMarkup(count.reason)) + numberCell(grouped(count.count)) +
            "</tr>\n";
  }
  return "<section class=\"card\"><h2>Decisions by reason</h2><div class=\"scroll\"><table "
         "class=\"sortable\"><thead><tr>"
         "<th>plugin</th><th>kind</th><th>verdict</th><th>reason</th><th "
         "class=\"num\">count</th></tr></thead><tbody>\n" +
         rows + "</tbody></table></div></section>\n";
}

std::string drawDecisionTable(const map::Map& map, const mapper::DecisionLog& decisions, std::size_t max_rows) {
  if (decisions.empty()) return {};
  const base::Stamp start = map.key_frames.empty() ? decisions.front().stamp : startOf(map);
  const auto rows = listed(decisions, max_rows);
  std::string note;
  if (rows.size() < decisions.size()) {
    note = "<p class=\"note\">" + grouped(rows.size()) + " of " + grouped(decisions.size()) +
           " decisions are listed, refusals and closures first; the table above counts all of them.</p>";
  }
  std::string html =
      "<section class=\"card\"><h2>Decision log</h2>" + note +
      "<div class=\"filters\"><select id=\"verdict\" aria-label=\"verdict\"><option value=\"\">accepted and "
      "refused</option>"
      "<option value=\"accepted\">accepted</option><option value=\"refused\">refused</option></select>"
      "<select id=\"kind\" aria-label=\"kind\">" +
      options(decisions) +
      "</select><input id=\"words\" type=\"search\" placeholder=\"words in a row\" aria-label=\"words\"/>"
      "<span id=\"shown\"></span></div><div class=\"scroll tall\"><table class=\"sortable\" id=\"log\"><thead><tr>"
      "<th class=\"num\">key frame</th><th class=\"num\">time [s]</th><th>plugin</th><th>kind</th><th "
      "class=\"num\">to</th>"
      "<th>verdict</th><th>reason</th><th>numbers</th></tr></thead><tbody>\n";
  for (const mapper::Decision* decision : rows) html += row(*decision, start);
  return html + "</tbody></table></div></section>\n";
}

std::string drawCountTables(const mapper::View& view) {
  const derived::GraphMetrics graph = derived::metricsOf(view.graph);
  return "<div class=\"columns\">" + countTable("Observations", derived::namedCounts(view.counts)) +
         countTable("Variables by kind", graph.variables_by_kind) +
         countTable("Factors by kind", graph.factors_by_kind) +
         countTable("Factors by plugin", graph.factors_by_owner) + "</div>\n";
}

}  // namespace omnimapper::plugins

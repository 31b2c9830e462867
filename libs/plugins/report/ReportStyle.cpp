#include "ReportStyle.h"

namespace omnimapper::plugins {

const std::string_view kReportStyle = R"css(
:root { color-scheme: light dark; --page: #f4f6f8; --card: #ffffff; --text: #18212f; --soft: #5b6878; --line: #dde3ea;
  --yes: #15803d; --no: #c2352b; --warn: #fff6e0; --warn-line: #e5b84b;
  --s1: #2563eb; --s2: #d97706; --s3: #15803d; --s4: #9333ea; }
@media (prefers-color-scheme: dark) {
  :root { --page: #10151c; --card: #1a212b; --text: #e4e9ef; --soft: #97a4b4; --line: #2d3743;
    --yes: #4ade80; --no: #f87171; --warn: #33290f; --warn-line: #8a6d1f;
    --s1: #6ea0ff; --s2: #f5a742; --s3: #4ade80; --s4: #c48bfa; }
}
* { box-sizing: border-box; }
body { margin: 0; background: var(--page); color: var(--text); font: 15px/1.5 system-ui, "Segoe UI", Roboto, sans-serif; }
main { max-width: 1180px; margin: 0 auto; padding: 28px 20px 60px; }
header { margin-bottom: 20px; }
h1 { font-size: 26px; line-height: 1.2; margin: 0; overflow-wrap: anywhere; }
h2 { font-size: 18px; margin: 0 0 10px; }
h3 { font-size: 15px; margin: 0 0 6px; }
header p, .note { color: var(--soft); margin: 4px 0 0; font-size: 13.5px; }
.card { background: var(--card); border: 1px solid var(--line); border-radius: 10px; padding: 16px 18px; margin: 0 0 18px; }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(max(140px, 16%), 1fr)); gap: 12px; margin-bottom: 18px; }
.figures div { background: var(--card); border: 1px solid var(--line); border-radius: 10px; padding: 12px 14px; }
.figures b { display: block; font-size: 22px; line-height: 1.2; font-variant-numeric: tabular-nums; white-space: nowrap; }
.figures span { color: var(--soft); font-size: 13px; }
.warnings { background: var(--warn); border-color: var(--warn-line); }
.warnings ul { margin: 0; padding-left: 20px; }
.map { padding: 12px; }
#map { display: block; width: 100%; max-height: 82vh; background: #e2e7ed; border-radius: 6px; touch-action: pan-y; cursor: grab; }
#map.close image { image-rendering: pixelated; }
#map path.track, #map path.earlier { fill: none; stroke: #2563eb; stroke-width: 2; stroke-linejoin: round; vector-effect: non-scaling-stroke; }
#map circle { stroke: #2563eb; stroke-width: 2.5; vector-effect: non-scaling-stroke; }
#map circle.start { fill: #ffffff; } #map circle.end { fill: #2563eb; }
#map path.earlier, #map circle.earlier { stroke: #db2777; } #map circle.earlier.end { fill: #db2777; }
#map g.accepted line { stroke: #16a34a; stroke-width: 2; vector-effect: non-scaling-stroke; }
#map g.refused line { stroke: #dc2626; stroke-opacity: 0.35; stroke-width: 1.2; stroke-dasharray: 5 4; vector-effect: non-scaling-stroke; }
#map g.landmarks path { stroke: currentColor; stroke-width: 4; stroke-linecap: round; fill: none; vector-effect: non-scaling-stroke; }
#map g.landmarks path.area { stroke-width: 1.6; fill: currentColor; fill-opacity: 0.28; }
#map g.landmarks path.point { stroke-width: 9; }
#map g.landmarks text.caption { font: 11px sans-serif; fill: currentColor; stroke: none; }
#map g.landmarks path.moved { stroke-width: 2; stroke-dasharray: 1 5; fill: none; }
#map g.landmarks path.floor { fill-opacity: 0.08; stroke-dasharray: 6 4; pointer-events: stroke; }
#map g.landmarks g.faint path { stroke-width: 1.2; } #map g.landmarks g.faint path.area { fill-opacity: 0.1; }
#map g.landmarks g:hover path { stroke-width: 7; }
#map line:hover { stroke-width: 5; stroke-opacity: 1; }
#map path.scale { fill: none; stroke: #18212f; stroke-width: 1.5; vector-effect: non-scaling-stroke; }
#map text.scale { fill: #18212f; font-family: inherit; }
.toggles, .filters { display: flex; flex-wrap: wrap; gap: 6px 18px; align-items: center; margin: 0 4px 10px; font-size: 14px; }
.toggles label { display: inline-flex; align-items: center; gap: 6px; }
.toggles i { width: 22px; height: 0; border-top: 3px solid; }
img.photograph { display: block; max-width: 120px; max-height: 40px; }
.swatch { display: inline-block; width: 10px; height: 10px; border-radius: 3px; margin-right: 6px; }
.kt { color: #2563eb; } .ke { color: #db2777; } .ka { color: #16a34a; } .toggles .kr { color: #dc2626; border-top-style: dashed; border-top-width: 2px; }
.zoom { margin-left: auto; display: inline-flex; gap: 6px; }
button, select, input[type=search] { font: inherit; font-size: 14px; color: inherit; background: var(--card); border: 1px solid var(--line); border-radius: 6px; padding: 4px 10px; }
.columns { display: grid; grid-template-columns: repeat(auto-fit, minmax(300px, 1fr)); gap: 0 18px; align-items: start; }
.charts { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 440px), 1fr)); gap: 0 18px; align-items: start; }
figure { margin: 0 0 18px; } figcaption { font-size: 14px; margin-bottom: 6px; }
figcaption small { color: var(--soft); } .legend { float: right; font-size: 13px; color: var(--soft); }
.key { margin-left: 12px; white-space: nowrap; } .key i { display: inline-block; width: 10px; height: 10px; border-radius: 3px; margin-right: 5px; background: currentColor; }
.chart svg { display: block; width: 100%; height: auto; } .chart text { fill: var(--soft); font-size: 12px; }
.grid { stroke: var(--line); stroke-width: 1; } .axis { stroke: var(--soft); stroke-width: 1; }
.curve { fill: none; stroke-width: 1.6; stroke-linejoin: round; } .dots { stroke-width: 4; stroke-linecap: round; stroke-opacity: 0.55; }
path.s1 { stroke: var(--s1); } path.s2 { stroke: var(--s2); } path.s3 { stroke: var(--s3); } path.s4 { stroke: var(--s4); }
i.s1 { color: var(--s1); } i.s2 { color: var(--s2); } i.s3 { color: var(--s3); } i.s4 { color: var(--s4); }
.bars { display: grid; grid-template-columns: auto 1fr auto; gap: 5px 12px; align-items: center; font-size: 13.5px; }
.track i { display: block; height: 12px; border-radius: 3px; background: var(--s1); min-width: 1px; }
.scroll { overflow-x: auto; } .tall { max-height: 560px; overflow-y: auto; }
table { border-collapse: collapse; width: 100%; font-size: 13.5px; }
th, td { text-align: left; padding: 4px 12px 4px 0; border-bottom: 1px solid var(--line); vertical-align: top; }
th { position: sticky; top: 0; background: var(--card); color: var(--soft); font-weight: 600; white-space: nowrap; }
.sortable th { cursor: pointer; }
.num { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
.yes { color: var(--yes); } .no { color: var(--no); }
#shown { color: var(--soft); }
details summary { cursor: pointer; font-weight: 600; }
pre { overflow-x: auto; font: 12.5px/1.5 ui-monospace, Menlo, Consolas, monospace; margin: 12px 0 0; }
@media (max-width: 560px) { main { padding: 18px 12px 40px; } .legend { float: none; display: block; } .key { margin: 0 12px 0 0; } .zoom { margin-left: 0; } .scroll th, .scroll .num { white-space: nowrap; } .scroll td { min-width: 90px; } }
)css";

const std::string_view kReportScript = R"js(
(function () {
  var log = document.getElementById('log');
  if (log) {
    var rows = Array.prototype.slice.call(log.tBodies[0].rows), shown = document.getElementById('shown');
    var controls = ['verdict', 'kind', 'words'].map(function (id) { return document.getElementById(id); });
    var filter = function () {
      var verdict = controls[0].value, kind = controls[1].value, words = controls[2].value.toLowerCase(), count = 0;
      rows.forEach(function (row) {
        var fits = (!verdict || row.dataset.verdict === verdict) && (!kind || row.dataset.kind === kind) &&
          (!words || row.textContent.toLowerCase().indexOf(words) >= 0);
        row.hidden = !fits;
        if (fits) count += 1;
      });
      shown.textContent = count + ' of ' + rows.length + ' rows';
    };
    controls.forEach(function (control) { control.addEventListener('input', filter); });
    filter();
  }
  document.querySelectorAll('table.sortable').forEach(function (table) {
    table.querySelectorAll('th').forEach(function (head, column) {
      var direction = 1;
      head.addEventListener('click', function () {
        var body = table.tBodies[0], key = function (row) { return row.cells[column].textContent; };
        var value = function (text) { return parseFloat(text.replace(/^\d+:/, '').replace(/\u202f/g, '')); };
        var numeric = head.classList.contains('num');
        Array.prototype.slice.call(body.rows).sort(function (a, b) {
          var x = key(a), y = key(b);
          return direction * (numeric ? (value(x) || 0) - (value(y) || 0) : x.localeCompare(y));
        }).forEach(function (row) { body.appendChild(row); });
        direction = -direction;
      });
    });
  });
  var map = document.getElementById('map');
  if (!map) return;
  document.querySelectorAll('[data-layer]').forEach(function (box) {
    box.addEventListener('change', function () {
      map.querySelector('g.' + box.dataset.layer).style.display = box.checked ? '' : 'none';
    });
  });
  var view = map.viewBox.baseVal, whole = [view.x, view.y, view.width, view.height];
  var show = function (x, y, w, h) {
    map.setAttribute('viewBox', x + ' ' + y + ' ' + w + ' ' + h);
    map.classList.toggle('close', w < map.clientWidth / 2);
  };
  var place = function (event) {
    var point = map.createSVGPoint();
    point.x = event.clientX; point.y = event.clientY;
    return point.matrixTransform(map.getScreenCTM().inverse());
  };
  var zoom = function (factor, x, y) {
    var w = Math.min(whole[2] * 2, Math.max(20, view.width * factor)), f = w / view.width;
    show(x - (x - view.x) * f, y - (y - view.y) * f, w, view.height * f);
  };
  document.querySelectorAll('[data-zoom]').forEach(function (button) {
    button.addEventListener('click', function () {
      var factor = parseFloat(button.dataset.zoom);
      if (factor) zoom(factor, view.x + view.width / 2, view.y + view.height / 2);
      else show(whole[0], whole[1], whole[2], whole[3]);
    });
  });
  map.addEventListener('wheel', function (event) {
    if (!event.ctrlKey && !event.metaKey) return;
    event.preventDefault();
    var at = place(event);
    zoom(event.deltaY > 0 ? 1.2 : 1 / 1.2, at.x, at.y);
  }, { passive: false });
  var held = null;
  map.addEventListener('pointerdown', function (event) { if (event.pointerType === 'mouse') { held = place(event); map.setPointerCapture(event.pointerId); } });
  map.addEventListener('pointermove', function (event) {
    if (!held) return;
    var at = place(event);
    show(view.x + held.x - at.x, view.y + held.y - at.y, view.width, view.height);
  });
  map.addEventListener('pointerup', function () { held = null; });
})();
)js";

}  // namespace omnimapper::plugins

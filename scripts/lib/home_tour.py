"""Judges the labels of a simulated tour by the truth; a part of scripts/bench-home_tour.

answers LOG MAP    prints a table of commands: an edit "choose N" for each question that has the right thing among its
                   choices, one second after the gesture
judge LOG MAP [LOG_OF_MAP]
                   prints the numbers of labels that are right, wrong, asked back with the right thing among the choices,
                   asked back without it, and not given; and what became of each on standard error
strip LOG MAP SVG  draws the gestures from above, each with what it means in the map
Each after the folder of the programs.
"""

import csv
import html
import json
import math
import re
import subprocess
import sys


def read_tum(path):
    with open(path) as file:
        return [[float(word) for word in line.split()] for line in file if line.strip() and line[0] != "#"]


def yaw_of(row):
    return 2 * math.atan2(row[6], row[7])


class Frames:
    """The motion from the frame of the map to that of the truth, by the pose at the first stamp of both."""

    def __init__(self, log, map_folder):
        truth = {f"{row[0]:.4f}": row for row in read_tum(f"{log}/truth.tum")}
        for row in read_tum(f"{map_folder}/trajectory.tum"):
            there = truth.get(f"{row[0]:.4f}")
            if there is None:
                continue
            self.turn = yaw_of(there) - yaw_of(row)
            c, s = math.cos(self.turn), math.sin(self.turn)
            self.shift = (there[1] - c * row[1] + s * row[2], there[2] - s * row[1] - c * row[2])
            return
        raise SystemExit(f"{map_folder}: no stamp of its trajectory is in the truth")

    def point(self, p):
        c, s = math.cos(self.turn), math.sin(self.turn)
        return (c * p[0] - s * p[1] + self.shift[0], s * p[0] + c * p[1] + self.shift[1], p[2])

    def direction(self, d):
        c, s = math.cos(self.turn), math.sin(self.turn)
        return (c * d[0] - s * d[1], s * d[0] + c * d[1], d[2])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def norm(a):
    return math.sqrt(dot(a, a))


def distance_to_polygon(point, outline, normal):
    """Of a point to a flat polygon in space."""
    origin = outline[0]
    height = dot(minus(point, origin), normal)
    foot = minus(point, tuple(height * n for n in normal))
    axis = max(range(3), key=lambda i: abs(normal[i]))
    keep = [i for i in range(3) if i != axis]
    inside = False
    least = math.inf
    for k, a in enumerate(outline):
        b = outline[k - 1]
        ay, by, py = a[keep[1]], b[keep[1]], foot[keep[1]]
        if (ay > py) != (by > py):
            x = a[keep[0]] + (py - ay) / (by - ay) * (b[keep[0]] - a[keep[0]])
            inside ^= x > foot[keep[0]]
        edge = minus(b, a)
        share = max(0, min(1, dot(minus(point, a), edge) / max(1e-12, dot(edge, edge))))
        least = min(least, norm(minus(point, tuple(x + share * e for x, e in zip(a, edge)))))
    return abs(height) if inside else least


class Truth:
    def __init__(self, log):
        self.world = json.load(open(f"{log}/landmarks.json"))
        names_of_objects = {each["name"] for each in self.world["objects"]}
        people = {body for person in self.world["people"] for body in person["bodies"]}
        self.surfaces = []
        for each in json.load(open(f"{log}/surfaces.json"))["surfaces"]:
            body = each["name"].split("/")[0]
            if body in names_of_objects or body in {name.split("/")[0] for name in people}:
                continue
            for part in each["parts"]:
                self.surfaces.append({**each, "outline": part["outline"]})
        self.objects = {}
        for each in self.world["objects"]:
            self.objects[each["name"]] = each["places"][0]["pose"]["position"]

    def surface_at(self, point, normal=None):
        """The name of the surface nearest to a point, of those that face about the same way."""

        def off(surface):
            n = surface["normal"]
            if normal is not None and dot(n, normal) < 0.8:
                return math.inf
            return distance_to_polygon(point, surface["outline"], n)

        return min(self.surfaces, key=off)["name"]

    def object_at(self, point):
        return min(self.objects, key=lambda name: norm(minus(self.objects[name], point)))

    def requests(self):
        """Each request for a label with the act of pointing that follows it; none for a place."""
        acts = [act for person in self.world["people"] for act in person["pointing"]]
        for row in csv.DictReader(open(COMMANDS)):
            if row["kind"] != "label":
                continue
            time = float(row["stamp_s"]) - self.world["start"]
            act = next((act for act in acts if act["begin"] >= time), None)
            yield row, None if row["subject"] == "place" else act


def places_called(programs, map_folder, text):
    ran = subprocess.run([f"{programs}/omnimapper-query", map_folder, "--json", "find", text], capture_output=True, text=True)
    return json.loads(ran.stdout)["matches"] if ran.returncode == 0 else []


def questions(map_folder):
    """Of each label the ids of the last choices."""
    page = html.unescape(open(f"{map_folder}/report.html").read())
    return {text: ids.split(", ") for text, ids in re.findall(r"'([^'<]*)' may be each of the landmarks ([0-9:, ]*): which", page)}


def body_of(name):
    return name.split("/")[0]


def is_right(truth, frames, request, act, place):
    point = frames.point(place["position_m"])
    if request["subject"] == "object":
        return truth.object_at(point) == act["target"]
    normal = place["normal"] and frames.direction(place["normal"])
    target = act["target"] or truth.surface_at(act["target_position"])
    found = truth.surface_at(point, normal)
    # What belongs to one piece of furniture is one thing; the walls of a room are several.
    if found == target or (act["target"] and body_of(found) == body_of(target)):
        return True
    # The walls of two rooms that lie in one plane are one landmark.
    x, y, z = act["target_position"]
    extent = place["extent"]
    along = [(frames.point((*a, 0)), frames.point((*b, 0))) for a, b in extent["lines"]]
    is_high = extent["bottom_m"] - 0.15 < z < extent["top_m"] + 0.15
    return is_high and any(distance_to_line((x, y, 0), a, b) < 0.2 for a, b in along)


def distance_to_line(point, a, b):
    edge = minus(b, a)
    share = max(0, min(1, dot(minus(point, a), edge) / max(1e-12, dot(edge, edge))))
    return norm(minus(point, tuple(x + share * e for x, e in zip(a, edge))))


def outcome(programs, truth, frames, request, act, map_folder):
    text = request["text"]
    given = [p for p in places_called(programs, map_folder, text) if text == p["properties"].get("name") or
             (text == p["label"] and p["kind"] in ("place", "region"))]
    if act is None:
        return ("right" if given else "nothing"), None
    if given:
        return ("right" if is_right(truth, frames, request, act, given[0]) else "wrong"), given[0]["id"]
    ids = questions(map_folder).get(text)
    if not ids:
        return "nothing", None
    for number, landmark in enumerate(ids, 1):
        found = places_called(programs, map_folder, landmark)
        if found and is_right(truth, frames, request, act, found[0]):
            return "asked", number
    return "asked in vain", ",".join(ids)


COMMANDS = "rawlogs/home_tour_commands.csv"
STRIP_COLUMNS, SCALE = 4, 26  # pixels a metre


def drawn_surfaces(truth, low):
    """Level surfaces from above, and upright ones as lines."""
    text = ""
    for surface in truth.surfaces:
        if surface["class"] in ("ceiling", "floor", "object"):
            continue
        corners = " ".join(f"{SCALE * (x - low[0]):.1f},{SCALE * (low[1] - y):.1f}" for x, y, _ in surface["outline"])
        colour = "#333" if surface["class"] in ("wall", "window", "door frame") else "#999"
        text += f'<polygon points="{corners}" fill="#eee" stroke="{colour}" stroke-width="0.8"/>'
    return text


def drawn_place(frames, place, low):
    text = ""
    extent = place["extent"]
    walks = extent["outlines"] + extent["lines"]
    for walk in walks:
        corners = [frames.point((*point, 0)) for point in walk]
        points = " ".join(f"{SCALE * (x - low[0]):.1f},{SCALE * (low[1] - y):.1f}" for x, y, _ in corners)
        text += f'<polygon points="{points}" fill="#2a9d5c" fill-opacity="0.5" stroke="#1b7837" stroke-width="2.5"/>'
    return text


def strip(programs, truth, frames, log, map_folder, file):
    moments = [json.loads(line)["truth"] for line in open(f"{log}/truth/skeleton.jsonl")]
    poses = read_tum(f"{log}/truth.tum")
    start = truth.world["start"]
    corners = [corner for surface in truth.surfaces for corner in surface["outline"]]
    low = (min(c[0] for c in corners), max(c[1] for c in corners))
    wide = SCALE * (max(c[0] for c in corners) - low[0]) + 12
    high = SCALE * (low[1] - min(c[1] for c in corners)) + 34
    panels = [each for each in truth.requests() if each[1] is not None]
    rows = -(-len(panels) // STRIP_COLUMNS)
    text = f'<svg xmlns="http://www.w3.org/2000/svg" width="{STRIP_COLUMNS * wide:.0f}" height="{rows * high:.0f}" font-family="sans-serif">'
    text += '<rect width="100%" height="100%" fill="white"/>'
    plan = drawn_surfaces(truth, low)

    def at(point):
        return f"{SCALE * (point[0] - low[0]):.1f}", f"{SCALE * (low[1] - point[1]):.1f}"

    for number, (request, act) in enumerate(panels):
        middle = (act["begin"] + act["end"]) / 2
        moment = min(moments, key=lambda m: abs(m["time_s"] - middle))
        pose = min(poses, key=lambda row: abs(row[0] - start - middle))
        result, detail = outcome(programs, truth, frames, request, act, map_folder)
        found = places_called(programs, map_folder, detail) if isinstance(detail, str) and "," not in detail else []
        text += f'<g transform="translate({number % STRIP_COLUMNS * wide + 6:.0f} {number // STRIP_COLUMNS * high + 24:.0f})">'
        said = {"right": "", "wrong": " (wrong)", "asked": " (asked back)"}.get(result, " (not given)")
        text += f'<text x="0" y="-8" font-size="12">{act["begin"]:.0f} s: "{html.escape(request["text"])}"{said}</text>{plan}'
        text += "".join(drawn_place(frames, place, low) for place in found)
        (hx, hy), (tx, ty) = at(moment["joints_in_map"][act["arm"] + "_hand"]), at(act["target_position"])
        (px, py), (rx, ry) = at(moment["joints_in_map"]["torso"]), at(pose[1:3])
        text += f'<line x1="{hx}" y1="{hy}" x2="{tx}" y2="{ty}" stroke="#d73027" stroke-dasharray="3 2"/>'
        text += f'<line x1="{px}" y1="{py}" x2="{hx}" y2="{hy}" stroke="#d73027" stroke-width="3"/>'
        text += f'<circle cx="{px}" cy="{py}" r="5" fill="#d73027"/><circle cx="{tx}" cy="{ty}" r="2.5" fill="#d73027"/>'
        turn = -math.degrees(yaw_of(pose))
        text += f'<path d="M9 0L-6 6L-6 -6Z" fill="#2166ac" transform="translate({rx} {ry}) rotate({turn:.0f})"/></g>'
    open(file, "w").write(text + "</svg>\n")


def main():
    what, programs, log, map_folder = sys.argv[1:5]
    # A map made anew has its own drive; the truth of what was named is that of the tour.
    truth, frames = Truth(log), Frames(sys.argv[5] if what == "judge" and len(sys.argv) > 5 else log, map_folder)
    start = truth.world["start"]
    if what == "strip":
        strip(programs, truth, frames, log, map_folder, sys.argv[5])
        return
    if what == "answers":
        print("stamp_s,kind,subject,text,origin")
    counts = {}
    for request, act in truth.requests():
        result, detail = outcome(programs, truth, frames, request, act, map_folder)
        counts[result] = counts.get(result, 0) + 1
        if what == "answers":
            if result == "asked":
                print(f"{start + act['end'] - 0.2:.3f},edit,,choose {detail},anna")
        else:
            target = "the place" if act is None else act["target"] or act["target_position"]
            print(f"{request['text']:24} {str(target):24} {result} {detail or ''}", file=sys.stderr)
    if what == "judge":
        print(" ".join(str(counts.get(each, 0)) for each in ["right", "wrong", "asked", "asked in vain", "nothing"]))


main()

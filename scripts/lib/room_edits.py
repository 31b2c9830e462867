"""Edits of the rooms of a map, and what became of them in a map made anew; a part of scripts/bench-room_edits.

choose MAP         prints about ten edits, one a line, as omnimapper-rooms MAP edit takes them: four names, two doors
                   moved, two rooms split, two merged, and one deleted
judge LOG MAP OTHER_LOG OTHER_MAP
                   prints for each edit whether the other map has it, by the true motion between both frames, and a line
                   with the numbers of edits that it has, that it names as not taken over, and that are on a wrong room
"""

import html
import json
import math
import re
import sys


def read(path):
    return json.load(open(path))


def inside(point, outline):
    x, y = point
    result = False
    for k, (ax, ay) in enumerate(outline):
        bx, by = outline[k - 1]
        if (ay > y) != (by > y) and x < ax + (y - ay) / (by - ay) * (bx - ax):
            result = not result
    return result


def cut(outline, centre, along):
    """The part of a line through the centre that is in the outline: both ends, or none."""
    ahead, behind = math.inf, -math.inf
    for k, a in enumerate(outline):
        b = outline[k - 1]
        ex, ey = b[0] - a[0], b[1] - a[1]
        det = along[0] * -ey + along[1] * ex
        if abs(det) < 1e-9:
            continue
        rx, ry = a[0] - centre[0], a[1] - centre[1]
        t, s = (rx * -ey + ry * ex) / det, (along[0] * ry - along[1] * rx) / det
        if 0 <= s <= 1:
            ahead, behind = (min(ahead, t), behind) if t > 0 else (ahead, max(behind, t))
    if math.isinf(ahead) or math.isinf(behind):
        return None
    return [(centre[0] + t * along[0], centre[1] + t * along[1]) for t in (behind, ahead)]


def choose(folder):
    storey = read(f"{folder}/rooms.json")["building"]["storeys"][0]
    rooms = sorted(storey["rooms"], key=lambda room: -room["area_m2"])
    doors = sorted(storey["doors"], key=lambda door: door["id"])
    deleted = rooms[-1]["id"]
    merged = next((door for door in reversed(doors) if deleted not in door["rooms"]), None)
    gone = {deleted, *(merged["rooms"][1:] if merged else [])}
    edits = [["rename", room["id"], f"name {number}"] for number, room in enumerate(rooms) if room["id"] not in gone][:4]
    for door in [door for door in doors if deleted not in door["rooms"] and door is not merged][:2]:
        (ax, ay), (bx, by) = door["from"], door["to"]
        edits.append(["move-door", door["id"], round(ax + 0.1 * (bx - ax), 2), round(ay + 0.1 * (by - ay), 2), bx, by])
    for room in rooms:
        lines = [cut(room["outline"], room["centre"], along) for along in [(1, 0), (0, 1)]]
        lines = [line for line in lines if line and math.dist(*line) < 6]
        splits = sum(edit[0] == "split" for edit in edits)
        if splits < 2 and lines and room["id"] not in {deleted, *(merged["rooms"] if merged else [])}:
            edits.append(["split", *(round(value, 2) for end in lines[0] for value in end)])
    if merged:
        edits.append(["merge", *merged["rooms"]])
    edits.append(["delete", deleted])
    for edit in edits:
        print("\t".join(str(word) for word in edit))


def first_poses(log, folder):
    truth = {}
    for line in open(f"{log}/truth.tum"):
        row = [float(word) for word in line.split()]
        truth[f"{row[0]:.4f}"] = row
    for line in open(f"{folder}/trajectory.tum"):
        row = [float(word) for word in line.split()]
        if f"{row[0]:.4f}" in truth:
            return truth[f"{row[0]:.4f}"], row
    raise SystemExit(f"{folder}: no stamp of its trajectory is in the truth")


def motion(from_row, to_row):
    """The motion that takes one pose to the other, as a function of a point."""
    turn = 2 * (math.atan2(to_row[6], to_row[7]) - math.atan2(from_row[6], from_row[7]))
    c, s = math.cos(turn), math.sin(turn)

    def move(p):
        x, y = p[0] - from_row[1], p[1] - from_row[2]
        return (c * x - s * y + to_row[1], s * x + c * y + to_row[2])

    return move


def room_at(storey, point):
    for room in storey["rooms"]:
        if inside(point, room["outline"]) and not any(inside(point, hole) for hole in room["holes"]):
            return room
    return None


def has_edit(edit, points, storey):
    kind = edit["edit"]
    rooms = [room_at(storey, point) for point in points]
    if kind == "rename":
        return rooms[0] is not None and rooms[0]["name"] == edit["name"]
    if kind == "merge":
        return rooms[0] is not None and rooms[1] is not None and rooms[0]["id"] == rooms[1]["id"]
    if kind == "delete":
        return rooms[0] is None
    middle = [(points[-2][i] + points[-1][i]) / 2 for i in (0, 1)]
    return any(math.dist(door["position"], middle) < 0.3 for door in storey["doors"])


def judge(log, folder, other_log, other_folder):
    truth, pose = first_poses(log, folder)
    other_truth, other_pose = first_poses(other_log, other_folder)
    to_world, to_other = motion(pose, truth), motion(other_truth, other_pose)
    edits = read(f"{folder}/edits.json")["edits"]
    storey = read(f"{other_folder}/rooms.json")["building"]["storeys"][0]
    page = html.unescape(open(f"{other_folder}/report.html").read())
    named = len(set(re.findall(r"(?:rename|merge|split|delete|move-door)[^<]{0,300}?: (?:there is no|no door|the line|both points|a door)", page)))
    if "they are of another place" in page:
        named = len(edits)
    kept = 0
    for edit in edits:
        points = [to_other(to_world(point)) for point in edit["points"]]
        is_kept = has_edit(edit, points, storey)
        kept += is_kept
        print(f"{edit['edit']:10} {edit.get('name', ''):10} {'kept' if is_kept else 'not kept'}", file=sys.stderr)
    wrong = 0
    for edit in edits:
        if edit["edit"] != "rename":
            continue
        room = next((room for room in storey["rooms"] if room["name"] == edit["name"]), None)
        point = to_other(to_world(edit["points"][0]))
        wrong += room is not None and not inside(point, room["outline"])
    print(len(edits), kept, named, wrong)


if sys.argv[1] == "choose":
    choose(sys.argv[2])
else:
    judge(*sys.argv[2:6])

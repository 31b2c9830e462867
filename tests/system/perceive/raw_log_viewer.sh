#!/bin/sh
# Opens a rawlog in MRPT's RawLogViewer, selects one of its first rows, brings what the 3D view draws to the middle and
# nearer until it fills the view, and takes a picture of the screen, which is to be 1280 x 960 pixels.
#
# Usage: xvfb-run -a -s '-screen 0 1280x960x24' raw_log_viewer.sh LIBRARY LOG ROW PICTURE
set -eu
library=$1 log=$2 row=$3 picture=$4
view=860x250+408+545 # the 3D view on the screen: width x height + left + top

RawLogViewer -l "$library" "$log" >/dev/null 2>&1 &
viewer=$!
trap 'kill $viewer 2>/dev/null || true' EXIT

# x WORDS...: what xdotool does with a window that may have gone meanwhile, or may not be there yet.
x() { xdotool "$@" 2>/dev/null || true; }

mains() { x search --onlyvisible --name 'RawlogViewer - Part of the MRPT project'; }
tips() { x search --onlyvisible --name 'Tip of the Day'; }

# look: takes the picture, and prints a checksum of the 3D view in it.
look() {
  import -window root "$picture" 2>/dev/null || true
  convert "$picture" -crop $view rgb:- 2>/dev/null | cksum
}

# settle BEFORE: pictures until the view is no longer as BEFORE, or has stayed so for 3 s, and then until two in a row are
# alike: whatever was asked for has been drawn then, however busy the machine is.
settle() {
  tries=0
  now=$(look)
  while [ "$now" = "$1" ] && [ $tries -lt 15 ]; do
    sleep 0.2
    now=$(look)
    tries=$((tries + 1))
  done
  tries=0
  last=
  while [ "$now" != "$last" ] && [ $tries -lt 50 ]; do
    sleep 0.2
    last=$now
    now=$(look)
    tries=$((tries + 1))
  done
}

# drawn: width, height, left and top of what is drawn in the 3D view: neither grey nor white, as ground and axes are.
drawn() {
  convert "$picture" -crop $view +repage \( -clone 0 -colorspace HSB -channel G -separate -threshold 25% \) \
    \( -clone 0 -colorspace gray -threshold 15% -negate \) -delete 0 -compose Lighten -composite -bordercolor black \
    -border 1 -trim -format '%w %h %X %Y' info: 2>/dev/null || true
}

# drag X Y: the scene by that many pixels. The viewer follows the second movement, from where the first ended.
drag() {
  x mousemove 840 670 mousedown 3 sleep 0.1 mousemove 841 670 sleep 0.1 mousemove $((841 + $1)) $((670 + $2)) \
    sleep 0.1 mouseup 3
}

# There is no window manager, nor anything that says when a window is ready: all of it again until it is seen to work.
for _ in $(seq 60); do
  kill -0 $viewer || { echo "RawLogViewer has ended" >&2; exit 1; }
  main=$(mains | tail -n 1)
  if [ -z "$main" ]; then
    sleep 0.5
    continue
  fi
  for tip in $(tips); do x windowfocus "$tip" key Escape; done
  before=$(look)
  x windowsize "$main" 1280 960
  x mousemove 200 $((123 + 17 * row)) click 1
  settle "$before"
  # shellcheck disable=SC2046 # four numbers
  set -- $(drawn)
  if [ $# -ne 4 ] || [ "$1" -le 10 ]; then continue; fi
  if [ -z "$(tips)" ] && { [ "$1" -gt 500 ] || [ "$2" -gt 190 ]; }; then exit 0; fi
  before=$(look)
  drag $((430 - $3 - $1 / 2)) $((125 - $4 - $2 / 2))
  x click --repeat 6 4 # turns the wheel
  settle "$before"
done
echo "drawn in the 3D view (width, height, left, top): $*" >&2
exit 1

#!/bin/sh
# Opens a rawlog in MRPT's RawLogViewer, selects its sixth row, goes nearer until the 3D view is full of colours, and
# takes a picture of the screen, which is to be 1280 x 960 pixels.
#
# Usage: xvfb-run -a -s '-screen 0 1280x960x24' raw_log_viewer.sh LIBRARY LOG PICTURE
set -eu
library=$1 log=$2 picture=$3

RawLogViewer -l "$library" "$log" >/dev/null 2>&1 &
viewer=$!
trap 'kill $viewer 2>/dev/null || true' EXIT

# colours: how many pixels of the 3D view are neither grey nor nearly so.
colours() {
  convert "$picture" -crop 860x250+408+545 -colorspace HSB -channel G -separate -threshold 25% \
    -format '%[fx:round(mean*w*h)]' info:
}

main=$(timeout 60 xdotool search --sync --onlyvisible --name 'RawlogViewer - Part of the MRPT project' | tail -n 1)
# There is no window manager, nor anything that says when a window is ready: all of it again until it is seen to work.
for _ in $(seq 60); do
  for tip in $(xdotool search --onlyvisible --name 'Tip of the Day'); do
    xdotool windowfocus "$tip" key Escape || true # it may have gone meanwhile
  done
  xdotool windowsize "$main" 1280 960
  sleep 0.3
  xdotool mousemove 200 208 click 1
  xdotool mousemove 840 670 click --repeat 8 4 # turns the wheel
  sleep 0.3
  import -window root "$picture"
  [ "$(colours)" -lt 8000 ] || exit 0
done
echo "$(colours) coloured pixels in the 3D view" >&2
exit 1

#!/bin/sh
# Opens a rawlog in MRPT's RawLogViewer, selects one of its first rows, brings what the 3D view draws to the middle and
# nearer until it fills the view, and takes a picture of the screen, which is to be 1280 x 960 pixels.
#
# Usage: xvfb-run -a -s '-screen 0 1280x960x24' raw_log_viewer.sh LIBRARY LOG ROW PICTURE
set -eu
library=$1 log=$2 row=$3 picture=$4

RawLogViewer -l "$library" "$log" >/dev/null 2>&1 &
viewer=$!
trap 'kill $viewer 2>/dev/null || true' EXIT

# drawn: width, height, left and top of what is drawn in the 3D view: neither grey nor white, as ground and axes are.
drawn() {
  convert "$picture" -crop 860x250+408+545 +repage \( -clone 0 -colorspace HSB -channel G -separate -threshold 25% \) \
    \( -clone 0 -colorspace gray -threshold 15% -negate \) -delete 0 -compose Lighten -composite -bordercolor black \
    -border 1 -trim -format '%w %h %X %Y' info: 2>/dev/null
}

tips() {
  xdotool search --onlyvisible --name 'Tip of the Day'
}

# drag X Y: the scene by that many pixels. The viewer follows the second movement, from where the first ended.
drag() {
  xdotool mousemove 840 670 mousedown 3 sleep 0.1 mousemove 841 670 sleep 0.1 mousemove $((841 + $1)) $((670 + $2)) \
    sleep 0.1 mouseup 3
}

main=$(timeout 60 xdotool search --sync --onlyvisible --name 'RawlogViewer - Part of the MRPT project' | tail -n 1)
# There is no window manager, nor anything that says when a window is ready: all of it again until it is seen to work.
for _ in $(seq 60); do
  for tip in $(tips); do
    xdotool windowfocus "$tip" key Escape || true # it may have gone meanwhile
  done
  xdotool windowsize "$main" 1280 960
  sleep 0.3
  xdotool mousemove 200 $((123 + 17 * row)) click 1
  sleep 0.3
  import -window root "$picture"
  # shellcheck disable=SC2046 # four numbers
  set -- $(drawn)
  if [ $# -ne 4 ] || [ "$1" -le 10 ]; then continue; fi
  if [ -z "$(tips)" ] && { [ "$1" -gt 500 ] || [ "$2" -gt 190 ]; }; then exit 0; fi
  drag $((430 - $3 - $1 / 2)) $((125 - $4 - $2 / 2))
  xdotool click --repeat 6 4 # turns the wheel
done
echo "drawn in the 3D view (width, height, left, top): $*" >&2
exit 1

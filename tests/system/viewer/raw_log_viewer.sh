#!/bin/sh
# Opens a rawlog in MRPT's RawLogViewer, selects one of its first rows, brings what the 3D view draws to the middle and
# nearer until it nearly fills the view, with nothing of it outside, and takes a picture of the screen, which is to be
# 1280 x 960 pixels.
#
# Usage: xvfb-run -a -s '-screen 0 1280x960x24' raw_log_viewer.sh LIBRARY LOG ROW PICTURE
set -eu
library=$1 log=$2 row=$3 picture=$4
view=860x250+408+545 # the 3D view on the screen: width x height + left + top

RawLogViewer -l "$library" "$log" >"$picture.log" 2>&1 &
viewer=$!
screen=$(pgrep -f "Xvfb $DISPLAY " | head -n 1)
trap 'kill $viewer 2>/dev/null || true' EXIT

# x WORDS...: what xdotool does with a window that may have gone meanwhile, or may not be there yet.
x() { xdotool "$@" 2>/dev/null || true; }

mains() { x search --onlyvisible --name 'RawlogViewer - Part of the MRPT project'; }
tips() { x search --onlyvisible --name 'Tip of the Day'; }

# look: prints a checksum of what the 3D view shows.
look() { import -window root -crop $view rgb:- 2>/dev/null | cksum; }

# Whether viewer and screen wait for something to do: no thread of theirs runs or waits for a core.
is_idle() { ! cat /proc/"$viewer"/task/*/stat /proc/"$screen"/task/*/stat 2>/dev/null | sed 's/.*) //' | grep -q '^[RD]'; }

# rest N: waits until viewer and screen have had nothing to do N times in a row, a tenth of a second apart.
rest() {
  quiet=0
  while [ $quiet -lt "$1" ] && kill -0 $viewer 2>/dev/null; do
    sleep 0.1
    if is_idle; then quiet=$((quiet + 1)); else quiet=0; fi
  done
}

# settle: waits until whatever was asked for has been drawn: viewer and screen have had nothing to do for half a second, and
# the view is the same as before it. Then takes the picture.
settle() {
  last=none now=$(look)
  while [ "$now" != "$last" ] && kill -0 $viewer 2>/dev/null; do
    last=$now
    rest 5
    now=$(look)
  done
  import -window root "$picture" 2>/dev/null || true
}

# drawn: width, height, left and top of what is drawn in the 3D view: neither grey nor white, as ground and axes are.
drawn() {
  convert "$picture" -crop $view +repage \( -clone 0 -colorspace HSB -channel G -separate -threshold 25% \) \
    \( -clone 0 -colorspace gray -threshold 15% -negate \) -delete 0 -compose Lighten -composite -bordercolor black \
    -border 1 -trim -format '%w %h %X %Y' info: 2>/dev/null || true
}

# Whether the 3D view, which comes with the first row that is selected, is where it is looked for: its ground is grey down
# to its corner.
is_laid_out() { convert "$picture" -crop 1x1+1264+792 -depth 8 txt:- 2>/dev/null | grep -q '#666666'; }

# Whether the row is selected: it has a coloured ground then.
is_selected() {
  red=$(convert "$picture" -crop "360x1+30+$((123 + 17 * row))" -format '%[fx:int(255*mean.r)]' info: 2>/dev/null || true)
  [ "${red:-255}" -lt 128 ]
}

# Whether the list begins with its title, which has an icon farther left than any row.
is_at_top() {
  white=$(convert "$picture" -crop 14x14+5+98 -format '%[fx:int(255*mean)]' info: 2>/dev/null || true)
  [ "${white:-255}" -lt 250 ]
}

# drag X Y: the scene by that many pixels. The viewer follows the second movement, from where the first ended, and takes
# movements that come while it is busy for one.
drag() {
  x mousemove 840 670 mousedown 3
  rest 2
  x mousemove 841 670
  rest 2
  x mousemove $((841 + $1)) $((670 + $2))
  rest 2
  x mouseup 3
}

# whole WIDTH HEIGHT LEFT TOP: whether all that is drawn is within the view, clear of its four sides.
whole() { [ "${3#+}" -gt 4 ] && [ "${4#+}" -gt 4 ] && [ $((${3#+} + $1)) -lt 858 ] && [ $((${4#+} + $2)) -lt 248 ]; }

# There is no window manager, nor anything that says when a window is ready: all of it again until it is seen to work.
# Rounds are counted, because on a busy machine each may take a minute; the caller ends what hangs.
shown=no box=nothing came=no rounds=0
while [ $rounds -lt 40 ]; do
  if ! kill -0 $viewer 2>/dev/null; then
    tail -n 5 "$picture.log" >&2
    [ $came = yes ] && echo "RawLogViewer has ended" >&2 || echo "RawLogViewer has ended before its window came" >&2
    exit 1
  fi
  main=$(mains | tail -n 1)
  if [ -z "$main" ]; then
    sleep 0.3
    continue
  fi
  came=yes
  rounds=$((rounds + 1))
  for tip in $(tips); do x windowfocus "$tip" key Escape; done
  if [ $shown = no ]; then
    # While the window is small a click may meet the list's scroll bar: back to the first row before each.
    x windowsize "$main" 1280 960
    x mousemove 200 400 click --repeat 40 --delay 2 4
    x mousemove 200 $((123 + 17 * row)) click 1
    settle
    is_laid_out && is_at_top && is_selected || continue
  fi
  box=$(drawn)
  # shellcheck disable=SC2086 # four numbers
  set -- $box
  shown=no
  if [ $# -ne 4 ] || [ "$1" -le 10 ] || [ -n "$(tips)" ]; then continue; fi
  shown=yes
  if ! whole "$@"; then # a busy viewer turns late, and then too far
    x mousemove 840 670 click --repeat 2 5
    settle
    continue
  fi
  if [ "$1" -gt 500 ] || [ "$2" -gt 190 ]; then exit 0; fi
  right=$((430 - $3 - $1 / 2)) down=$((125 - $4 - $2 / 2))
  if [ ${right#-} -gt 20 ] || [ ${down#-} -gt 20 ]; then
    drag $((2 * right)) $((2 * down)) # the scene follows half way
  else # turns the wheel: about half of the clicks that are needed, so as not to go too far
    x mousemove 840 670 click --repeat "$(awk -v w="$1" -v h="$2" 'BEGIN {
      times = 510 / w < 194 / h ? 510 / w : 194 / h; clicks = int(14 * log(times)); print clicks < 4 ? 4 : clicks }')" 4
  fi
  settle
done
echo "drawn in the 3D view after $rounds rounds (width, height, left, top): $box" >&2
exit 1

# What every script shares: where the project is, how to speak, how to become root.
# Sourced, never run.
# shellcheck shell=bash

project_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
readonly project_root

say() { printf '\n== %s\n' "$*"; }

die() {
  printf 'error: %s\n' "$*" >&2
  exit 1
}

# Runs a command as root: directly, or through sudo.
as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    die "installing packages needs root and there is no sudo; as root run: $*"
  fi
}

# If the script was started with sudo, runs it again as the user who called sudo, so that the build belongs to this
# user. Arguments: the script and its own arguments. Returns if there is no such user or the project's folders are not
# writable to this user.
leave_root() {
  [ "$(id -u)" -eq 0 ] && [ -n "${SUDO_USER:-}" ] && [ "$SUDO_USER" != root ] || return 0
  local place
  for place in "$project_root" "$project_root/build" "$project_root/out"; do
    [ ! -e "$place" ] || runuser -u "$SUDO_USER" -- test -w "$place" || return 0
  done
  exec runuser -u "$SUDO_USER" -- env HOME="$(getent passwd "$SUDO_USER" | cut -d: -f6)" "$@"
}

# The comment at the top of a script, between the first line and the first line that is no comment.
print_help() { sed -n '2,/^[^#]/{s/^# \{0,1\}//p}' "$1"; }

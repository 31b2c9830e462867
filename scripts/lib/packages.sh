# Installs the Debian packages that are missing. Sourced, never run.
# shellcheck shell=bash

# Names in a package list: the first word of each line that is no comment.
list_packages() { sed -e 's/#.*//' -e '/^[[:space:]]*$/d' "$@" | awk '{ print $1 }'; }

is_installed() { [ "$(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

# install_packages LIST...: what the lists name and the machine lacks.
install_packages() {
  command -v dpkg-query >/dev/null || die "this is not Debian; install what these files name by other means: $*"
  local package missing=()
  for package in $(list_packages "$@"); do
    is_installed "$package" || missing+=("$package")
  done
  if [ "${#missing[@]}" -eq 0 ]; then
    say "All Debian packages are there"
  else
    say "Installing ${missing[*]}"
    as_root apt-get -q -o DPkg::Lock::Timeout=120 update
    as_root env DEBIAN_FRONTEND=noninteractive \
      apt-get -q -y -o DPkg::Lock::Timeout=120 install --no-install-recommends "${missing[@]}"
  fi
  case " $* " in *" scripts/packages.txt "*) check_blas ;; esac
}

# CHOLMOD is linked against "some BLAS"; Debian's alternatives decide which, and OpenBLAS wins unless somebody chose.
check_blas() {
  local blas
  blas=$(/sbin/ldconfig -p | awk '/libblas\.so\.3/ && !found++ { print $NF }')
  case "$(readlink -f "$blas")" in
    *openblas*) ;;
    *) printf 'warning: %s is not OpenBLAS, solving will be slow; as root run: update-alternatives --config %s\n' \
      "$blas" "libblas.so.3-$(uname -m)-linux-gnu" >&2 ;;
  esac
}

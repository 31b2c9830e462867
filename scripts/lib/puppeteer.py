#!/usr/bin/python3
"""Fetches puppeteer-core, with which the test of the page drives a browser: one file, puppeteer-core-browser.js.

Usage: puppeteer.py FOLDER

A folder that has the file is left as it is. The file is the package's build for browsers, which needs no other package.
"""

import sys
from pathlib import Path

sys.dont_write_bytecode = True

from npm_package import FetchError, Package, fetch  # noqa: E402 (it would leave its bytecode)

# Version 25 needs Node 22; Debian 12 has Node 18.
PUPPETEER = Package("puppeteer-core", "24.43.1", "Apache-2.0",
                    "sha512-T5ScUMAsmhdNbgDR41AGESYeS6V9MSgetkSnVhhW+gXvzC42VesKCn5ld87gAZDJ6vLHL9GkRvY9WtQWSnwFbw==")
FILE = "puppeteer-core-browser.js"


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: puppeteer.py FOLDER")
    folder = Path(sys.argv[1])
    if (folder / FILE).is_file():
        return
    folder.mkdir(parents=True, exist_ok=True)
    unfinished = FILE + ".part"
    try:
        fetch(PUPPETEER, {"lib/es5-iife/" + FILE: unfinished}, folder)
    except FetchError as error:
        sys.exit(f"error: {error}")
    (folder / unfinished).rename(folder / FILE)


if __name__ == "__main__":
    main()

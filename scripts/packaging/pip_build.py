# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""What `pip install .` calls (PEP 517): CMake builds the module in build/package for the Python that pip runs with, and what its
component Python installs becomes a wheel. The program is not in it: a Debian package or `cmake --install` brings that."""

import base64
import hashlib
import re
import subprocess
import sys
import sysconfig
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
NEEDS = ("h5py", "numpy", "pandas")


def _version():
    return re.search(r"project\(lmdbench VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text()).group(1)


def _cmake(*arguments):
    try:
        subprocess.run(["cmake", *map(str, arguments)], cwd=ROOT, check=True)
    except (OSError, subprocess.CalledProcessError) as error:
        raise SystemExit(f"lmdbench: cmake failed: {error} (remedy: scripts/setup.sh installs what the build needs)")


def _metadata():
    lines = ["Metadata-Version: 2.1", "Name: lmdbench", f"Version: {_version()}",
             "Summary: Local minimum distance pairs of two triangle meshes", "License: BSD-3-Clause",
             "Requires-Python: >=3.9", *(f"Requires-Dist: {name}" for name in NEEDS)]
    return "\n".join(lines) + "\n"


def _record_line(name, data):
    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(data)}\n"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    with tempfile.TemporaryDirectory() as staging:
        build = ROOT / "build" / f"wheel-{sys.implementation.cache_tag}"
        _cmake("--preset", "package", "-B", build, f"-DLMDBENCH_PYTHON={sys.executable}", "-DLMDBENCH_PYTHON_FOLDER=.",
               "-DLMDBENCH_BUILD_TESTS=OFF")
        _cmake("--build", build, "--target", "lmdbench_python")
        _cmake("--install", build, "--component", "Python", "--prefix", staging)
        files = {f"lmdbench/{path.name}": path.read_bytes()
                 for path in sorted((Path(staging) / "lmdbench").iterdir())}
    tag = f"cp{sys.version_info[0]}{sys.version_info[1]}"
    tag = f"{tag}-{tag}-{re.sub('[-.]', '_', sysconfig.get_platform())}"
    info = f"lmdbench-{_version()}.dist-info"
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: pip_build\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    record = "".join(_record_line(name, data) for name, data in files.items()) + f"{info}/RECORD,,\n"
    files[f"{info}/RECORD"] = record.encode()
    wheel = f"lmdbench-{_version()}-{tag}.whl"
    with zipfile.ZipFile(Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            archive.writestr(name, data)
    return wheel

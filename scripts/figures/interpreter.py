# SPDX-FileCopyrightText: The lmdbench authors
# SPDX-License-Identifier: BSD-3-Clause
"""To be imported before what Python does not bring along: goes on under an interpreter that has it. The first python3 of the PATH may be
a private build (pyenv, conda) without the distribution's modules, so the distribution's own is tried, too, as `find_python` of
scripts/lib.sh does."""

import importlib.util
import os
import subprocess
import sys

MODULES = ("h5py", "matplotlib", "numpy")
OWN = "/usr/bin/python3"
EXIT_ENVIRONMENT = 4

missing = [name for name in MODULES if importlib.util.find_spec(name) is None]
is_second = os.environ.pop("LMDBENCH_SECOND_INTERPRETER", None)
if missing:
    if not is_second and os.path.exists(OWN) and subprocess.run(
            [OWN, "-c", "import " + ", ".join(MODULES)], stderr=subprocess.DEVNULL, check=False).returncode == 0:
        os.environ["LMDBENCH_SECOND_INTERPRETER"] = "1"
        os.execv(OWN, [OWN, *getattr(sys, "orig_argv", [OWN, *sys.argv])[1:]])
    print(f"error: {sys.executable} has no {', '.join(missing)} (remedy: ./scripts/setup.sh, which installs them for {OWN}; or "
          f"{sys.executable} -m pip install {' '.join(missing)})", file=sys.stderr)
    sys.exit(EXIT_ENVIRONMENT)

"""The build backend for pip (PEP 517): CMake compiles the module, and the package is packed as a wheel. It needs only
the standard library.

`pip install --no-build-isolation --config-settings build-dir=build/release .` uses an existing build. With
`--config-settings portable=yes`, the wheel also holds the program and all libraries, and needs none on the system.
"""

import base64
import hashlib
import platform
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]


def version():
    """The program's version, from the top CMakeLists.txt."""
    return re.search(r"^project\(fusee VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(), re.M)[1]


def project_field(key):
    """A text of pyproject.toml."""
    return re.search(rf'^{key} = "(.*)"$', (ROOT / "pyproject.toml").read_text(), re.M)[1]


def configure(build):
    """Configures for the Python that runs this: the one of an earlier build may no longer exist."""
    generator = ["-G", "Ninja"] if shutil.which("ninja") and not (build / "CMakeCache.txt").exists() else []
    options = ["-DCMAKE_BUILD_TYPE=Release", "-DFUSEE_TESTS=OFF", "-DFUSEE_PYTHON=REQUIRED", f"-DPython_EXECUTABLE={sys.executable}"]
    subprocess.run(["cmake", "-S", ROOT, "-B", build, *generator, *options], check=True)


def compiled_package(build_dir, targets=("fusee_python",)):
    """Compiles the targets in the build folder, or in a new one. Returns the folder of the package in it."""
    build = ROOT / (build_dir or "build/wheel")
    if not build_dir:
        configure(build)
    subprocess.run(["cmake", "--build", build, "--target", *targets], check=True)
    return build / "python/fusee"


def step_module(package):
    """The module for step=True, if it was built: in the wheel it has the same place below the package as below the
    build."""
    build = package.parents[1]
    return {f"fusee/{path.relative_to(build)}": path.read_bytes() for path in sorted(build.glob("lib/**/fusee/modules/fusee-step.so"))}


def portable_tree(package, top):
    """Copies the package, the program and its modules below `top`, with the libraries that they need."""
    build = package.parents[1]
    library = package / ("_core" + sysconfig.get_config_var("EXT_SUFFIX"))
    binaries = {library: library.name, build / "fusee": "bin/fusee",
                **{path: str(path.relative_to(build)) for path in sorted(build.glob("lib/**/fusee/modules/*.so"))}}
    for path, name in binaries.items():
        (top / name).parent.mkdir(parents=True, exist_ok=True)
        subprocess.run(["strip", "--strip-unneeded", "-o", top / name, path], check=True)
    files = ";".join(str(top / name) for name in binaries.values())
    script = ROOT / "src/bundled_libraries.cmake"
    subprocess.run(["cmake", f"-DFILES={files}", f"-DLIBRARIES={top / 'lib/fusee/bundled'}", "-P", script], check=True)


def is_portable(settings):
    return (settings or {}).get("portable", "no") == "yes"


def tag(portable=False):
    """Interpreter, ABI and platform (PEP 425), such as cp311-cp311-linux_x86_64."""
    python = f"cp{sys.version_info[0]}{sys.version_info[1]}"
    system = sysconfig.get_platform()
    if portable:
        system = system.replace("linux", "manylinux-" + platform.libc_ver()[1])  # PEP 600
    return f"{python}-{python}-" + re.sub("[-.]", "_", system)


def metadata():
    return (f"Metadata-Version: 2.1\nName: fusee\nVersion: {version()}\nSummary: {project_field('description')}\n"
            f"Requires-Python: {project_field('requires-python')}\nRequires-Dist: numpy\n")


def metadata_files(portable):
    """The metadata files of the wheel: name → bytes."""
    info = f"fusee-{version()}.dist-info"
    wheel = f"Wheel-Version: 1.0\nGenerator: fusee_wheel\nRoot-Is-Purelib: false\nTag: {tag(portable)}\n"
    return {f"{info}/METADATA": metadata().encode(), f"{info}/WHEEL": wheel.encode(), f"{info}/LICENSE": (ROOT / "LICENSE").read_bytes()}


def contents(package, portable):
    """Name in the wheel → bytes, without RECORD."""
    library = "_core" + sysconfig.get_config_var("EXT_SUFFIX")
    if not (package / library).exists():
        raise SystemExit(f"fusee: {package} was compiled for another Python: {library} is missing")
    files = [path for path in sorted(package.iterdir()) if path.suffix in (".py", ".pyi", ".typed")]
    members = {f"fusee/{path.name}": path.read_bytes() for path in files}
    if not portable:
        return {**members, f"fusee/{library}": (package / library).read_bytes(), **step_module(package), **metadata_files(portable)}
    with tempfile.TemporaryDirectory() as folder:
        top = Path(folder) / "fusee"
        portable_tree(package, top)
        tree = {str(path.relative_to(folder)): path.read_bytes() for path in sorted(top.rglob("*")) if path.is_file()}
    return {**members, **tree, **metadata_files(portable)}


def record(members, name):
    """The list of hashes and sizes that every wheel has. `name`: its own, which has neither."""
    def row(path, data):
        return f"{path},sha256={base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b'=').decode()},{len(data)}\n"

    return "".join(row(path, data) for path, data in members.items()) + f"{name},,\n"


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    """Called before anything is compiled."""
    for name, data in metadata_files(is_portable(config_settings)).items():
        path = Path(metadata_directory) / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(data)
    return f"fusee-{version()}.dist-info"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    portable = is_portable(config_settings)
    targets = ("fusee_python", "fusee_cli", "fusee_step", "fusee_evolution_module") if portable else ("fusee_python",)
    members = contents(compiled_package((config_settings or {}).get("build-dir"), targets), portable)
    name = f"fusee-{version()}.dist-info/RECORD"
    members[name] = record(members, name).encode()
    wheel = f"fusee-{version()}-{tag(portable)}.whl"
    with zipfile.ZipFile(Path(wheel_directory) / wheel, "w", zipfile.ZIP_DEFLATED) as packed:
        for path, data in members.items():
            entry = zipfile.ZipInfo(path)  # dated 1980, so that equal input gives equal bytes
            entry.external_attr = (0o100755 if path.endswith("bin/fusee") or ".so" in path else 0o100644) << 16  # pip asks for a regular file
            entry.compress_type = zipfile.ZIP_DEFLATED
            packed.writestr(entry, data)
    return wheel


def build_sdist(sdist_directory, config_settings=None):
    """The files that git tracks."""
    name = f"fusee-{version()}"
    target = Path(sdist_directory) / f"{name}.tar.gz"
    subprocess.run(["git", "-C", ROOT, "archive", "--format=tar.gz", f"--prefix={name}/", "-o", target.resolve(), "HEAD"], check=True)
    return target.name

"""Debian's tools as judges of the packages that cpack makes from a build.

lintian must find no errors and no warnings except the stated overrides. The installed content must work: the program makes a pulley, man finds
its page, Python imports its module, and the flags of pkg-config compile and link another program.

Usage: judge_packages.py BUILD CONSUMER.cpp   Prints the faults; exit 1 if there are any, 77 without the tools."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

TOOLS = ("cpack", "dpkg-deb", "dpkg-shlibdeps", "lintian", "pkg-config", "c++")
EXPECTED = {"fusee", "libfusee-dev"}


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)
    return done.returncode, done.stdout + done.stderr


def packages_of(build, folder):
    code, output = run("cpack", "-G", "DEB", "-B", folder, cwd=build)
    found = {path.name.split("_")[0]: path for path in sorted(folder.glob("**/*.deb")) if "_CPack" not in str(path)}
    if code or not EXPECTED <= set(found):
        raise SystemExit(f"cpack made {sorted(found)}, exit {code}:\n{output}")
    return found


def lintian_faults(packages):
    # Without --allow-root, lintian warns about running as root.
    code, output = run("lintian", "--allow-root", "--fail-on", "error,warning", *packages.values())
    if code:
        yield f"lintian:\n{output}"


def unpacking_faults(packages, root):
    for package in packages.values():
        code, output = run("dpkg-deb", "-x", package, root)
        if code:
            yield f"{package.name} does not unpack: {output}"
    program, page = root / "usr/bin/fusee", root / "usr/share/man/man1/fusee-build.1.gz"
    profile = root / "usr/share/fusee/profiles/paper_optimum.toml"
    code, output = run(program, "build", profile, "-o", root / "out", "-q")
    if code:
        yield f"the program from the package: exit {code}: {output}"
    code, output = run(program, "optimize", profile, "--method", "ga", "--dry-run", "-q")
    if code:
        yield f"the program from the package does not search by evolution: exit {code}: {output}"
    if any(root.glob("usr/lib/**/fusee-step.so")):
        code, output = run(program, "build", profile, "-o", root / "cad", "-q", "--step")
        if code or not (root / "cad/pulley.step").exists():
            yield f"the program from the package makes no STEP: exit {code}: {output}"
    code, output = run("man", "-l", page, env={**os.environ, "MANPAGER": "cat"}) if shutil.which("man") else (0, "pulley.stl")
    if code or "pulley" not in output:
        yield f"man does not show {page.name}: {output[:200]}"


def python_faults(packages, root):
    if "python3-fusee" not in packages:
        return
    code, output = run("dpkg-deb", "-f", packages["python3-fusee"], "Depends")
    if "python3-numpy" not in output or "libc6" not in output:
        yield f"python3-fusee depends on {output}"
    step = any(root.glob("usr/lib/**/fusee-step.so"))
    lines = f"import fusee; print(fusee.__file__, fusee.build(fusee.read(fusee.new('finger')), step={step}).status)"
    code, output = run("/usr/bin/python3", "-c", lines, cwd=root, env={"PYTHONPATH": str(root / "usr/lib/python3/dist-packages"), "PATH": os.environ["PATH"]})
    if code or not output.startswith(str(root)) or "done" not in output:
        yield f"the Python module from the package: exit {code}: {output}"


def compiler_faults(root, source):
    found = sorted(root.glob("usr/lib/**/fusee.pc"))
    if len(found) != 1:
        yield f"fusee.pc is in {found}"
        return
    code, flags = run("pkg-config", "--cflags", "--libs", found[0])
    if code:
        yield f"pkg-config: {flags}"
        return
    code, output = run("c++", source, "-o", root / "consumer", *flags.split())
    if code:
        yield f"a program with pkg-config's flags does not compile: {output[-2000:]}"
        return
    code, output = run(root / "consumer", root / "usr/share/fusee/profiles/paper_optimum.toml")
    if code or "r2 " not in output:
        yield f"a program made with pkg-config: exit {code}: {output}"


def main():
    build, source = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    missing = [tool for tool in TOOLS if shutil.which(tool) is None]
    if missing:
        print("not installed:", *missing)
        return 77
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        packages = packages_of(build, folder / "made")
        root = folder / "root"
        faults = [*lintian_faults(packages), *unpacking_faults(packages, root), *python_faults(packages, root), *compiler_faults(root, source)]
    for fault in faults:
        print(fault)
    return 1 if faults else 0


sys.exit(main())

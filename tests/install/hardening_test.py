"""hardening_test.py PROGRAM...: that the defences of the build are on in each program or module, by readelf. 77: no readelf."""

import re
import shutil
import subprocess
import sys


def readelf(options, file):
    return subprocess.run(["readelf", *options, "--wide", file], capture_output=True, text=True, check=True).stdout


def lacking(file):
    header, segments, dynamic = readelf(["-h"], file), readelf(["-l"], file), readelf(["-d"], file)
    symbols = readelf(["--dyn-syms"], file)
    stack = re.search(r"GNU_STACK.*?\s(R[W ][E ])\s", segments)
    checks = {
        "a position of its own (PIE)": re.search(r"Type:\s+DYN", header),
        "relro": "GNU_RELRO" in segments,
        "all functions bound at the start (now)": re.search(r"BIND_NOW|Flags:.*NOW", dynamic),
        "a stack that cannot be executed": stack and "E" not in stack[1],
        "the stack protector": "__stack_chk_fail" in symbols,
    }
    return [name for name, found in checks.items() if not found]


def main():
    if shutil.which("readelf") is None:
        print("SKIPPED: readelf was not found; install binutils")
        return 77
    wrong = [f"{file} lacks {name}" for file in sys.argv[1:] for name in lacking(file)]
    # Calls that glibc checks, of the program alone: a small module may have none.
    if not re.search(r"__v?s?n?printf_chk|__memcpy_chk", readelf(["--dyn-syms"], sys.argv[1])):
        wrong.append(f"{sys.argv[1]} lacks checked copies (FORTIFY)")
    print("\n".join(wrong) or "all defences are on")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())

"""The verification book: runs cases, writes docs/verification.

    python3 verification/book               everything
    python3 verification/book tip_load ..   some pages (names as in docs/verification), and no index
    python3 verification/book tests         the page of the tests' figures alone
    python3 verification/book --check       what the continuous checks ask: see check.py
"""

import argparse
import sys
import time

sys.dont_write_bytecode = True  # the checkout stays as it is

import book  # noqa: E402
import check  # noqa: E402
from runs import TOP  # noqa: E402


def arguments():
    parser = argparse.ArgumentParser(prog="python3 verification/book", description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pages", nargs="*", help="pages to make; default: all")
    parser.add_argument("--flexura", default=str(TOP / "build/release/flexura"),
                        help="the command")
    parser.add_argument("--tests", help="flexura_verification; default: beside the command")
    parser.add_argument("--check", action="store_true")
    return parser.parse_args()


def main():
    options = arguments()
    tests = options.tests or str(TOP / "build/release/verification/flexura_verification")
    started = time.monotonic()
    if options.check:
        return check.check(options.flexura)
    kept = book.write(options.flexura, tests, options.pages)
    print(f"{time.monotonic() - started:.0f} s")
    return 0 if kept else 1


if __name__ == "__main__":
    sys.exit(main())

"""Does what a tutorial says, and holds what happens against what it shows.

usage: tutorial_test.py DOCUMENT FLEXURA [--update]

Blocks of a document that are executed, in order, in an empty folder:

    ```toml FILE             begins FILE, or is added to its end
    ```diff FILE             lines with - are replaced by lines with +, in place
    ```console               commands after "$ ", below each what it prints

A line of dots alone stands for any lines. Times differ from run to run and are not compared, other
numbers to one per cent: what is shown may be rounded, and processors differ in last digits. With
--update the document is rewritten with what the commands print; look at the difference.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

BLOCK = re.compile(r"^```(toml|diff) (\S+)\n(.*?)^```$|^```(console)\n(.*?)^```$", re.M | re.S)
TIME = re.compile(r"\b\d+(\.\d+)?(e[-+]\d+)? (us|ms|s)\b")
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?\Z")
END = "\x1e"


def split_commands(block):
    """Pairs of a command and the lines it is said to print."""
    commands = []
    for line in block.splitlines():
        if line.startswith("$ "):
            commands.append((line[2:], []))
        else:
            commands[-1][1].append(line)
    return commands


def run_commands(commands, folder, flexura):
    """What each of them prints, one shell for all, so that `$?` is what the last one left."""
    script = "exec 2>&1\n" + "".join(
        f"{command}\nstatus=$?; printf '{END}'; (exit $status)\n" for command, _ in commands)
    environment = dict(os.environ, NO_COLOR="1", LC_ALL="C.UTF-8",
                       PATH=f"{flexura.parent}:{os.environ['PATH']}")
    printed = subprocess.run(["bash", "-c", script], cwd=folder, env=environment, check=False,
                             stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True).stdout
    return [part.splitlines() for part in printed.split(END)[:-1]]


def same_word(shown, printed):
    if shown == printed:
        return True
    if not (NUMBER.match(shown) and NUMBER.match(printed)):
        return False
    a, b = float(shown), float(printed)
    return abs(a - b) <= 0.01 * max(abs(a), abs(b))


def same_line(shown, printed):
    words = [re.split(r"[\s,]+", TIME.sub("TIME", line).strip()) for line in (shown, printed)]
    return len(words[0]) == len(words[1]) and all(map(same_word, *words))


def same_lines(shown, printed):
    """Whether the lines agree, a line of dots in `shown` standing for any number of them."""
    if not shown:
        return not printed
    if set(shown[0].strip()) == {"."}:
        return any(same_lines(shown[1:], printed[i:]) for i in range(len(printed) + 1))
    return bool(printed) and same_line(shown[0], printed[0]) and same_lines(shown[1:], printed[1:])


def edit(file, block):
    """Replaces the runs of lines with - by the runs of lines with + that follow them."""
    text = file.read_text()
    for old, new in re.findall(r"((?:^-.*\n)+)((?:^\+.*\n)*)", block, re.M):
        old, new = (re.sub(r"^[-+]", "", part, flags=re.M) for part in (old, new))
        if text.count(old) != 1:
            raise SystemExit(f"{file.name} has {text.count(old)} times:\n{old}")
        text = text.replace(old, new)
    file.write_text(text)


def commented(commands, outputs):
    """The block with what was printed, lines that were left out by dots left out again."""
    lines = []
    for (command, shown), printed in zip(commands, outputs):
        lines += ["$ " + command, *(shown if same_lines(shown, printed) else printed)]
    return "```console\n" + "\n".join(lines) + "\n```"


def main():
    document, flexura = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
    update = "--update" in sys.argv[3:]
    text = document.read_text()
    failures = commands_run = done = 0
    updated = ""
    with tempfile.TemporaryDirectory() as folder:
        for block in list(BLOCK.finditer(text)):
            kind, name, content, _, console = block.groups()
            if name:
                file = pathlib.Path(folder) / name
                if kind == "diff":
                    edit(file, content)
                else:
                    with file.open("a") as end:
                        end.write(content)
                continue
            commands = split_commands(console)
            outputs = run_commands(commands, folder, flexura)
            for (command, shown), printed in zip(commands, outputs):
                commands_run += 1
                if not same_lines(shown, printed) and not update:
                    failures += 1
                    print(f"$ {command}\nthe document shows:", *shown, "it prints:", *printed,
                          sep="\n")
            updated += text[done:block.start()] + commented(commands, outputs)
            done = block.end()
    if update:
        document.write_text(updated + text[done:])
    print(f"{commands_run} commands, {failures} print something else than {document.name} shows")
    return 1 if failures or not commands_run else 0


if __name__ == "__main__":
    sys.exit(main())

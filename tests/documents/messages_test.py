"""Every message that a document quotes is one that the program, or a script, can print.

usage: messages_test.py DOCUMENT TOP

Quoted messages are the first cells of the rows of its tables, in backquotes, with "…" for what
varies. The pieces between have to occur in the text of the sources: string literals, joined where
they stand side by side, and the scripts as they are.
"""

import pathlib
import re
import sys

ROW = re.compile(r"^\| (`+) ?(.*?) ?\1 \| ", re.M)
LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
JOINED = re.compile(r'(?<!\\)"\s*(?://[^\n]*)?\s*"')
ESCAPES = {r"\"": '"', r"\'": "'", r"\n": "\n", r"\\": "\\"}


def unescaped(text):
    return re.sub(r"\\[\"'n\\]", lambda found: ESCAPES[found.group(0)], text)


def texts(top):
    """What the sources can print: every literal, and the scripts whole."""
    found = []
    for folder in ("flexura", "apps"):
        for source in (top / folder).rglob("*.?pp"):
            joined = JOINED.sub("", source.read_text())
            found += [unescaped(literal) for literal in LITERAL.findall(joined)]
    for script in ("scripts/setup.sh", "demo", "check", "cmake/report_assets.cmake"):
        found.append(re.sub(r'"\s*(\\\n)?\s*"', " ", (top / script).read_text()))
    return found


def without_fields(text):
    """The text with {fields} of a format taken out, as "…"; doubled braces are braces."""
    text = text.replace("{{", "\x01").replace("}}", "\x02")
    return re.sub(r"\{[^{}]*\}", "…", text).replace("\x01", "{").replace("\x02", "}")


def pieces(message):
    return [piece for piece in message.split("…") if re.search(r"\w{2}", piece)]


def missing(message, printed):
    """Pieces of the message that nothing prints; all of it if no piece is long enough to tell."""
    found = pieces(message)
    if not any(len(piece) >= 8 for piece in found):
        return [message]
    return [piece for piece in found if not any(piece in text for text in printed)]


def main():
    document, top = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    printed = [without_fields(text) for text in texts(top)]
    messages = [row[1] for row in ROW.findall(document.read_text())]
    wrong = [(message, missing(message, printed)) for message in messages]
    wrong = [(message, lost) for message, lost in wrong if lost]
    for message, lost in wrong:
        print(f"nothing prints: {message}\n  not found: {lost}")
    print(f"{len(messages)} messages, {len(wrong)} of them not in the sources")
    return 1 if wrong or not messages or not missing("no such message", printed) else 0


if __name__ == "__main__":
    sys.exit(main())

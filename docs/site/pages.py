#!/usr/bin/env python3
"""Does what a page tells its reader to do: executes its fenced blocks in order, in a folder of their own.

    VITRUM=build/release/src/app/vitrum docs/site/pages.py docs/tutorials/laminate.md      writes the page's outputs and pictures anew

    ```sh       is executed by bash
    ```python   by one interpreter for the whole page
    ```toml     is written to the file that its first line names: "# window.toml"
    ```text     is what the block before it prints, after a first line "..." its end; a test compares words, and takes any number for any other

`<!-- low resolution: a.b=VALUE ... -->` in a page: what a test sets in every run of it. `<!-- not executed: WHY -->` on the line before a block excuses it."""
import contextlib
import io
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass

source = pathlib.Path(__file__).resolve().parents[2]
fence = re.compile(r"^(?:<!-- not executed: (?P<excuse>[^\n]+) -->\n)?```(?P<kind>\w+)\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)
number = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?")


@dataclass
class Block:
    kind: str
    text: str
    place: str  # page:line
    line: int
    span: tuple[int, int]  # of the text, in the page
    excuse: str | None


class Stumble(Exception):
    """A block that does not do what its page says."""


def blocks(page):
    text = page.read_text()
    if len(re.findall("^```", text, re.MULTILINE)) != 2 * len(list(fence.finditer(text))):
        raise Stumble(f"{page}: a fenced block without a kind, or without an end")
    found = []
    for match in fence.finditer(text):
        line = text.count("\n", 0, match.start("text"))
        found.append(Block(match["kind"], match["text"], f"{page.name}:{line + 1}", line, match.span("text"), match["excuse"]))
    return found


def shapes(text):
    """Lines with every number made alike."""
    text = text.removeprefix("...\n")
    return [" ".join(number.sub("#", line).split()) for line in text.splitlines() if line.strip()]


class Reader:
    """Follows pages in `folder`: with the program, the studies and the Python package at hand, as docs/start has them."""

    def __init__(self, folder, sets=()):
        self.folder, self.names = pathlib.Path(folder), {"__name__": "__main__"}
        tools = self.folder / ".tools"
        tools.mkdir()
        program = tools / "vitrum"
        more = " ".join(f"--set '{one}'" for one in sets)
        program.write_text(f'#!/bin/bash\n[ "$1" = run ] && exec "{os.path.abspath(os.environ["VITRUM"])}" run "$2" {more} "${{@:3}}"\n'
                           f'exec "{os.path.abspath(os.environ["VITRUM"])}" "$@"\n')
        program.chmod(0o755)
        for name in ("studies", "examples", "tests", "docs"):
            (self.folder / name).symlink_to(source / name)
        self.environment = os.environ | {"VITRUM": str(program), "PATH": f"{tools}:{source / 'studies'}:{os.environ['PATH']}", "MPLBACKEND": "Agg",
                                         "PYTHONPATH": str(source / "studies"), "PYTHONDONTWRITEBYTECODE": "1"}

    def follow(self, page):
        """Yields each block with what it printed; "" for files, and for what is excused."""
        for block in blocks(page):
            if block.excuse:
                yield block, ""
            elif block.kind in self.manners:
                yield block, self.manners[block.kind](self, block)
            else:
                raise Stumble(f"{block.place}: a block of kind '{block.kind}' is not executed; excuse it with a reason")

    def shell(self, block):
        done = subprocess.run(["bash", "-euo", "pipefail", "-c", block.text], cwd=self.folder, env=self.environment, text=True, stdin=subprocess.DEVNULL,
                              capture_output=True)
        if done.returncode != 0:
            raise Stumble(f"{block.place}: status {done.returncode}\n{done.stdout}{done.stderr}")
        return done.stderr + done.stdout  # apart: two streams in one pipe may cut each other's lines

    def python(self, block):
        printed, before, place = io.StringIO(), dict(os.environ), os.getcwd()
        os.environ.update(self.environment)
        os.chdir(self.folder)
        try:
            with contextlib.redirect_stdout(printed):
                exec(compile("\n" * block.line + block.text, block.place, "exec"), self.names)
        except Exception as error:
            raise Stumble(f"{block.place}: {type(error).__name__}: {error}\n{printed.getvalue()}") from error
        finally:
            os.chdir(place)
            os.environ.clear()
            os.environ.update(before)
        return printed.getvalue()

    def file(self, block):
        name = re.match(r"# (\S+\.toml)\b", block.text)
        if not name:
            raise Stumble(f"{block.place}: the first line does not name the file")
        (self.folder / name[1]).write_text(block.text)
        return ""

    def shown(self, block):
        return ""

    manners = {"sh": shell, "python": python, "toml": file, "text": shown}


def low_resolution(page):
    found = re.search(r"<!-- low resolution: (.+) -->", page.read_text())
    return found[1].split() if found else []


def test(page, folder):
    """Raises Stumble where a reader would stumble: a block that fails, an output that reads otherwise, a picture that nothing made."""
    printed = ""
    for block, output in Reader(folder, low_resolution(page)).follow(page):
        if block.kind != "text":
            printed = output
        elif not block.excuse:
            missing = [line for line in shapes(block.text) if line not in shapes(printed)]
            if missing:
                raise Stumble(f"{block.place}: not printed: {missing}\nbut:\n{printed}")
    for picture in pictures(page):
        if not (pathlib.Path(folder) / picture.name).exists():
            raise Stumble(f"{page.name} shows {picture.name}, which none of its blocks made")


def pictures(page):
    """Those that the page's own blocks make."""
    return [page.parent / name for name in re.findall(r"!\[[^]]*\]\((\.\./pictures/pages/[^)]+)\)", page.read_text())]


def shown_of(printed, before):
    """All, or after "..." as many lines as stood there."""
    if not before.startswith("...\n"):
        return printed
    return "...\n" + "".join(printed.splitlines(keepends=True)[1 - len(before.splitlines()):])


def stamp(made, picture, page):
    """With what made it, as all pictures of these pages have."""
    from PIL import Image, PngImagePlugin
    version = subprocess.run([os.environ["VITRUM"], "--version"], check=True, capture_output=True, text=True).stdout.splitlines()[0]
    text = PngImagePlugin.PngInfo()
    text.add_text("vitrum-commit", re.search(r"\((.+)\)", version)[1])
    text.add_text("vitrum-command", f"docs/site/pages.py {page.relative_to(source)}")
    with Image.open(made) as image:
        image.save(picture, pnginfo=text)


def write(page):
    text, parts, end, printed = page.read_text(), [], 0, ""
    with tempfile.TemporaryDirectory(prefix="vitrum-") as folder:
        for block, output in Reader(folder).follow(page):
            if block.kind != "text":
                printed = output
            elif not block.excuse:
                parts += [text[end:block.span[0]], shown_of(printed, block.text)]
                end = block.span[1]
        for picture in pictures(page):
            picture.resolve().parent.mkdir(parents=True, exist_ok=True)
            stamp(pathlib.Path(folder) / picture.name, picture, page)
    page.write_text("".join(parts) + text[end:])


if __name__ == "__main__":
    sys.path.insert(0, str(source / "studies"))
    for name in sys.argv[1:]:
        write(pathlib.Path(name).resolve())

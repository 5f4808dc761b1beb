"""The page of a study: text with the numbers just measured."""
import datetime
import os
import pathlib
import platform
import re
import shutil
import subprocess

from study.case import program, root


class PageError(Exception):
    """Text and numbers do not fit together."""


def fill(template, values):
    """Replaces every {{NAME}}; each value must be used, and each name known, so that text and numbers stay together."""
    names = set(re.findall(r"\{\{(\w+)\}\}", template))
    if names != set(values):
        raise PageError(f"unknown names {sorted(names - set(values))}, unused values {sorted(set(values) - names)}")
    return re.sub(r"\{\{(\w+)\}\}", lambda match: str(values[match[1]]), template)


def _machine():
    model = "unknown processor"
    cpuinfo = pathlib.Path("/proc/cpuinfo")
    if cpuinfo.exists():
        match = re.search(r"model name\s*: (.*)", cpuinfo.read_text())
        model = match[1] if match else model
    system = platform.freedesktop_os_release().get("PRETTY_NAME", platform.system())
    return f"{model}, {os.cpu_count()} cores, {system}"


def provenance(name, quick):
    """Command, commit and machine, as the end of a page."""
    version = subprocess.run([program(), "--version"], capture_output=True, text=True, check=True).stdout.splitlines()[0]
    commit = subprocess.run(["git", "-C", root, "describe", "--always", "--dirty", "--abbrev=12"], capture_output=True, text=True)
    command = f"./quickstart study {name}" + (" --quick" if quick else "")
    return ("## How this page was made\n\n"
            f"`{command}`, {datetime.date.today().isoformat()}; commit {commit.stdout.strip() or 'unknown'} ({version}); {_machine()}. "
            "The program writes this page; do not edit it. The text is that of "
            f"`studies/{name}/page.md`; tables (CSV) and all figures (PNG, PDF) stand in `out/study-{name}{'-quick' if quick else ''}`.\n")


def publish(name, page, figures, names):
    """Puts the page into docs/ and the pictures that it shows beside it."""
    pictures = root / "docs" / "pictures" / f"study-{name}"
    pictures.mkdir(parents=True, exist_ok=True)
    for old in pictures.glob("*.png"):
        old.unlink()
    for figure in names:
        shutil.copy(pathlib.Path(figures) / f"{figure}.png", pictures)
    (root / "docs" / f"study-{name}.md").write_text(page.replace("](figures/", f"](pictures/study-{name}/"))

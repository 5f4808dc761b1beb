"""The page of a study: text with the numbers just measured."""
import datetime
import json
import os
import pathlib
import platform
import re
import shutil

from study.case import root
from study.provenance import commit, version


# "The paper" of all pages.
paper_title = "A Rate-Dependent Damage/Decohesion Model for Simulating Glass Fragmentation under Impact using the Material Point Method"


class PageError(Exception):
    """Text and numbers do not fit together."""


def fill(template, values):
    """Replaces every {{NAME}}, and keeps {{if NAME}} ... {{end}} where the value is true: what a variant has not measured it does not state. Each value
    must be used, and each name known, so that text and numbers stay together."""
    names = set(re.findall(r"\{\{(?:if )?(\w+)\}\}", template)) - {"end"}
    if names != set(values):
        raise PageError(f"unknown names {sorted(names - set(values))}, unused values {sorted(set(values) - names)}")
    kept = re.sub(r"\{\{if (\w+)\}\}(.*?)\{\{end\}\}", lambda match: match[2] if values[match[1]] else "", template, flags=re.DOTALL)
    return re.sub(r"\n{3,}", "\n\n", re.sub(r"\{\{(\w+)\}\}", lambda match: str(values[match[1]]), kept))


def pictures(page):
    """Names below figures/ that a page shows."""
    return re.findall(r"\]\(figures/([^)]+)\)", page)


def pictures_of_blocks(blocks, beside):
    """Names of the study's pictures that other pages show in its blocks, by their paths from the project's root."""
    return [name for text in blocks.values() for name in re.findall(rf'="{re.escape(beside)}/([^"]+)"', text)]


def check_pictures(names, figures):
    """Raises PageError when a picture that is shown is not in its folder."""
    missing = [name for name in names if not (pathlib.Path(figures) / name).exists()]
    if missing:
        raise PageError(f"pictures are shown that nobody drew: {', '.join(missing)}")


def machine():
    model = "unknown processor"
    cpuinfo = pathlib.Path("/proc/cpuinfo")
    if cpuinfo.exists():
        match = re.search(r"model name\s*: (.*)", cpuinfo.read_text())
        model = match[1] if match else model
    system = platform.freedesktop_os_release().get("PRETTY_NAME", platform.system())
    return f"{model}, {os.cpu_count()} cores, {system}"


def run_times(out):
    """How many times a study has run the program, and how long that took together (s)."""
    seconds = [json.loads(path.read_text())["seconds"] for name in ("outcome.json", "repeat-*.json") for path in sorted((pathlib.Path(out) / "runs").rglob(name))]
    return len(seconds), sum(seconds)


def measured_by(command):
    """Command, date, commit and machine: what a page of numbers begins with."""
    return f"*Measured by `{command}`, {datetime.date.today().isoformat()}; commit {commit()} ({version()}); {machine()}.*"


def provenance(name, quick, out):
    """What was run, and where text, tables and figures stand: what a page ends with."""
    count, seconds = run_times(out)
    return ("## How this page was made\n\n"
            f"{count:,} runs, {seconds:,.0f} s together. The program writes this page; do not edit it. The text is that of `studies/{name}/page.md`. "
            f"Tables (CSV) and all figures (PNG, PDF) stand in `out/study-{name}{'-quick' if quick else ''}`.\n")


def assemble(text, name, quick, out):
    """The page: below its title who measured it, where and when; at its end what was run."""
    title, body = text.split("\n", 1)
    command = f"./quickstart study {name}" + (" --quick" if quick else "")
    return f"{title}\n\n{measured_by(command)}\n{body}\n{provenance(name, quick, out)}"


def publish(page, shown, figures, target, beside):
    """Puts the page where readers find it, and the pictures that are shown beside it; paths from the project's root."""
    folder = root / beside
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*.png"):
        old.unlink()
    for picture in shown:
        shutil.copy(pathlib.Path(figures) / picture, folder)
    (root / target).write_text(page.replace("](figures/", f"]({os.path.relpath(root / beside, (root / target).parent)}/"))


def split_blocks(text):
    """Name -> text, of a template whose blocks begin with <!-- block NAME -->."""
    parts = re.split(r"<!-- block (\w+) -->\n", text)[1:]
    return {name: block.strip("\n") for name, block in zip(parts[::2], parts[1::2])}


def write_blocks(target, text):
    """Replaces what stands between <!-- made: NAME --> and <!-- end: NAME --> in a page; each block must have its place, and each place its block."""
    page, blocks = (root / target).read_text(), split_blocks(text)
    places = re.findall(r"<!-- made: (\w+) -->", page)
    if sorted(places) != sorted(blocks):
        raise PageError(f"{target} has places for {sorted(places)}, and there are blocks {sorted(blocks)}")
    for name, block in blocks.items():
        page = re.sub(rf"(<!-- made: {name} -->\n).*?(\n<!-- end: {name} -->)", lambda match: f"{match[1]}\n{block}\n{match[2]}", page, flags=re.DOTALL)
    (root / target).write_text(page)

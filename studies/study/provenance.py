"""Who made a result: the program, the commit of the tree, the command."""
import functools
import subprocess
import sys

from study.case import program, root


@functools.cache
def version():
    """The program's first line about itself."""
    return subprocess.run([program(), "--version"], capture_output=True, text=True, check=True).stdout.splitlines()[0]


@functools.cache
def commit():
    """Of the tree; "-dirty" where it differs from it, but for the pages that studies themselves write."""
    def git(*arguments):
        return subprocess.run(["git", "-C", root, *arguments], capture_output=True, text=True).stdout.strip()

    changed = git("status", "--porcelain", "--untracked-files=no", "--", ".", ":!docs", ":!README.md")
    return (git("describe", "--always", "--abbrev=12") or "unknown") + ("-dirty" if changed else "")


def made_by():
    """(command that makes the running study, program, commit)."""
    study = sys.modules["__main__"]
    quick = " --quick" if "--quick" in sys.argv else ""
    return f"./quickstart study {getattr(study, 'name', '?')}{quick}", version(), commit()

# The rules of every study. The Snakefile that includes them sets STUDY, and REPORT where its page is no page.md; the working directory is the study's output folder.
import importlib
import os
import pathlib
import shlex
import sys

STUDIES = pathlib.Path(workflow.basedir).parent
sys.path.insert(0, str(STUDIES))
from vitrum.program import program
os.environ["VITRUM"] = str(program())
QUICK = "--quick" if str(config.get("quick", 0)) not in ("0", "False", "") else ""
# Debian's interpreter has h5py and matplotlib; another python3 may stand first on PATH.
PYTHON = f"PYTHONPATH={shlex.quote(str(STUDIES))} PYTHONDONTWRITEBYTECODE=1 VITRUM={shlex.quote(os.environ['VITRUM'])} /usr/bin/python3 -m"
MODULE = f"{PYTHON} {STUDY}.study"
REPORT = globals().get("REPORT", "page.md")
JOBS = importlib.import_module(f"{STUDY}.study").jobs(bool(QUICK))
# Jobs of the study's files need none of the study's own module, nor what that draws with.
OF_FILES = importlib.import_module("study.files").weights()
importlib.import_module("study.progress").expect({job: OF_FILES.get(job, 1) for job in JOBS})

localrules: all, check

# Whatever may change results; runs that a change leaves as they are, are found again by their command (study/outcome.py).
SOURCES = [str(path) for folder in (STUDY, "study", "vitrum", "vitrum/plot") for path in sorted((STUDIES / folder).glob("*.py"))] + \
    [str(path) for path in sorted(STUDIES.glob("*/*.toml"))]

rule check:
    input: os.environ["VITRUM"], SOURCES, sorted(map(str, pathlib.Path(".").glob("plan*.json")))
    output: "checked.txt"
    message: "checking every scene"
    shell: "{MODULE} check {QUICK} > {output}"

rule job:
    input: "checked.txt"
    output: touch("jobs/{job}.done")
    message: "{wildcards.job}"
    params: module=lambda wildcards: f"{PYTHON} study.files" if wildcards.job in OF_FILES else MODULE
    shell: "{params.module} run {wildcards.job} {QUICK}"

rule report:
    input: expand("jobs/{job}.done", job=JOBS), [str(path) for pattern in ("*.md", "*.html") for path in sorted((STUDIES / STUDY).glob(pattern))]
    output: REPORT
    message: "tables, figures and page"
    shell: "{MODULE} report {QUICK}"

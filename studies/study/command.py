"""The command line of a study's module: `check`, `run JOB`, `report`; the rules of Snakemake call it."""
import argparse
import os
import pathlib
import sys
from concurrent.futures import ThreadPoolExecutor

from study.case import check
from study.file import explained
from study.outcome import StudyError
from study.page import PageError, assemble, check_pictures, fill, pictures, pictures_of_blocks, publish, write_blocks


def _check(cases):
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        faults = [explained(case, fault) for case, fault in zip(cases, pool.map(check, cases)) if fault]
    for fault in faults:
        print(fault, file=sys.stderr)
    print(f"{len(cases)} scenes checked, {len(faults)} invalid")
    return 2 if faults else 0


def _report(study, quick, out):
    values = study.report(quick, out)
    if values is None:  # it has written its page itself
        return 0
    folder = pathlib.Path(str(sys.modules[study.__name__].__file__)).parent
    page = assemble(fill((folder / "page.md").read_text(), values), study.name, quick, out)
    blocks = {target: fill((folder / template).read_text(), study.block_values(quick, out)) for target, template in getattr(study, "blocks", {}).items()}
    beside = getattr(study, "pictures", f"docs/pictures/study-{study.name}")
    shown = [*pictures(page), *pictures_of_blocks(blocks, beside)]
    check_pictures(shown, out / "figures")
    for target, text in blocks.items():
        (out / f"blocks-of-{target}").write_text(text)
    (out / "page.md").write_text(page)
    if not quick:
        name = study.name
        publish(page, shown, out / "figures", getattr(study, "page", f"docs/reports/study-{name}.md"), beside)
        for target, text in blocks.items():
            write_blocks(target, text)
    return 0


def main(study):
    """`study` is a module with: name; jobs(quick): names of jobs; cases(quick): every case that is known beforehand;
    run(job, quick, out); report(quick, out): values of the page, or None where it writes that itself. It may name its page and the folder of its pictures, and templates of blocks in other
    pages, with block_values(quick, out)."""
    parser = argparse.ArgumentParser(description=study.__doc__)
    parser.add_argument("verb", choices=["check", "run", "report"])
    parser.add_argument("job", nargs="?")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("."))
    options = parser.parse_args()
    try:
        if options.verb == "check":
            return _check(study.cases(options.quick))
        if options.verb == "run":
            study.run(options.job, options.quick, options.out)
            return 0
        return _report(study, options.quick, options.out)
    except (StudyError, PageError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 3

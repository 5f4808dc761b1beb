#!/usr/bin/python3
"""Everything that docs/reports/performance.md says in figures, measured on this machine, in one command:

    studies/performance/measure.py BUILD [--out DIR] [--repetitions N] [--quick]

BUILD is a build tree with the target vitrum_benchmarks (cmake --preset native && cmake --build --preset native). Leaves performance-measurements.md
(tables), benchmarks.json (Google Benchmark's context and every repetition's time) and pictures/roofline.png in DIR (default: docs/reports, and the picture in docs).
What performance.md says of the aims goes into its places there, and with --out into DIR/performance-blocks.md. --quick: small scenes once, to see that the script runs.
Run it on a quiet machine: it times.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys

import aims
import linear_solvers
import runs
import tables
from roofline import draw_roofline

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))
from study import page  # noqa: E402


def run_benchmarks(build, out, repetitions, quick):
    """Medians of Google Benchmark, by name; what of a name is measured stands in tests/benchmark."""
    results = out / "benchmarks.json"
    command = [build / "tests/benchmark/vitrum_benchmarks", f"--benchmark_out={results}", "--benchmark_out_format=json",
               f"--benchmark_repetitions={repetitions}", "--benchmark_enable_random_interleaving=true"]
    if quick:
        command += ["--benchmark_min_time=1e-9", "--benchmark_filter=-(thousand:500|thousand:80|large_plate|reference_run)"]
    else:
        command += ["--benchmark_min_time=0.2"]
    done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    report = json.loads(results.read_text())
    entries = report["benchmarks"]
    failed = [e for e in entries if e.get("error_occurred")]
    if failed:
        sys.exit(f"{failed[0]['name']}: {failed[0]['error_message']}")
    by_name = {}
    for entry in entries:
        if entry["run_type"] == "iteration":
            by_name.setdefault(entry["run_name"], []).append(entry)
    by_name = dict(sorted(by_name.items(), key=lambda item: [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", item[0])]))
    compact = {name: {"unit": runs[0]["time_unit"], "label": runs[0].get("label", ""), "times": [run["real_time"] for run in runs]}
               for name, runs in by_name.items()}
    results.write_text(json.dumps({"context": report["context"], "benchmarks": compact}, indent=1) + "\n")
    return by_name


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path)
    parser.add_argument("--repetitions", type=int, default=7)
    parser.add_argument("--quick", action="store_true")
    arguments = parser.parse_args()
    repetitions = 2 if arguments.quick else max(5, arguments.repetitions)
    docs = here.parent.parent / "docs"
    out, pictures = arguments.out or docs / "reports", (arguments.out or docs) / "pictures"
    pictures.mkdir(parents=True, exist_ok=True)
    program = arguments.build / "src/app/vitrum"

    benchmarks = run_benchmarks(arguments.build, out, repetitions, arguments.quick)
    memory = tables.memory(program, arguments.quick)
    threads = tables.threads(program, repetitions, arguments.quick)
    solvers = linear_solvers.measure(program, benchmarks, repetitions, arguments.quick)
    whole = runs.whole_processes(program, repetitions)
    parts = [tables.header(program, repetitions),
             tables.machine_and_scenes(benchmarks),
             tables.parts_of_a_step(benchmarks),
             tables.responses(benchmarks),
             tables.required(program, repetitions, arguments.quick, memory),
             tables.growth(program, repetitions, arguments.quick, threads),
             "## Linear solvers\n\n" + linear_solvers.rows(solvers)]
    (out / "performance-measurements.md").write_text("\n\n".join(parts) + "\n")
    blocks = aims.blocks(tables.measured(program), benchmarks, memory, threads, solvers, whole)
    if arguments.out:
        (out / "performance-blocks.md").write_text(blocks)
    else:
        page.write_blocks("docs/reports/performance.md", blocks)
    draw_roofline(benchmarks, pictures / "roofline.png", tables.version(program))


if __name__ == "__main__":
    main()

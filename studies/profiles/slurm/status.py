#!/usr/bin/python3
"""Tells Snakemake how a SLURM job fares: running, success or failed. Needs scontrol only, no accounting data base."""
import re
import subprocess
import sys

going_on = {"PENDING", "CONFIGURING", "RUNNING", "COMPLETING", "SUSPENDED", "REQUEUED", "RESIZING", "STAGE_OUT", "SIGNALING"}


def state(job):
    done = subprocess.run(["scontrol", "--oneliner", "show", "job", job], capture_output=True, text=True)
    match = re.search(r"JobState=(\w+)", done.stdout)
    if match:
        return match[1]
    # The controller forgets jobs after MinJobAge (300 s by default); where there is accounting it still knows.
    done = subprocess.run(["sacct", "--noheader", "--parsable2", "--allocations", "--format=State", "--jobs", job], capture_output=True, text=True)
    return done.stdout.split()[0] if done.stdout.split() else "UNKNOWN"


answer = state(sys.argv[1])
print("success" if answer == "COMPLETED" else "running" if answer in going_on else "failed")

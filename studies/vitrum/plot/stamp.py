"""What a picture carries of its origin, as PNG text: `vitrum-...` keys."""
import hashlib


def of_run(run):
    """Of one run: program, commit, command, and the scene that was run, as the program had understood it."""
    made = run.provenance
    return {"Source": f"vitrum {made['version']}, commit {made['git']}", "vitrum-commit": made["git"], "vitrum-command": made["command"],
            "vitrum-scene": run.resolved, "vitrum-scene-sha256": hashlib.sha256(run.resolved.encode()).hexdigest()}


def of_study(command, version, commit):
    """Of a figure that a study draws from many runs."""
    return {"Source": f"{version}; {command} at commit {commit}", "vitrum-commit": commit, "vitrum-command": command}


def read(path):
    """The text of a PNG, by key."""
    from PIL import Image
    with Image.open(path) as picture:
        return {key: value for key, value in picture.text.items()}

"""Small file systems for tests: in a mount namespace of the test's own, so that nothing is left behind, whatever happens."""
import contextlib
import os
import shutil
import subprocess
import sys
import unittest


def enter_private_mounts():
    """Starts this script again where it may mount file systems that only it sees; returns where that is not allowed."""
    if "VITRUM_TEST_MOUNTS" in os.environ or shutil.which("unshare") is None:
        return
    user = [] if os.geteuid() == 0 else ["--user", "--map-root-user"]
    unshare = ["unshare", *user, "--mount", "--propagation", "private"]
    if subprocess.run([*unshare, "mount", "-t", "tmpfs", "none", "/mnt"], capture_output=True).returncode == 0:
        os.environ["VITRUM_TEST_MOUNTS"] = "user" if user else "root"
        os.execvp("unshare", [*unshare, sys.executable, *sys.argv])


allowed = "VITRUM_TEST_MOUNTS" in os.environ
is_root = os.geteuid() == 0 and os.environ.get("VITRUM_TEST_MOUNTS") != "user"  # of the whole system
needs_mounts = unittest.skipUnless(allowed, "this user may not mount file systems")


@contextlib.contextmanager
def mounted(folder, *arguments):
    """Mounts on `folder`, for as long as the block runs; yields a function that changes options of a tmpfs. Skips the test
    where the system has no such file system."""
    folder.mkdir(exist_ok=True)
    done = subprocess.run(["mount", *map(str, arguments), str(folder)], capture_output=True, text=True)
    if done.returncode != 0:
        raise unittest.SkipTest(done.stderr.strip())
    try:
        # With type and source: the options that mount would otherwise look up name users that are unknown in here.
        yield lambda options: subprocess.run(["mount", "-t", "tmpfs", "-o", f"remount,{options}", "none", str(folder)], check=True)
    finally:
        subprocess.run(["umount", str(folder)], check=True)

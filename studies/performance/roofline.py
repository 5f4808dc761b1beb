"""The roofline: what the machine allows at an intensity of flops a byte, and where the scenes stand."""
import statistics

import matplotlib

import counts

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402


def median(entries, key):
    return statistics.median(entry[key] for entry in entries)


def ceilings(benchmarks):
    """Bytes a second of memory, flops a second of scalars and of vectors, one core."""
    return (median(benchmarks["memory_triad"], "bytes_per_second"), median(benchmarks["peak_scalar"], "items_per_second"),
            median(benchmarks["peak_vector"], "items_per_second"))


def scene_points(benchmarks):
    """(label, particle-steps a second) of the bar's sizes that were run, one core."""
    points = []
    for thousands in (1, 20, 80, 500):
        entries = benchmarks.get(f"elastic_bar/thousand:{thousands}/threads:1/real_time")
        if entries:
            points.append((f"{thousands}k particles", median(entries, "items_per_second")))
    return points


def draw_roofline(benchmarks, path, version):
    """`version`: the measured program's, which the picture carries."""
    bandwidth, scalar, vector = ceilings(benchmarks)
    intensity = [2.0**k for k in range(-4, 8)]
    figure, axes = plt.subplots(figsize=(7, 4.5), layout="constrained")
    for peak, label in ((vector, f"vector peak, {vector / 1e9:.0f} Gflop/s"), (scalar, f"scalar peak, {scalar / 1e9:.0f} Gflop/s")):
        axes.loglog(intensity, [min(peak, bandwidth * x) / 1e9 for x in intensity], label=label)
    axes.loglog([], [], " ", label=f"slope: memory (triad), {bandwidth / 1e9:.0f} GB/s")
    x = counts.flops(4) / counts.bytes_moved()
    for label, rate in scene_points(benchmarks):
        axes.loglog([x], [rate * counts.flops(4) / 1e9], "o", label=f"bar, {label}")
    axes.set_xlabel("flops a byte that leaves the cache")
    axes.set_ylabel("Gflop/s")
    axes.set_title("Explicit MUSL step, one core")
    axes.grid(True, which="major", alpha=0.3)
    axes.legend(fontsize=8)
    figure.savefig(path, dpi=150, metadata={"Source": version, "vitrum-commit": version, "vitrum-command": "studies/performance/measure.py"})

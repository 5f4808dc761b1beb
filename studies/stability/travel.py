"""Growth of disturbances of a row that travels through the grid."""
import numpy as np
from study.case import Case
from study.outcome import run

from stability.limits import cell, length, time_unit, wave_speed
from stability.theory import growth_per_cell

travel = 24  # cells
settled = 0.4  # share of the travel after which the fastest wave is taken to lead
outputs_per_cell = 4
disturbance = 1e-10  # of the wave speed, over the row: far above rounding, far below what would strain the row
largest = 1e-3  # of the wave speed: beyond, growth is no longer linear


def case(scheme, shape, per_side, speed, dt):
    """`speed` over wave speed, `dt` in cells over wave speed. The walls are out of the way."""
    # Outputs cut the way into equal steps: whole steps between them, or the step would not be `dt`.
    steps = max(1, round(1.0 / (outputs_per_cell * speed * dt)))
    return Case(f"travel-{scheme}-{shape}-{per_side**2}-{speed:.5f}-{dt:.4f}", "stability/row.toml", {
        "space.shape_functions": shape, "integrator.scheme": scheme, "integrator.step": dt * time_unit * (1.0 + 1e-9),
        "time.end": travel / speed * time_unit, "output.every": steps * dt * time_unit, "output.fields": ["velocity"],
        "body.0.particles_per_cell": per_side**2, "body.0.velocity": [speed * wave_speed, 0.0],
        "body.0.velocity_gradient": [[disturbance * wave_speed / (length * cell), 0.0], [0.0, 0.0]],
        "boundary.1.box.max.0": -1.0, "boundary.2.box.min.0": 1.0})


def roughness(results, per_side):
    """Root mean square second difference between neighbours along the row, over the wave speed: short waves only. By output:
    distance travelled (cells) and roughness."""
    places, velocities = results.fields("position")[:, :, 0], results.fields("velocity")[:, :, 0]
    order = np.argsort(places[0], kind="stable")[::per_side]
    middle = order[len(order) // 4: -len(order) // 4]
    distance = np.median(places[:, middle] - places[0, middle], axis=1) / cell
    return distance, np.sqrt(np.mean(np.diff(velocities[:, middle], 2, axis=1) ** 2, axis=1)) / wave_speed


def measured_growth(scheme, shape, per_side, speed, dt, runs):
    """Amplitude's growth per cell, from a straight line through the logarithms; None where too few outputs are left."""
    outcome = run(case(scheme, shape, per_side, speed, dt), runs)
    distance, values = roughness(outcome.results, per_side)
    values = np.where(np.isfinite(values), values, np.inf)
    beyond = np.nonzero(values > largest)[0]
    stop = beyond[0] if beyond.size else len(values)
    chosen = np.arange(len(values)) < stop
    chosen &= (distance >= settled * distance[stop - 1]) & (values > 0.0)
    if chosen.sum() < 4:
        return None
    return float(np.exp(np.polyfit(distance[chosen], np.log(values[chosen]), 1)[0]))


def row(scheme, shape, per_side, speed, dt, runs):
    return {"scheme": scheme, "shape": shape, "particles_per_cell": per_side**2, "speed": speed * wave_speed, "dt": dt,
            "step_us": 1e6 * dt * time_unit, "theory": growth_per_cell(scheme, shape, per_side, speed, dt),
            "measured": measured_growth(scheme, shape, per_side, speed, dt, runs)}

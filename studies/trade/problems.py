"""The three problems: the studies of three files, a row for each rung of their ladders."""
from study.ladders import field_of_velocity, trade_rows
from study.results import Study

keys = {"impact": "smooth impact", "onset": "to first localisation", "failure": "into failure"}  # and what panels of a figure call them
fixed_steps = ("usf", "usl", "musl")


class Problem:
    """`rows`: work, and errors by quantity, of every rung; `floors`: how far the references are apart, by (shape functions, quantity). "velocity" is the field's RMS."""

    def __init__(self, key, out):
        self.key, self.short, self.study = key, keys[key], Study(out, key)
        end = self.study.scene["time"]["end"]
        self.title = self.study.plan["title"].replace("its end", f"{1e6 * end:g} µs")
        self.names = ["velocity", *[quantity.name for quantity in self.study.quantities]]
        self.shapes = [point["space.shape_functions"] for point in self.study.plan["points"]]
        self.floors: dict[tuple[str, str], float | None] = {}
        found: dict[tuple, dict] = {}
        for row in trade_rows(self.study):
            shape, name = self.shapes[row["point"]], "velocity" if row["quantity"] == field_of_velocity else row["quantity"]
            self.floors[shape, name] = row["references_apart"]
            into = found.setdefault((shape, row["method"], row["rung"]), self._work(shape, row))
            into[name] = row["error"]
            if name == "velocity":
                into["own velocity"] = row["own_error"]
        self.rows = list(found.values())

    def _work(self, shape, row):
        family, _, local = row["method"].partition("-")
        case = self.study.cases[self.study.named("ladder", point=row["point"], method=row["method"], rung=row["rung"])[0]]
        return {"problem": self.key, "shape": shape, "family": family, "tightness": case["settings"]["integrator.step" if family in fixed_steps else "integrator.rtol"],
                "local": f"{local} {row['tightness']:g}" if local else "closed-form", "status": row["status"], "seconds": row.get("seconds"), "steps": row.get("steps"),
                "rejected": row.get("rejected"), "rhs": row.get("rhs_evaluations"), "made": -(row.get("residual") or 0.0), "estimate": row.get("estimate")}

    def linear(self):
        return [row for row in self.rows if row["shape"] == "linear"]

    def named(self, shape):
        """With one particle per cell gimp's functions are those of bspline2, and one of both is run."""
        return "gimp, bspline2" if shape == "bspline2" and "gimp" not in self.shapes and len(self.shapes) > 1 else shape

    def references(self, shape):
        """Names of both references' cases."""
        return self.study.named("reference", point=self.shapes.index(shape))


def read(out):
    return {key: Problem(key, out) for key in keys}

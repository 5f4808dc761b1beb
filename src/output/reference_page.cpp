#include "output/reference_page.hpp"

#include <fmt/format.h>

#include "materials/registry.hpp"
#include "observe/registry.hpp"

namespace vitrum::output {
namespace {

constexpr std::string_view before_variables = R"(# What a run leaves behind

A run writes into its output directory:

| file | what it holds | when it is written |
|---|---|---|
| `summary.json` | the run in numbers | at the end, whatever the end was |
| `result.h5` | the door: links to all outputs, the series, the scene, how it was made | at every output |
| `steps/NNNNN.h5` | the particles at an output, a file each | at that output |
| `steps/particles.h5` | what is constant of particles: body, mass, size | at the start |
| `result.xdmf`, `steps/NNNNN.xmf` | open the outputs in ParaView | at every output |
| `energy.csv`, `events.csv`, ... | tables of the whole run: [below](#tables) | row by row |
| `tables.h5` | the same tables for HDF5's readers | at the end, whatever it was, and at a resumption |
| `checkpoint.h5` | everything a resumed run needs | on a signal, as `output.checkpoint_every` asks, and when something else cannot be written |
| `failed_point.toml` | the increment of a particle that could not be integrated | at such a failure |

All numbers are SI. Axisymmetric quantities are those of the whole body (not per radian), plane-strain ones are per metre.
A folder may be moved and copied as a whole: the links in it are relative.

## What a kill cannot break

- **Files are replaced, not changed**, but for tables (`*.csv`). A file's next version is written under a hidden name (`.NAME.next`) and put in place by renaming. At any moment, also after `kill -9`, each is complete, in its new or in its former version.
  A `.NAME.next` left behind by a kill may be deleted.
- **`result.h5`** always leads to the outputs `00000 .. n-1` without a gap, and each series has exactly one row per output. It may be read while the run goes on. A program that has it open keeps the version that it opened. What others write into it is lost at the next output.
- **The door grows** with the number n of outputs, by some 250 bytes each. Where outputs follow each other within 50 ms it is renewed after n/64 of them: the time of a run does not grow with the square of n. Outputs that it does not show yet are complete all the same.
- **Tables** get whole lines, those of `events.csv` some hundred at a time. A kill may cost the last 16 kB of them, which a resumed run writes anew. A row that a kill has cut within the system's own call has no end of line.
- **A power cut**, unlike a kill, may cost what came after the last checkpoint. Outputs are forced to disk when a checkpoint is written and at the end of the run, not one by one. Whole files of outputs may be missing or empty then; `--resume` goes on from the checkpoint.
- **A checkpoint** carries the SHA-256 of its content. It is refused when a single bit of it has changed. Doubles are restored bit for bit.
- **All that HDF5 files hold carries checksums**: HDF5's own for their structure (format 1.10) and for arrays (Fletcher-32), a SHA-256 for single texts. A byte that a failing disk alters there is an error for every reader, not another value. Truncated and foreign files are refused with a message.
- **`vitrum info`, `compare` and `--resume`** check what they read. They follow no links but open an output by its name, and refuse one whose time is not that of the series.
- **`--resume`** removes the outputs that its checkpoint does not know, cuts tables back, then continues. A resumed explicit run gives the bits of an uninterrupted one. An adaptive run does from a planned checkpoint. From one written on a signal it keeps its tolerance.

## A folder belongs to one run

| you start a run into | it |
|---|---|
| a folder where another run is under way | ends with status 2 and touches nothing, with `--resume` and `--force` too |
| a folder that holds an earlier run | ends with status 2 and touches nothing |
| the same with `--resume` | goes on from that run's checkpoint |
| the same with `--force` | replaces that run |
| a folder without a checkpoint, with `--resume` | ends with status 4 |

- **A folder holds a run** when there is a checkpoint, a result with at least one output, or a summary that does not tell of a failure. A run that was killed or failed before its first output leaves none. Files of a run's names that no run wrote count as well. Files of
  other names are neither looked at nor touched.
- **Why refuse?** A run may have cost days, and the command that destroys it differs from the one that made it by nothing. A script that means to repeat says `--force`.
- **`--resume` wants the scene and the `--set` values** of the run that it continues: a command line says all that it computes. Otherwise it ends with status 2. The message names the keys that differ, and the command that continues the run. A run that is interrupted
  prints that command, too.
- **The lock** (`flock` on `.vitrum.lock`) goes with the process, however that ends. A file system without locks is warned of.
- **A folder that is moved, removed, or cleared and taken by another run** ends the run with status 4, which leaves the other's files alone.

## When something cannot be written

- The run ends with status 4. The message names the file and the system's reason. Completed outputs stay as they are.
- The space of what could not be completed is given back, and a checkpoint is tried. Where it fits, `--resume` goes on at that very step when the cause has been mended.
- Messages and progress are not part of the result. A terminal that has gone, a broken pipe or a full disk behind them ends no run.
- SIGINT, SIGTERM and SIGHUP (without `nohup`) end a run after the step under way, with a checkpoint, and status 130, 143 or 129. A second SIGINT, at least half a second later, ends it at once and without one.

## `result.h5` and the outputs behind it

HDF5 in the 1.10 file format (any HDF5 from 1.10 on reads it), without compression. `/particles`, `/steps/NNNNN`, `/tables` and `/events` are external links, which h5py and other readers follow by themselves.

Texts are UTF-8. Those in datasets have a fixed length; h5py hands them out as bytes. Those in attributes are there twice: `unit`, of variable length, is what h5py hands out as `str`; `.unit`, of a fixed length, is what this program reads. (HDF5 keeps the former in a heap without checksums, where a flipped
bit makes HDF5 1.10 loop.)

| object | type | meaning |
|---|---|---|
| `/` | attributes `format` (`vitrum result 3`), `title` | |
| `/scene/verbatim`, `/scene/resolved` | text, attribute `sha256` | the scene file unchanged; the scene with `--set` applied and every default filled in |
| `/provenance` | attributes `version`, `git`, `command`, `sundials`, `compiler`, `host`, `started`, `scene_sha256` | how the result was made; the digest is of the resolved scene |
| `/bodies` | text, one per body | names |
| `/particles/body` | uint32, N | index into `/bodies` |
| `/particles/mass` | double, N | mass, kg or kg/m |
| `/particles/size` | double, N | side of the particle's square at the start, m |
| `/particles/index` | uint32, N | 0 .. N-1 |
| `/steps/NNNNN` | attributes `time` (s), `step_index` | one group per output, from `00000` |
| `/steps/NNNNN/particles/FIELD` | double, N or N x components | see below; absent with `--no-fields` |
| `/steps/NNNNN/drawn/BODY/FIELD` | double | the same for ParaView, by number of the body: see below |
| `/tables/TABLE/COLUMN` | double, one row per row of `TABLE.csv`; uint32 for a column of texts: index into `COLUMN_names` | as at the end of the run |
| `/events` | the same as `/tables/events` | |
| `/series/NAME` | double, one row per output | `time`, `step_index`, energies, counts, fronts, ...; NaN where the run gave no value |

Every dataset of `/particles`, `/steps/NNNNN/particles` and `/series` has the attributes `unit` and `description`. Row i is the same particle in every
dataset of a file: body after body, and within a body in the order in which the particles were made.

### Fields

`output.fields` chooses among them; `position` is always written. Without the key all that the scene's materials have are
written, except `elastic_strain`. A variable is NaN for particles whose material does not have it.

| field | components | unit | meaning |
|---|---|---|---|
| `position` | 2 | m | (r, z) or (x, y) |
| `velocity` | 2 | m/s | (r, z) or (x, y) |
| `stress` | 4 | Pa | (rr, zz, tt, rz) or (xx, yy, zz, xy), tension positive: force per area of the unstrained material, Kirchhoff's stress ([theory](../theory/strain-and-stress.md)). Cauchy's is this over the change of volume, from which it differs by 0.1 % where such glass fails |
| `damage` | 1 | 1 | D = 1 - K_bar/K, eq. 8 |
)";

constexpr std::string_view before_tables = R"(
## Tables

CSV: the first line names the columns, numbers round-trip, a cell without a value is empty, names that hold a comma or a quote are quoted (RFC 4180).
`energy.csv` and the histories never change the steps of a run: a row stands at the first step that ends when it is due or later; in
`arkode-implicit` that of a history at the first end of a Lagrangian phase, where particles move. Events stand in order of time, of body and of
particle, the same for any number of threads; a step locates them within itself (in `arkode-implicit` their place is that of the phase's start).
`output.events` chooses kinds: a kind that fires often (yield, closure) makes most of a long run's file (80 bytes an event).

What happened first, a front, the force on a boundary and the stress at a gauge are queries:

    import csv
    def read(name): return list(csv.DictReader(open(f"out/{name}.csv", newline="")))
    first = next(e for e in read("events") if e["kind"] == "localisation")
    front = [(e["time"], e["r"]) for e in read("events") if e["kind"] == "damage" and e["body"] == "plate"]
    rim = [(float(r["time"]), float(r["impulse_r"])) for r in read("reactions") if r["boundary"] == "rim"]
    force = [(t1, (p1 - p0) / (t1 - t0)) for (t0, p0), (t1, p1) in zip(rim, rim[1:])]    # mean over each interval, N
    gauge = [(p["time"], p["stress_rr"]) for p in read("probes") if p["probe"] == "back"]

Impulses are exact: along z (in plane strain along x and y) their sum over boundaries, with gravity's, is the change of the bodies' momentum to rounding, in every
integrator. A radial sum over a ring is no component of a vector: `impulse_r` is the integral of the radial force around the ring, which hoop stress and the
axis balance as well.
)";

constexpr std::string_view after_variables =
    R"(| `elastic_strain` | 4 | 1 | components as `stress`, tensor shear; only when asked for |

    import h5py
    with h5py.File("out/result.h5") as result:
        for step in result["steps"].values():
            print(step.attrs["time"], step["particles/damage"][:].max())

### ParaView

`result.xdmf` is a time series of a block per body, with its name (from the second output on the readers append a number: `plate[1]`). All three XDMF
readers of ParaView 5.11 and later open it. Vectors (`velocity`, `normal`) have three components, so that Glyph and Warp By Vector work; tensors
(`stress`, `elastic_strain`) are symmetric ones of six, xx yy zz xy yz xz, where x = r, y = z and z is the hoop in axisymmetry. Besides the fields of the
output there are `von_mises` and `pressure` (from `stress`), `mass`, `size` and `fragment`: the number of the connected piece that a particle belongs
to, 0 for the one of most particles, -1 for separated particles, NaN where a material cannot separate.

Two of the readers know no functions and no hyperslabs: so these arrays are stored again, by body, in `/steps/NNNNN/drawn`. Of 1,250 particles
with all fields an output takes 490 kB, 270 of them for this.

`studies/paraview_run.py` sets a picture up: `pvpython studies/paraview_run.py OUT`, or from ParaView's Python shell. It reflects an axisymmetric run at its
axis, draws each particle as a square of its size, and colours by separation.

)";

constexpr std::string_view after_tables = R"(
## `summary.json`

`null` stands for what did not happen, for models that are absent and for numbers that are not finite.

| key | meaning |
|---|---|
| `status`, `message` | `complete`, `failed` or `interrupted`; why |
| `warnings` | list of all that standard error was warned of, before the run and at its end |
| `time`, `particles`, `wall_seconds`, `total_seconds`, `threads` | time reached, s; particles; seconds spent in the time loop alone; seconds of the whole process, outputs and all (of a resumed run: both with those before the checkpoint); threads used |
| `integrator` | `method`, `steps`, `rejected`, `rhs_evaluations`, `newton_iterations`, `factorisations`, `step_min`, `step_max` (s), `phases` |
| `integrator.factor_entries` | most numbers in the sparse factors, 8 bytes each |
| `integrator.limited_by` | steps that were limited by `stability`, `contact` (stability, where contact is stiffer than the grid), `accuracy` (or `max_step`), `output`, `remap` |
| `integrator.error_estimate` | `total`, `position`, `velocity`, `strain`: sums of local errors over their scales; null: no estimate |
| `integrator.remap_loss` | J; arkode-implicit |
| `constitutive` | `method`, `evaluations` (bodies that coast take none), `cvode_solves`, `cvode_steps`, `cvode_rhs`, `increments_solved`, `solves`, `solver_steps`, `solver_rhs`, `failures`, `events` |
| `energy` | `initial`, `kinetic`, `elastic`, `plastic`, `damage`, `fracture`, `external` |
| `energy.snap_back` | the part of `fracture` that instantaneous releases dissipated |
| `energy.contact`, `.friction` | stored between bodies; dissipated between them |
| `energy.filtered` | removed by `space.filter` and `space.transfer` |
| `energy.removed` | gone with particles that left; only where `decohesion.separated` is `removed` |
| `energy.ringing` | elastic energy of pressures that differ from their average over cells, at the end: [theory](../theory/resolution.md) |
| `energy.residual`, `.relative_residual` | what the numerics created (negative) or destroyed |
| `energy.max_growth` | largest (kinetic + elastic) / initial |
| `failure.first_damage`, `.first_localisation`, `.first_separation` | {`time`, `r`, `z`, `body`} |
| `failure.localised`, `.separated` | particles at the end |
| `failure.crack_area`, `.localised_volume` | m^2, m^3 (plane strain: per metre); sum over the localised particles of V0/L_e, and of V0. The area is what has a limit as cells shrink: cracks are a cell wide |
| `failure.damage_threshold` | the damage D that `first_damage` waits for |
| `failure.localised_radius_max`, `.damage_front_radius` | m; largest r of a localised particle, of a particle with D > 0.1 |
| `failure.max_opening`, `.max_opening_radius` | m |
| `failure.perforated` | whether the projectile is through the target, whatever is left of that ([theory](../theory/failure.md)); null: no body moves at the start towards one that can separate |
| `failure.fragments` | `count`, `largest_mass`, `total_mass`, `list` of the 100 largest {`body`, `particles`, `mass`, `centre`, `velocity`} |
| `bodies.NAME` | `particles`, `mass`, `momentum`, `centre`, `kinetic`, the measures of `failure` for this body alone (`first_*`, `localised`, ... `max_opening_radius`), and `fragments`, their number; where `decohesion.separated` is `removed`, also `removed` and `removed_mass`: particles that have left, and their mass (kg), which `mass` is without |
| `contacts` | a list of the pairs of bodies between which there is contact: `bodies`, `impulse` (N s, on the first since the start; kg m/s gained), `friction_work` (J), `least_gap` (m, between opposite places of their surfaces, so far; negative: penetration) |
| `provenance` | as in `result.h5` |

## `checkpoint.h5`

The first 512 bytes hold the line `vitrum checkpoint 5 sha256 DIGEST`, of all that follows; then comes HDF5: attributes `time`,
`step_index`, `scene_sha256`; `/bodies/NNNNN` with every column of a body's particles in storage order; `/state` with the
state of everything else by name (`names` lists name and size, `values` holds the numbers; `texts`). It is made for `--resume` of the same version, not for analysis.
)";

/// Text of a table's cell: a bar would end it.
std::string cell(std::string_view text) {
  std::string escaped;
  for (const char letter : text) escaped += letter == '|' ? std::string("\\|") : std::string(1, letter);
  return escaped;
}

std::string section_of(const TableInfo& table) {
  std::string text = fmt::format("\n### `{}.csv`\n\n{}\n\n| column | unit | meaning |\n|---|---|---|\n",
                                 table.name, table.description);
  for (const Column& column : table.columns)
    text += fmt::format("| `{}` | {}{} | {} |\n", column.name, column.unit.empty() ? "text" : column.unit,
                        column.of_whole ? ", per metre in plane strain" : "", cell(column.description));
  return text;
}

}  // namespace

std::string result_reference() {
  std::string text(before_variables);
  for (const Component& column : all_columns())
    if (column.name != "damage")  // which the table has already
      text += fmt::format("| `{}` | 1 | {} | {} |\n", column.name, column.unit, cell(column.text));
  text += after_variables;
  text += before_tables;
  for (const ObserverKind& kind : observer_kinds())
    if (kind.table != nullptr) text += section_of(*kind.table);
  return text += after_tables;
}

}  // namespace vitrum::output

"""Compares Pellicle with its rivals: makes an environment for each, runs it in pairs with Pellicle, writes the table.

    python3 xtask/compare/compare.py                                                 everything: some hours
    python3 xtask/compare/compare.py --sizes 1024 --cases rough-2.5 --threads 1 --peers aspher --repeats 3

Needs Python, cargo, and the network once: one virtual environment per rival, since their requirements are incompatible.
Every run is a separate process. Each run of a rival is paired with one of Pellicle on the same problem, so that other
load on the machine affects both. A rival that exceeds the time budget for a problem is run fewer times; if it does not
finish even once, it is stopped and marked. `rivals.md` and `rivals.json` are rewritten after every problem.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
TOLERANCE = 1e-8
CASES = ("hertz", "pillars", "rough-0.1", "rough-2.5", "rough-20", "periodic", "saturated")
# Minimum number of elements per side that resolves a surface.
SMALLEST = {"rough": 1024, "periodic": 256, "saturated": 256}
CELLS = ("periodic", "saturated")
# The programs that use the symbol of the continuum, not of constant elements, in a periodic cell.
CONTINUUM = ("aspher", "tamaas", "contactmechanics")
NOT_PERIODIC = ("slippy",)
# The programs that can limit the pressure by a hardness in a cell.
SATURATED = ("pellicle", "tamaas")
THREAD_VARIABLES = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")
INSTALLATION_SECONDS = 1800
# Budget of Pellicle, which is run as often as its rivals.
UNBOUNDED = 1e6

# Arguments of `pip install`, one list per invocation.
REQUIREMENTS = {
    # From source; Eigen's headers must be installed.
    "aspher": [["aspher", "numpy"]],
    # Its own requirements cannot be met with current Pythons, so they are bypassed with versions that work.
    "slippy": [
        ["numpy==1.23.5", "numba==0.57.1", "scipy==1.10.1", "pyfftw==0.13.1", "matplotlib==3.7.5",
         "scikit-image==0.21.0", "sympy", "tinydb"],
        ["--no-deps", "slippy"],
    ],
    "tamaas": [["tamaas", "numpy", "scipy"]],
    "contactmechanics": [["ContactMechanics"]],
    "the-certificate": [["numpy", "scipy"]],
}
PEERS = ("aspher", "slippy", "tamaas", "contactmechanics")
# The programs whose PyPI packages can use more than one thread.
THREADED = ("pellicle", "aspher", "slippy")
# aspher's tolerance is relative to the range of the gap, 11 d_H for the paraboloid: at 1e-9 its certificate is
# comparable.
VARIANTS = {
    "aspher": [("aspher", 1e-8, []), ("aspher", 1e-9, []), ("aspher, active set", 1e-8, ["active-set"])],
    "slippy": [("slippy", TOLERANCE, [])],
    "tamaas": [("Tamaas", TOLERANCE, [])],
    "contactmechanics": [("ContactMechanics", TOLERANCE, [])],
}

COLUMNS = (
    "case", "n", "threads", "program", "version", "tolerance", "time, s", "fastest, s", "CPU, s", "products",
    "memory, MiB", "complementarity", "gap in contact", "overlap", "load", "gap at limit",
    "over limit", "difference", "contact, %", "at limit, %", "mean gap",
    "CPU / Pellicle's",
)
TEXTS = ("case", "program", "version")


def report(line):
    print(line, file=sys.stderr, flush=True)


def error_line(log):
    """The first line with a fatal error, or else the last with an error, or else the last line."""
    lines = [line.strip() for line in log.splitlines() if line.strip()]
    fatal = [line for line in lines if "fatal error" in line.lower()][:1]
    errors = [line for line in lines if "error" in line.lower()][-1:]
    return (fatal + errors + lines[-1:] + ["no output"])[0]


def environment(folder, name):
    """The Python of a program's environment, or the reason why there is none."""
    place = folder / name
    inside = place / ("Scripts" if os.name == "nt" else "bin") / "python"
    wanted = json.dumps(REQUIREMENTS[name])
    mark = place / "requirements.json"
    if mark.exists() and mark.read_text() == wanted:
        return inside, None
    report(f"installing {name}")
    commands = [[sys.executable, "-m", "venv", "--clear", str(place)]]
    commands += [[str(inside), "-m", "pip", "install", "--no-input", *arguments] for arguments in REQUIREMENTS[name]]
    for command in commands:
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=INSTALLATION_SECONDS)
        except subprocess.TimeoutExpired:
            return None, f"not installed after {INSTALLATION_SECONDS} s"
        if done.returncode:
            log = folder / f"{name}.log"
            log.write_text(done.stdout + done.stderr)
            return None, f"{error_line(done.stderr)} (whole log: {log.name})"
    mark.write_text(wanted)
    return inside, None


class Lane:
    """The runs of one program on one problem."""

    def __init__(self, key, name, tolerance, options, command, missing):
        self.key, self.name, self.tolerance, self.options = key, name, tolerance, options
        self.command, self.ended = command, missing
        self.runs, self.spent, self.pairs = [], 0.0, []

    def run(self, problem, budget, scratch):
        """Runs once more if there is time; returns the measurement, or None."""
        left = budget - self.spent
        if self.ended or (self.runs and self.spent / len(self.runs) > left):
            return None
        self.pressure = scratch / f"{self.name}-{self.tolerance:g}.npy".replace(" ", "-")
        arguments = [problem["case"], problem["n"], problem["threads"], self.tolerance, self.pressure, *self.options]
        settings = dict.fromkeys(THREAD_VARIABLES, str(problem["threads"])) | problem["settings"]
        start = time.perf_counter()
        try:
            done = subprocess.run(
                [*self.command, *map(str, arguments)], capture_output=True, text=True, timeout=left,
                env=os.environ | settings,
            )
        except subprocess.TimeoutExpired:
            done = None
        self.spent += time.perf_counter() - start
        if done is not None and done.returncode == 0:
            self.runs.append(json.loads(done.stdout.splitlines()[-1]))
            report(f"  {self.name} at {self.tolerance:g}: {seconds(self.runs[-1]):.3f} s")
            return self.runs[-1]
        # A failed later run does not discard the earlier good ones.
        self.ended = f"stopped after {self.spent:.0f} s" if done is None else f"failed: {error_line(done.stderr)}"
        report(f"  {self.name} at {self.tolerance:g}: {self.ended}")
        return None


def seconds(run):
    return run["setup_seconds"] + run["solve_seconds"]


def cpu(run):
    return run["cpu_seconds"] or seconds(run)


def compare(problem, programs, arguments):
    """Runs all programs on one problem, in pairs with Pellicle; returns one row each."""
    def lane(key, name, tolerance, options):
        command, missing = programs[key]
        if problem["threads"] > 1 and key not in THREADED:
            missing = "serial"
        if problem["case"] in CELLS and (key in NOT_PERIODIC or "active-set" in options):
            missing = "no periodic cell"
        if problem["case"] == "saturated" and key not in SATURATED:
            missing = "no hardness"
        return Lane(key, name, tolerance, options, command, missing)

    pellicle = lane("pellicle", "Pellicle", TOLERANCE, [])
    rivals = [lane("pellicle", "Pellicle, whole grid", TOLERANCE, ["--whole-grid"])] if problem["mirrored"] else []
    rivals += [lane(peer, *variant) for peer in arguments.peers for variant in VARIANTS[peer]]
    for _ in range(arguments.repeats):
        for rival in rivals:
            found = rival.run(problem, arguments.budget, arguments.out)
            if found:
                beside = pellicle.run(problem, UNBOUNDED, arguments.out)
                rival.pairs.append(cpu(found) / cpu(beside))
    if not pellicle.runs:
        pellicle.run(problem, UNBOUNDED, arguments.out)
    return [row(one, problem, pellicle, programs) for one in [pellicle, *rivals]]


def row(lane, problem, pellicle, programs):
    """The median run, and the certificate of the last pressure."""
    cells = {"case": problem["case"], "n": problem["n"], "threads": problem["threads"], "program": lane.name}
    cells["tolerance"] = f"{lane.tolerance:g}"
    if not lane.runs:
        return cells | {"time, s": lane.ended}
    median = sorted(lane.runs, key=seconds)[len(lane.runs) // 2]
    cells["version"] = median["version"]
    cells["time, s"] = digits(seconds(median)) + ("" if median["converged"] else " (not converged)")
    cells["fastest, s"] = digits(min(map(seconds, lane.runs)))
    cells["CPU, s"] = digits(statistics.median(map(cpu, lane.runs)))
    cells["products"] = median["products"]
    cells["memory, MiB"] = median["peak_bytes"] and -(-median["peak_bytes"] // 2**20)
    if lane is pellicle or lane.pairs:
        cells["CPU / Pellicle's"] = f"{statistics.median(lane.pairs or [1.0]):.1f}"
    python, _ = programs["the-certificate"]
    if python:
        operator = "continuum" if lane.key in CONTINUUM else "elements"
        arguments = [problem["case"], problem["n"], operator]
        command = [*python, HERE / "certificate.py", *arguments, lane.pressure, pellicle.pressure]
        lines = json.loads(subprocess.run(list(map(str, command)), capture_output=True, text=True, check=True).stdout)
        of_hardness = ("gap_at_limit", "over_limit") if problem["case"] == "saturated" else ()
        for name in ("complementarity", "gap_in_contact", "overlap", "load", "difference", *of_hardness):
            cells[name.replace("_", " ")] = f"{lines[name]:.1e}"
        if of_hardness:
            cells["at limit, %"] = f"{100.0 * lines['at_limit']:.4g}"
        cells["contact, %"], cells["mean gap"] = f"{100.0 * lines['contact']:.4g}", f"{lines['mean_gap']:.5g}"
    return cells


def digits(value):
    return f"{value:.3g}" if value < 10.0 else f"{value:.1f}"


def table(rows):
    rule = ["---" if column in TEXTS else "--:" for column in COLUMNS]
    cells = [["–" if row.get(column) is None else str(row[column]) for column in COLUMNS] for row in rows]
    return "".join("| " + " | ".join(line) + " |\n" for line in [list(COLUMNS), rule, *cells])


def processor():
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        lines = []
    names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return f"{(names or ['unknown processor'])[0]}, {os.cpu_count()} cores"


def write(rows, missing, folder):
    page = f"{processor()}, Python {sys.version.split()[0]}.\n\n{table(rows)}"
    page += "".join(f"\n- {name} is missing: {reason}" for name, reason in missing.items())
    (folder / "rivals.md").write_text(page + "\n")
    (folder / "rivals.json").write_text(json.dumps({"rows": rows, "missing": missing}, indent=1) + "\n")


def pose(case, n, threads, python, scratch):
    """A problem with the input of Pellicle's driver: the rough gap as a file, mean pressure, hardness."""
    problem = {"case": case, "n": n, "threads": threads, "settings": {}, "mirrored": kind(case) not in SMALLEST}
    if not problem["mirrored"]:
        gap = scratch / f"{case}-{n}.gap.npy"
        script = "import sys, numpy; from problem import Problem; p = Problem(sys.argv[1], int(sys.argv[2]));"
        script += "numpy.save(sys.argv[3], p.gap); print(float(p.mean_pressure), float(p.hardness))"
        command = [*python, "-c", script, case, str(n), str(gap)]
        numbers = subprocess.run(command, capture_output=True, text=True, check=True, cwd=HERE).stdout.split()
        problem["settings"] = {"GAP_FILE": str(gap), "MEAN_PRESSURE": numbers[0], "HARDNESS": numbers[1]}
    return problem


def kind(case):
    return case.split("-")[0]


def list_of(of):
    return lambda text: [of(item) for item in text.split(",")]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sizes", type=list_of(int), default=[1024, 2048], help="elements per side")
    parser.add_argument("--cases", type=list_of(str), default=list(CASES), help=", ".join(CASES))
    parser.add_argument("--threads", type=list_of(int), default=[1, 2])
    parser.add_argument("--peers", type=list_of(str), default=list(PEERS), help=", ".join(PEERS))
    parser.add_argument("--repeats", type=int, default=5, help="pairs of runs")
    parser.add_argument("--budget", type=float, default=600.0, help="seconds for a rival's runs on one problem")
    parser.add_argument("--out", type=Path, default=ROOT / "target" / "compare")
    arguments = parser.parse_args()
    unknown = set(arguments.cases) - set(CASES) | set(arguments.peers) - set(PEERS)
    if unknown:
        parser.error(f"unknown: {', '.join(sorted(unknown))}")
    arguments.out = arguments.out.resolve()
    environments = arguments.out / "environments"
    environments.mkdir(parents=True, exist_ok=True)

    build = ["cargo", "build", "--release", "--workspace", "--bin", "compare-pellicle"]
    subprocess.run(build, cwd=ROOT, check=True)
    binary = ROOT / "target" / "release" / "compare-pellicle"
    programs, missing = {"pellicle": ([binary], None)}, {}
    for name in ["the-certificate", *arguments.peers]:
        python, reason = environment(environments, name)
        driver = [] if name == "the-certificate" else [str(HERE / f"{name}_driver.py")]
        programs[name] = ([str(python), "-B", *driver] if python else None, reason and "missing")
        if reason:
            missing[name] = reason
            report(f"{name} is missing: {reason}")
    if programs["the-certificate"][0] is None:
        sys.exit("the certificate needs numpy and scipy")

    rows = []
    for case in arguments.cases:
        for n in arguments.sizes:
            if n < SMALLEST.get(kind(case), 0):
                continue
            for threads in arguments.threads:
                report(f"{case}, n = {n}, {threads} threads")
                problem = pose(case, n, threads, programs["the-certificate"][0], arguments.out)
                rows += compare(problem, programs, arguments)
                write(rows, missing, arguments.out)
    print((arguments.out / "rivals.md").read_text())


if __name__ == "__main__":
    main()

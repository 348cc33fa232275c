#!/usr/bin/env python3
"""Distances and tours of argil beside those of SciPy, OR-Tools and LKH (elkai), in one run.

    python3 benches/peers.py                    layers of 100, 200 and 400 support points, made from a seed
    python3 benches/peers.py LAYER.json …       layers as files, in the form that `instance` reads

What is not installed is named and left out; `pip install scipy ortools elkai` installs all of it. Times are
those of one thread, one after the other on the same machine, so that their ratios can be compared: of argil the least of some
rounds by the clock, of the others the processor's, which is no longer. Lengths are
whole micrometres: distances have to agree to the unit, and a difference is an error.
"""

import heapq
import json
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
SIZES = (100, 200, 400)
ROUNDS = 3

try:
    import scipy.sparse
    import scipy.sparse.csgraph
except ImportError:
    scipy = None
try:
    from ortools.constraint_solver import pywrapcp
except ImportError:
    pywrapcp = None
try:
    import elkai
except ImportError:
    elkai = None


def timed(work, rounds=1):
    """The least processor time of some rounds in milliseconds, and the last result."""
    least, done = float("inf"), None
    for _ in range(rounds):
        start = time.process_time()
        done = work()
        least = min(least, (time.process_time() - start) * 1e3)
    return least, done


def by_scipy(layer):
    """All distances among the terminals, and how long they took."""
    count = len(layer["vertices"])
    a, b, length = zip(*layer["edges"])
    graph = scipy.sparse.csr_array((length + length, (a + b, b + a)), shape=(count, count), dtype=float)
    terminals = layer["terminals"]
    least, rows = timed(lambda: scipy.sparse.csgraph.dijkstra(graph, indices=terminals), ROUNDS)
    return least, [[int(row[t]) for t in terminals] for row in rows]


def by_heap(layer):
    """The same without SciPy, for the tours' sake."""
    beside = [[] for _ in layer["vertices"]]
    for a, b, length in layer["edges"]:
        beside[a].append((b, int(length)))
        beside[b].append((a, int(length)))
    rows = []
    for source in layer["terminals"]:
        reached, waiting = {}, [(0, source)]
        while waiting:
            length, vertex = heapq.heappop(waiting)
            if vertex in reached:
                continue
            reached[vertex] = length
            for other, edge in beside[vertex]:
                if other not in reached:
                    heapq.heappush(waiting, (length + edge, other))
        rows.append([reached[t] for t in layer["terminals"]])
    return rows


def length_of(order, rows):
    return sum(rows[a][b] for a, b in zip(order, order[1:] + order[:1]))


def by_ortools(rows):
    """The tour of the routing solver with its default search."""
    manager = pywrapcp.RoutingIndexManager(len(rows), 1, 0)
    routing = pywrapcp.RoutingModel(manager)
    node = manager.IndexToNode
    cost = routing.RegisterTransitCallback(lambda a, b: rows[node(a)][node(b)])
    routing.SetArcCostEvaluatorOfAllVehicles(cost)
    solution = routing.SolveWithParameters(pywrapcp.DefaultRoutingSearchParameters())
    order, index = [], routing.Start(0)
    while not routing.IsEnd(index):
        order.append(node(index))
        index = solution.Value(routing.NextVar(index))
    return length_of(order, rows)


def by_lkh(rows):
    """One trial of LKH."""
    order = elkai.DistanceMatrix(rows).solve_tsp(runs=1)
    return length_of(order[:-1], rows)


def main(paths):
    for name, module in (("SciPy", scipy), ("OR-Tools", pywrapcp), ("LKH (elkai)", elkai)):
        if module is None:
            print(f"{name} is not installed: nothing is known of it", file=sys.stderr)
    build = ["cargo", "build", "--release", "--locked", "-q", "-p", "argil-benches", "--bin", "instance"]
    subprocess.run(build, cwd=ROOT, check=True)
    program = ROOT / "target/release/instance"
    failed = False
    with tempfile.TemporaryDirectory() as folder:
        if not paths:
            for size in SIZES:
                path = pathlib.Path(folder) / f"mixed_{size}.json"
                made = subprocess.run([program, "--make", str(size)], capture_output=True, check=True)
                path.write_bytes(made.stdout)
                paths.append(str(path))
        columns = "layer|T|order and distances|SciPy|tour, candidates included|OR-Tools|longer|LKH|longer"
        print("| " + columns.replace("|", " | ") + " |")
        print("|---" + "|--:" * 8 + "|")
        for path in paths:
            layer = json.loads(pathlib.Path(path).read_text())
            run = subprocess.run([program, path, "--rounds", str(ROUNDS)], capture_output=True, check=True)
            ours = json.loads(run.stdout)
            distances = ours["order_and_distances_ms"]
            tour = ours["candidates_ms"] + ours["tour_ms"]
            cells = [pathlib.Path(path).stem, str(ours["T"]), f"{distances:.2f} ms"]
            if scipy is None:
                rows = by_heap(layer) if pywrapcp or elkai else []
                cells.append("–")
            else:
                took, rows = by_scipy(layer)
                cells.append(f"{took / distances:.1f} ×")
            if rows and sum(map(sum, rows)) != ours["distances_sum_um"]:
                print(f"{path}: the distances differ from those of argil", file=sys.stderr)
                failed = True
            cells.append(f"{tour:.2f} ms")
            for peer, solve in ((pywrapcp, by_ortools), (elkai, by_lkh)):
                if peer is None:
                    cells += ["–", "–"]
                else:
                    took, length = timed(lambda: solve(rows))
                    cells += [f"{took / tour:.1f} ×", f"{100 * (length / ours['tour_um'] - 1):+.2f} %"]
            print("| " + " | ".join(cells) + " |", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

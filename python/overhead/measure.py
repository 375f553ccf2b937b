# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Prints how much slower Python calls Poise than C++ does.

Usage: measure.py TIME_CPP [--quick]

Three measurements: the time of each function from Python and from C++; the
CPU time of two threads with two controllers; and the time of `import poise`.
The times are the shortest of several rounds.

Exit code: 1 if a bound is exceeded: Tree.tick at most 3 us above C++, two
threads at most 1.2 times the CPU time, import below 0.3 s. With --quick, the
rounds are too few for that, and the code is 0.
"""

import pathlib
import subprocess
import sys
import threading
import time
import timeit

import numpy as np

import poise

ROBOT = poise.Robot.load()
TREE = ROBOT.tree
DATA = pathlib.Path(ROBOT.urdf).parents[2]
PROFILE = DATA / "robot/profiles/humanoid.yaml"
STAND = DATA / "sim/scenarios/stand.yaml"
ROUND = 5e-3  # s.
# The bounds; CONTRIBUTING.md forbids to assert a time in a test.
MOST_TICK_US, MOST_THREADS, MOST_IMPORT = 3, 1.2, 0.3


def arguments():
    """Returns the variables of the statements below; as in *_cases.cc."""
    v = np.linspace(-1, 1, TREE.nv)
    q = TREE.integrate(ROBOT.posture, v, 0.3)
    w, x = np.array([0.3, -0.5, 0.8]), np.array([0.3, -0.5, 0.8, 1, 2, -0.4])
    R, X = poise.so3.exp(w), poise.se3.exp(x)
    hierarchy = poise.Hierarchy(20)
    hierarchy.add_level(C=np.eye(20), upper=np.full(20, 0.1))
    hierarchy.add_level(B=np.eye(20), b=np.linspace(-1, 1, 20))
    state = poise.State(ROBOT.posture, np.zeros(TREE.nv))
    controller = poise.Controller(ROBOT)
    controller.start(state)
    feet = [foot.frame for foot in ROBOT.feet]
    contradiction = poise.Hierarchy(1)
    contradiction.add_level(C=[[1]], upper=[1])
    contradiction.add_level(B=[[1]], b=[-3])
    return {
        "tree": TREE, "q": q, "v": v, "vdot": -v, "frame": feet[0],
        "out": TREE.tick(q, v, feet), "w": w, "x": x, "R": R, "X": X,
        "X_inverse": poise.se3.inverse(X), "R_inverse": poise.so3.exp(-w),
        "W": poise.se3.hat(x), "quaternion": poise.so3.quaternion(R),
        "so3": poise.so3, "se3": poise.se3, "solver": poise.Solver(20),
        "hierarchy": hierarchy, "controller": controller, "state": state,
        "simulation": poise.Simulation(ROBOT, poise.Scenario.from_dict({})),
        "poise": poise, "robot": ROBOT,
        "scenario": poise.Scenario.from_dict({}), "library": "mujoco",
        "posture": ROBOT.posture, "zeros": np.zeros(TREE.nv),
        "q_library": TREE.export_configuration("mujoco", q),
        "M": TREE.crba(q), "J": np.ones((6, TREE.nv)), "one": np.ones((1, 1)),
        "three": np.full(1, -3.0), "limit": np.ones(1),
        "contradiction": poise.Solver(1).solve(contradiction),
    }


# The arguments of each function.
JACOBIANS = ("left_jacobian", "right_jacobian", "inverse_left_jacobian",
             "inverse_right_jacobian")
SO3 = {**dict.fromkeys(JACOBIANS + ("hat", "exp", "from_rpy"), "w"),
       **dict.fromkeys(("vee", "log", "project", "quaternion", "rpy"), "R"),
       "matrix": "quaternion", "interpolate": "R, R_inverse, 0.5"}
SE3 = {**dict.fromkeys(JACOBIANS + ("hat", "exp"), "x"),
       **dict.fromkeys(("log", "inverse", "adjoint", "dual_adjoint"), "X"),
       "vee": "W", "interpolate": "X, X_inverse, 0.5"}
TREE_ARGUMENTS = {
    "rnea": "q, v, vdot", "bias": "q, v", "crba": "q", "aba": "q, v, vdot",
    "pose": "q, frame", "jacobian": "q, frame", "jacobian_bias": "q, v, frame",
    "integrate": "q, v, 0.1", "difference": "q, q", "com": "q, v",
    "centroidal": "q, v", "kinetic_energy": "q, v", "potential_energy": "q",
    "derivatives": "q, v, vdot", "regressor": "q, v, vdot",
    "inertial_parameters": "", "neutral": "", "tick": "q, v, out=out",
    "with_base": "'fixed'", "configuration": "library, q",
    "velocity": "library, q, v", "acceleration": "library, q, v, vdot",
    "forces": "library, q, v", "bias_of_library": "library, q, v, M, vdot",
    "mass_matrix": "library, q, M", "jacobian_of_library": "library, q, J",
}
# Statements of the other classes. Not timed: functions whose time grows from call
# to call, as Simulation.push() and Scenario.add_push(); those that read or write
# the files of a run; and those whose work is done in python/ itself, so that C++
# has no call to compare with, as Solution.explain() and the setters.
OTHERS = {
    "Solver.solve": "solver.solve(hierarchy)",
    "Controller.update": "state.time += 1e-3; controller.update(state)",
    "Simulation.step": "simulation.step()",
    "Robot.load": "poise.Robot.load()",
    "Robot.doctor": "robot.doctor()",
    "Hierarchy":
        "hierarchy = poise.Hierarchy(1); "
        "hierarchy.add_level(C=one, upper=limit); "
        "hierarchy.add_level(B=one, b=three)",
    "Solution.conflict": "contradiction.conflict(1)",
    "Controller": "poise.Controller(robot)",
    "Controller.start": "controller.start(state)",
    "State": "poise.State(posture, zeros)",
    "Scenario.load": "poise.Scenario.load('stand')",
    "Scenario.from_dict": "poise.Scenario.from_dict({'duration': 3})",
    "Simulation": "poise.Simulation(robot, scenario)",
}


def arguments_of_tree(name):
    """Returns the arguments of a function of Tree."""
    if not name.startswith(("export_", "import_")):
        return TREE_ARGUMENTS[name]
    quantity = name.split("_", 1)[1]
    if name == "import_configuration":
        return "library, q_library"
    return TREE_ARGUMENTS.get(quantity + "_of_library",
                              TREE_ARGUMENTS.get(quantity))


def statements():
    """Returns the statement of each function: {"Tree.rnea": "tree.rnea(q)"}.

    A new function of so3, se3 or Tree without arguments above is an error.
    """
    made = {}
    for name in vars(poise.so3):
        if callable(getattr(poise.so3, name)):
            made[f"so3.{name}"] = f"so3.{name}({SO3[name]})"
    for name in vars(poise.se3):
        if callable(getattr(poise.se3, name)):
            made[f"se3.{name}"] = f"se3.{name}({SE3[name]})"
    for name, member in vars(poise.Tree).items():
        if name.startswith("_"):
            continue
        if callable(member) and not isinstance(member, staticmethod):
            made[f"Tree.{name}"] = f"tree.{name}({arguments_of_tree(name)})"
    return {**made, **OTHERS}


def make_timer(statement, variables):
    """Returns a function that returns the time of a statement, us."""
    timer = timeit.Timer(statement, globals=variables)
    count = 1
    while timer.timeit(count) < ROUND and count < 1_000_000:
        count *= 2
    return lambda: timer.timeit(count) / count * 1e6


def count_rounds(us, most):
    """Returns the number of rounds for a call that takes this time: fewer if all
    would take longer than two seconds, as those of Robot.doctor()."""
    return min(most, max(2, int(2e6 / us)))


def print_overheads(time_cpp, rounds):
    """Prints a table with a row for each function. Returns the differences, us.

    Rounds of Python and C++ alternate, and the shortest of each counts: other
    programs make a round longer, never shorter.
    """
    with subprocess.Popen([time_cpp, ROBOT.urdf, PROFILE, STAND], text=True,
                          bufsize=1, stdin=subprocess.PIPE,
                          stdout=subprocess.PIPE) as process:
        cpp, python = set(process.stdout.readline().split()), statements()
        if cpp != set(python):
            sys.exit(f"measure.py: only one language has {cpp ^ set(python)}, "
                     "add them to measure.py and *_cases.cc")
        variables = arguments()
        print(f"\n{TREE.num_joints} joints; times in us\n")
        print("| function | Python | C++ | difference |")
        print("| --- | ---: | ---: | ---: |")
        differences = {}
        for name, statement in python.items():
            timer, pairs = make_timer(statement, variables), []
            for _ in range(count_rounds(timer(), rounds)):
                process.stdin.write(name + "\n")
                cpp_us = float(process.stdout.readline())
                pairs.append((timer(), cpp_us))
            us, cpp_us = map(min, zip(*pairs))
            differences[name] = us - cpp_us
            print(f"| `{name}` | {us:.2f} | {cpp_us:.2f} | "
                  f"{us - cpp_us:.2f} |", flush=True)
        process.stdin.close()
    return differences


def update(controller, ticks):
    """Runs ticks of a robot that stands still."""
    state = poise.State(ROBOT.posture, np.zeros(TREE.nv))
    controller.start(state)
    for tick in range(ticks):
        state.time = 1e-3 * tick
        controller.update(state)


def print_threads(ticks, rounds):
    """Prints the CPU time of two controllers, in turn and in threads. Returns
    the ratio of the second to the first."""
    controllers = [poise.Controller(ROBOT) for _ in range(2)]
    in_turn, in_threads, wall = [], [], []
    for _ in range(rounds):
        begin = time.process_time()
        for controller in controllers:
            update(controller, ticks)
        in_turn.append(time.process_time() - begin)
        threads = [threading.Thread(target=update, args=(controller, ticks))
                   for controller in controllers]
        begin, wall_begin = time.process_time(), time.perf_counter()
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        in_threads.append(time.process_time() - begin)
        wall.append(time.perf_counter() - wall_begin)
    ratio = min(in_threads) / min(in_turn)
    print(f"\ntwo controllers, {ticks} ticks each: {min(in_turn):.3f} s of CPU "
          f"time in turn, {min(in_threads):.3f} s in two threads "
          f"({ratio:.2f} times), in {min(wall):.3f} s "
          "of wall time")
    return ratio


def print_import(rounds):
    """Prints the time of `import poise` in a new Python. Returns the median."""
    code = ("import time; begin = time.perf_counter(); import poise; {} "
            "print(time.perf_counter() - begin)")
    medians = []
    for title, use in (("import poise", ""),
                       ("with NumPy, by its first array",
                        "poise.so3.exp([0, 0, 1]);")):
        times = sorted(
            float(subprocess.run([sys.executable, "-c", code.format(use)],
                                 check=True, stdout=subprocess.PIPE).stdout)
            for _ in range(rounds))
        medians.append(times[rounds // 2])
        print(f"{title}: {times[0]:.3f} s, median {medians[-1]:.3f} s")
    return max(medians)


def main():
    quick = sys.argv[2:] == ["--quick"]
    if len(sys.argv) < 2 or (sys.argv[2:] and not quick):
        print("usage: measure.py TIME_CPP [--quick]", file=sys.stderr)
        sys.exit(2)
    differences = print_overheads(sys.argv[1], 1 if quick else 30)
    ratio = print_threads(20 if quick else 2000, 1 if quick else 5)
    seconds = print_import(1 if quick else 9)
    exceeded = [
        f"{what} is {value:.2f}, must be at most {most}"
        for what, value, most in (
            ("Tree.tick: the difference in us", differences["Tree.tick"],
             MOST_TICK_US),
            ("the CPU time of two threads as a ratio", ratio, MOST_THREADS),
            ("the time of import poise in s", seconds, MOST_IMPORT))
        if value > most]
    if exceeded and not quick:
        sys.exit("measure.py: " + "; ".join(exceeded))


if __name__ == "__main__":
    main()

"""The layers of this workspace: who may depend on whom, said once.

LAYERS is the whole architecture.  layer_package_groups() turns it into Bazel
visibility, which stops a forbidden direct dependency while loading; and
layer_test(), called by lint_test() at the end of each layer's BUILD, tests what
visibility cannot see: the transitive closure, and #includes of system headers,
which compile without any dependency.
"""

# For each layer, the lower layers that it may use.
LAYERS = {
    "math": [],
    "dynamics": ["math"],
    "hqp": ["math"],
    "robot": ["dynamics", "math"],
    "robot/control": ["dynamics", "hqp", "math", "robot"],
    "robot/gait": ["dynamics", "hqp", "math", "robot", "robot/control"],
    "sim": ["dynamics", "hqp", "math", "robot", "robot/control", "robot/gait"],
    "python": ["dynamics", "hqp", "math", "robot", "robot/control", "robot/gait", "sim"],
}

# For each layer, folders outside the layers that it may use as well.
_FOLDERS = {
    "python": ["tools/commands", "tools/viewer"],
}

# For each layer, its packages; //tools/rules/install links them.
PACKAGES = {
    "math": ["math"],
    "dynamics": ["dynamics", "dynamics/simd"],
    "hqp": ["hqp", "hqp/fast", "hqp/reference"],
    "robot": [
        "robot",
        "robot/collision",
        "robot/feet",
        "robot/mesh",
        "robot/profile",
        "robot/urdf",
    ],
    "robot/control": [
        "robot/control",
        "robot/control/easing",
        "robot/control/posture",
        "robot/control/tasks",
    ],
    "robot/gait": ["robot/gait"],
    "sim": [
        "sim",
        "sim/command",
        "sim/log",
        "sim/plants",
        "sim/plants/bullet",
        "sim/plants/mujoco",
    ],
}

# Packages that only their own layer and tests see.
PRIVATE_PACKAGES = ["dynamics/simd", "hqp/fast"]

# For each layer, the external repositories that its libraries may use.
EXTERNALS = {
    "math": ["eigen"],
    "dynamics": ["eigen"],
    "hqp": ["eigen"],
    "robot": ["eigen", "tinyxml2", "urdfdom", "yaml_cpp"],
    "robot/control": ["eigen", "yaml_cpp"],
    "robot/gait": ["eigen"],
    "sim": ["bullet", "eigen", "mujoco", "nlohmann_json", "openssl", "yaml_cpp"],
    "python": ["cli11", "eigen", "nlohmann_json", "pybind11", "yaml_cpp"],
}

# For each external repository, the beginnings of the <paths> of its headers.
_HEADERS = {
    "bullet": ["Bullet", "LinearMath/", "btBullet"],
    "ceres": ["ceres/", "glog/"],
    "cli11": ["CLI/"],
    "eigen": ["Eigen/", "unsupported/"],
    "fcl": ["fcl/"],
    "gmp": ["gmp"],
    "gtest": ["gtest/", "gmock/"],
    "kdl": ["kdl"],
    "mpreal": ["mpreal", "mpfr"],
    "mujoco": ["mujoco/"],
    "nlohmann_json": ["nlohmann/"],
    "openssl": ["openssl/"],
    "pybind11": ["pybind11/", "Python.h", "numpy/"],
    "rapidcheck": ["rapidcheck"],
    "tinyxml2": ["tinyxml"],
    "urdfdom": ["urdf"],
    "yaml_cpp": ["yaml-cpp/"],
}

def layer_of(package):
    """The layer of a package: its longest prefix in LAYERS, or None."""
    layer = None
    for candidate in LAYERS:
        if package == candidate or package.startswith(candidate + "/"):
            if layer == None or len(candidate) > len(layer):
                layer = candidate
    return layer

def layer_package_groups():
    """Declares //tools/rules/layers:<layer>_users, with _ for /, for every layer."""
    for layer in LAYERS:
        native.package_group(
            name = layer.replace("/", "_") + "_users",
            packages = ["//docs", "//tests/...", "//tools/..."] + [
                # The folder robot/control is inside robot, but its layer is above;
                # visibility allows that dependency, layer_test() refuses it.
                "//{}/...".format(user)
                for user, below in LAYERS.items()
                if user == layer or layer in below
            ],
        )

def layer_test():
    """Tests every cc_library above this line against LAYERS."""
    package = native.package_name()
    layer = layer_of(package)
    rules = [
        rule
        for rule in native.existing_rules().values()
        if rule["kind"] == "cc_library" and not rule.get("testonly", False)
    ]
    if not rules:
        return
    labels = ["//{}:{}".format(package, rule["name"]) for rule in rules]
    sources = []
    for rule in rules:
        sources += list(rule.get("srcs") or []) + list(rule.get("hdrs") or [])
    sources = [source for source in sources if "." in source]
    layers = [layer] + LAYERS[layer]
    folders = layers + _FOLDERS.get(layer, [])
    externals = {name: True for each in layers for name in EXTERNALS[each]}
    native.genquery(
        name = "layer_closure",
        expression = "kind(cc_library, deps({}))".format(" + ".join(labels)),
        opts = ["--noimplicit_deps"],
        scope = labels,
    )

    # A package of a lower layer, but neither a package of a layer inside it
    # (robot/control in robot) nor its library for other workspaces (//math:math).
    inner = [
        candidate
        for candidate in LAYERS
        if candidate not in layers and
           any([candidate.startswith(each + "/") for each in layers])
    ]
    faces = [
        "//{}:{}".format(each, each)
        for each in layers
        # //robot:robot is robot.h, not a library for other workspaces.
        if each not in (package, "robot") and "/" not in each
    ]
    native.sh_test(
        name = "layer_test",
        size = "small",
        srcs = ["//tools/rules/layers:layer_test.sh"],
        args = [
            "$(rootpath :layer_closure)",
            "'^(//({})(/[^:]*)?:|@({})//)'".format(
                "|".join(folders),
                "|".join(externals.keys()),
            ),
            "'^({})$$'".format("|".join(
                ["//{}(/[^:]*)?:.*".format(each) for each in inner] + faces +
                ["nothing"],
            )),
            "'<({})'".format("|".join([
                prefix
                for name, prefixes in _HEADERS.items()
                if name not in EXTERNALS[layer]
                for prefix in prefixes
            ])),
        ] + ["$(rootpath {})".format(source) for source in sources],
        data = [":layer_closure"] + sources,
        tags = ["lint"],
    )

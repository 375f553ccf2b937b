"""Libraries of a layer for an installation: one shared, one static.

installed_part() collects the headers and objects of one package; lint_test()
declares one in each BUILD file of a layer. installed_layers() links the parts of
each layer and describes the result in NAME.layer.json, which //tools:install
reads.
"""

# Both sides of an installed header must agree on how Eigen aligns its memory.
# Eigen's choice depends on -march, so it is fixed here: math/eigen_alignment.h
# says how.
EIGEN_DEFINES = {
    "EIGEN_MAX_ALIGN_BYTES": "64",
    "EIGEN_MAX_STATIC_ALIGN_BYTES": "16",
}

_InstalledPart = provider(fields = ["headers", "objects", "is_private", "link_flags"])
_InstalledLayer = provider(fields = ["name", "shared", "files"])

def _installed_part_impl(ctx):
    headers = []
    objects = []
    link_flags = []
    for library in ctx.attr.libraries:
        info = library[CcInfo]
        for header in info.compilation_context.direct_public_headers:
            # Only the name below include_prefix; the other one is its source.
            if "/_virtual_includes/" in header.path:
                headers.append(header)
        for each in info.linking_context.linker_inputs.to_list():
            if each.owner.workspace_name:
                link_flags += [f for f in each.user_link_flags if f not in link_flags]
            elif each.owner == library.label:
                for archive in each.libraries:
                    objects += archive.pic_objects or archive.objects
    return [_InstalledPart(
        headers = [] if ctx.attr.private else headers,
        objects = objects,
        is_private = ctx.attr.private,
        link_flags = link_flags,
    ), DefaultInfo(files = depset(objects + headers))]

installed_part = rule(
    implementation = _installed_part_impl,
    attrs = {
        "libraries": attr.label_list(providers = [CcInfo]),
        # Whether the package's headers and symbols stay inside the layer.
        "private": attr.bool(),
    },
)

_OPTION = "//command_line_option:"

def _optimised_impl(settings, attr):
    return {
        _OPTION + "compilation_mode": "opt",
        _OPTION + "copt": [
            "-O3",
            # Calls inside a library may be inlined, although they can be replaced.
            "-fno-semantic-interposition",
            "--param=ggc-min-heapsize=524288",
        ] + ["-D{}={}".format(*define) for define in EIGEN_DEFINES.items()],
        _OPTION + "force_pic": True,
        _OPTION + "per_file_copt": [],
        _OPTION + "strip": "never",
    }

# Makes the code independent of the command line; its outputs have their own
# folder.
_optimised = transition(
    implementation = _optimised_impl,
    inputs = [],
    outputs = [_OPTION + name for name in (
        "compilation_mode",
        "copt",
        "force_pic",
        "per_file_copt",
        "strip",
    )],
)

def _include_of(header):
    path = header.path
    start = path.index("/_virtual_includes/") + len("/_virtual_includes/")
    return path[path.index("/", start) + 1:]

def _installed_layer_impl(ctx):
    name = ctx.attr.layer
    parts = [part[_InstalledPart] for part in ctx.attr.parts]
    public = [o for part in parts for o in part.objects if not part.is_private]
    private = [o for part in parts for o in part.objects if part.is_private]
    below = [layer[_InstalledLayer] for layer in ctx.attr.below]
    headers = {_include_of(h): h for part in parts for h in part.headers}
    link_flags = []
    for part in parts:
        link_flags += [f for f in part.link_flags if f not in link_flags]
    shared = ctx.actions.declare_file("libpoise_{}.so".format(name))
    static = ctx.actions.declare_file("libpoise_{}.a".format(name))
    toolchain = ctx.attr._toolchain[cc_common.CcToolchainInfo]

    arguments = ctx.actions.args()
    arguments.use_param_file("@%s", use_always = True)
    arguments.set_param_file_format("multiline")
    arguments.add("--name", name)
    arguments.add("--version-file", ctx.file._version)
    arguments.add("--compiler", toolchain.compiler_executable)
    arguments.add("--archiver", toolchain.ar_executable)
    arguments.add("--nm", toolchain.nm_executable)
    arguments.add("--shared", shared)
    arguments.add("--static", static)
    arguments.add_all(public, before_each = "--public")
    arguments.add_all(private, before_each = "--private")
    arguments.add_all(headers.values(), before_each = "--header")
    arguments.add_all([each.shared for each in below], before_each = "--below")
    arguments.add_all(link_flags, format_each = "--link-flag=%s")
    ctx.actions.run(
        executable = ctx.file._link,
        arguments = [arguments],
        inputs = depset(
            public + private + headers.values() + [ctx.file._version] +
            [each.shared for each in below],
            transitive = [toolchain.all_files],
        ),
        outputs = [shared, static],
        mnemonic = "LinkLayer",
        progress_message = "Linking libpoise_{}".format(name),
        use_default_shell_env = True,
    )

    description = ctx.actions.declare_file("{}.layer.json".format(name))
    ctx.actions.write(description, json.encode({
        "name": name,
        "needs": [each.name for each in below],
        "externals": ctx.attr.externals,
        "defines": EIGEN_DEFINES,
        "shared": shared.path,
        "static": static.path,
        "headers": {include: header.path for include, header in headers.items()},
    }))
    files = depset(
        [description, shared, static, ctx.file._version] + headers.values(),
        transitive = [each.files for each in below],
    )
    return [
        _InstalledLayer(name = name, shared = shared, files = files),
        DefaultInfo(files = files),
    ]

_installed_layer = rule(
    implementation = _installed_layer_impl,
    attrs = {
        "layer": attr.string(mandatory = True),
        "parts": attr.label_list(providers = [_InstalledPart], cfg = _optimised),
        "below": attr.label_list(providers = [_InstalledLayer]),
        "externals": attr.string_list(),
        "_link": attr.label(
            default = "//tools/rules/install:link_layer.py",
            allow_single_file = True,
        ),
        "_version": attr.label(default = "//:VERSION", allow_single_file = True),
        "_toolchain": attr.label(default = "@bazel_tools//tools/cpp:current_cc_toolchain"),
        "_allowlist_function_transition": attr.label(
            default = "@bazel_tools//tools/allowlists/function_transition_allowlist",
        ),
    },
)

def installed_layers(layers, packages, externals):
    """Declares :NAME for each layer; robot/control is :control.

    Args:
      layers: for each layer, the lower layers that it uses.
      packages: for each layer, its packages.
      externals: for each layer, the external repositories that it uses.
    """
    for layer, below in layers.items():
        _installed_layer(
            name = layer.split("/")[-1],
            layer = layer.split("/")[-1],
            below = [each.split("/")[-1] for each in below],
            externals = externals[layer],
            parts = ["//{}:installed_part".format(each) for each in packages[layer]],
            tags = ["manual"],
            visibility = ["//tools:__subpackages__"],
        )

"""Precompiled headers: GCC parses slow headers once for all files.

They contain Eigen, slow headers of the standard library, and GoogleTest or pybind11.

A fifth of a cold build was GCC reading Eigen and GoogleTest, file after file.
//tools/rules:cc.bzl has them included by -include PACKAGE/NAME.h, an empty file, for
which GCC takes the precompiled one beside it. Only where .bazelrc wants that by
--define=precompiled=1. The sanitizers do not: there a file gets what it includes
and nothing else, which shows where an #include is missing. For the Python module, the
wheel with --config=opt shows it.
"""

load("@bazel_tools//tools/cpp:toolchain_utils.bzl", "find_cpp_toolchain")

def _impl(ctx):
    header = ctx.actions.declare_file(ctx.label.name + ".h")
    ctx.actions.write(header, "")
    context = cc_common.merge_cc_infos(
        cc_infos = [dep[CcInfo] for dep in ctx.attr.deps],
    ).compilation_context

    # The headers of `deps` without their search paths; users depend on `deps`
    # themselves.
    return [CcInfo(compilation_context = cc_common.create_compilation_context(
        headers = depset(
            [header, _precompile(ctx, context, header)],
            transitive = [context.headers],
        ),
    ))]

def _precompile(ctx, context, header):
    """Declares HEADER.gch, with the flags of the files that will load it."""
    toolchain = find_cpp_toolchain(ctx)
    source = ctx.actions.declare_file(ctx.label.name + ".in.h")
    ctx.actions.write(source, "".join([
        "#include <{}>\n".format(included)
        for included in ctx.attr.includes
    ]))
    output = ctx.actions.declare_file(header.basename + ".gch")
    features = cc_common.configure_features(
        ctx = ctx,
        cc_toolchain = toolchain,
        requested_features = ctx.features,
        unsupported_features = ctx.disabled_features,
    )
    action = "c++-compile"
    variables = cc_common.create_compile_variables(
        feature_configuration = features,
        cc_toolchain = toolchain,
        source_file = source.path,
        output_file = output.path,
        use_pic = True,
        user_compile_flags = ctx.fragments.cpp.copts + ctx.fragments.cpp.cxxopts +
                             ctx.attr.copts + ["-xc++-header"],
        include_directories = context.includes,
        quote_include_directories = context.quote_includes,
        system_include_directories = context.system_includes,
        preprocessor_defines = context.defines,
    )
    ctx.actions.run(
        mnemonic = "CppPrecompile",
        progress_message = "Precompiling {}".format(header.short_path),
        executable = cc_common.get_tool_for_action(
            feature_configuration = features,
            action_name = action,
        ),
        arguments = cc_common.get_memory_inefficient_command_line(
            feature_configuration = features,
            action_name = action,
            variables = variables,
        ),
        env = cc_common.get_environment_variables(
            feature_configuration = features,
            action_name = action,
            variables = variables,
        ),
        inputs = depset(
            [source],
            transitive = [context.headers, toolchain.all_files],
        ),
        outputs = [output],
    )
    return output

precompiled_header = rule(
    implementation = _impl,
    attrs = {
        # Path as in #include <...>.
        "includes": attr.string_list(mandatory = True),
        # The per_file_copt flags of .bazelrc, which rules cannot read.
        "copts": attr.string_list(),
        "deps": attr.label_list(providers = [CcInfo]),
        "_cc_toolchain": attr.label(
            default = "@bazel_tools//tools/cpp:current_cc_toolchain",
        ),
    },
    fragments = ["cpp"],
    toolchains = ["@bazel_tools//tools/cpp:toolchain_type"],
)

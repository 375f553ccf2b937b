"""poise_fuzz_test(): a libFuzzer target, and a test of its seeds."""

load("//tools/rules:cc.bzl", "poise_cc_test")

def poise_fuzz_test(name, seeds, deps):
    """Tests <name>.cc, which defines LLVMFuzzerTestOneInput(), on its seeds.

    By default the test replays the seeds, both intact and corrupted. With
    --config=fuzz the same target is a fuzzer, which tools/quality/fuzz.sh runs.
    """
    poise_cc_test(
        name = name,
        args = ["$(rootpaths {})".format(seed) for seed in seeds],
        data = seeds,
        tags = ["fuzzer"],
        deps = deps + [":fuzzing"] + select({
            ":fuzz": [],
            "//conditions:default": [":replay_main"],
        }),
        with_main = False,
    )

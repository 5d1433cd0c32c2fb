#!/usr/bin/env python3
"""Every fuzz target for many executions, over as many nights as that takes; `tests/run --nightly` builds them and calls this.

    tests/fuzz/nightly.py build/asan/bin --executions 10000000 --hours 8

Corpora and counts are kept in --corpus: a run continues where the last one ended, and begins anew when all targets have their
executions. A finding does not end the run. Status 1 if there is one.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import time

SEEDS = pathlib.Path(__file__).resolve().parent / "seeds"
LIMITS = ["-rss_limit_mb=3000", "-timeout=25"]
MOST_FINDINGS = 3  # of one target in a night; then it waits to be mended


class Target:
    def __init__(self, program, corpus):
        self.program, self.name = program, program.name.removeprefix("fuzz_")
        self.corpus, self.findings = corpus / self.name, corpus / "findings" / self.name
        self.state_file = corpus / f"{self.name}.json"
        self.corpus.mkdir(parents=True, exist_ok=True)
        self.findings.mkdir(parents=True, exist_ok=True)
        self.state = json.loads(self.state_file.read_text()) if self.state_file.exists() else {"executions": 0}
        self.executed, self.seconds, self.edges, self.peak, self.found = 0, 0.0, 0, 0, []

    def keep(self):
        waiting = self.state_file.with_suffix(".new")
        waiting.write_text(json.dumps(self.state))
        waiting.rename(self.state_file)

    def run(self, wanted, until):
        """Executes what is missing to `wanted`, until the time `until`."""
        while self.state["executions"] < wanted and len(self.found) < MOST_FINDINGS:
            left = int(until - time.monotonic())
            if left < 1:
                break
            # A slice: its count is kept though the night be cut short.
            runs = min(wanted - self.state["executions"], 1_000_000)
            self.slice(runs, left)
            self.keep()

    def slice(self, runs, seconds):
        before = set(self.findings.iterdir())
        begin = time.monotonic()
        done = subprocess.run([self.program, f"-runs={runs}", f"-max_total_time={seconds}", *LIMITS, "-print_final_stats=1",
                               f"-artifact_prefix={self.findings}/", self.corpus, SEEDS / self.name],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        text = done.stdout.decode(errors="replace")
        self.seconds += time.monotonic() - begin
        executed = [int(n) for n in re.findall(r"^(?:#|stat::number_of_executed_units:\s*)(\d+)", text, re.MULTILINE)]
        self.executed += max(executed, default=0)
        self.state["executions"] += max(executed, default=0)
        self.edges = max([self.edges, *map(int, re.findall(r" cov: (\d+)", text))])
        self.peak = max([self.peak, *map(int, re.findall(r"stat::peak_rss_mb:\s*(\d+)", text)), *map(int, re.findall(r" rss: (\d+)Mb", text))])
        if done.returncode:
            new = sorted(set(self.findings.iterdir()) - before)
            log = self.findings / f"{new[0].name if new else 'no-input'}.log"
            log.write_text(text[-20000:])
            self.found.append(new[0] if new else log)

    def minimize(self):
        """The smallest part of the corpus that covers as much, so that the next night begins fast."""
        smaller = self.corpus.with_suffix(".merged")
        subprocess.run(["rm", "-rf", smaller], check=True)
        smaller.mkdir()
        merged = subprocess.run([self.program, "-merge=1", *LIMITS, smaller, self.corpus, SEEDS / self.name],
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=False)
        if merged.returncode == 0 and any(smaller.iterdir()):
            subprocess.run(["rm", "-rf", self.corpus], check=True)
            smaller.rename(self.corpus)
        else:
            subprocess.run(["rm", "-rf", smaller], check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("programs", help="folder of the programs fuzz_*")
    parser.add_argument("--executions", type=int, default=10_000_000, help="of each target")
    parser.add_argument("--hours", type=float, default=8, help="for all targets together, then what is left waits for the next run")
    parser.add_argument("--corpus", default="build/asan/fuzz/corpus", help="folder of corpora, counts and findings")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="targets at the same time")
    parser.add_argument("--only", help="the names of some targets, with commas")
    parser.add_argument("--no-merge", action="store_true", help="leave the corpora as they grew")
    options = parser.parse_args()
    corpus = pathlib.Path(options.corpus).resolve()
    programs = sorted(path for path in pathlib.Path(options.programs).resolve().glob("fuzz_*") if path.suffix == "")
    targets = [Target(program, corpus) for program in programs]
    if options.only:
        targets = [target for target in targets if target.name in options.only.split(",")]
    if not targets:
        print(f"there is no fuzz target in {options.programs}", file=sys.stderr)
        return 2
    for target in targets:
        if not any((SEEDS / target.name).glob("*")):
            print(f"fuzz target {target.name} has no seeds in tests/fuzz/seeds", file=sys.stderr)
            return 2
    if all(target.state["executions"] >= options.executions for target in targets):
        for target in targets:
            target.state["executions"] = 0
    # Each gets an even share of the cores' time that is left when its turn comes; the farthest behind begin.
    end = time.monotonic() + 3600 * options.hours
    waiting = sorted(targets, key=lambda target: target.state["executions"])

    def work(place):
        target = waiting[place]
        rounds = -(-(len(waiting) - place) // options.jobs)
        target.run(options.executions, time.monotonic() + max(0.0, end - time.monotonic()) / rounds)
        if not options.no_merge and target.executed:
            target.minimize()
        print(row(target), flush=True)

    print("| target | executions | of all nights | per second | edges | corpus | peak MB | findings |\n|---|---|---|---|---|---|---|---|", flush=True)
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(work, range(len(waiting))))
    found = [path for target in targets for path in target.found]
    behind = [target for target in targets if target.state["executions"] < options.executions]
    print(f"\n{sum(target.executed for target in targets)} executions; {len(targets) - len(behind)} of {len(targets)} targets have "
          f"their {options.executions}; findings: {len(found)}")
    for path in found:
        print(f"   {path}")
    return 1 if found else 0


def row(target):
    rate = target.executed / target.seconds if target.seconds else 0
    return (f"| {target.name} | {target.executed} | {target.state['executions']} | {rate:.0f} | {target.edges} | "
            f"{sum(1 for _ in target.corpus.iterdir())} | {target.peak} | {len(target.found)} |")


if __name__ == "__main__":
    sys.exit(main())

#!/usr/bin/env python3
"""A server under churn for long: connections, uploads, jobs, recordings come and go. Are its memory, descriptors and lateness flat?

    tests/bench/churn/churn.py build/bin/semblante --minutes 60

Starts the server on a data folder of its own. Actors, a thread each, repeat what clients do and check each answer; a sampler
notes what /proc and /metrics say. Status 1 if a figure grew, an answer was wrong or something was left behind, 2 if it cannot run.
"""

import argparse
import http.client
import json
import pathlib
import random
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "oracle"))
from stream_client import Closed, StreamClient  # noqa: E402

# What may grow from the first to the last third of the run, after the first tenth (caches, pools of the allocator).
MEMORY_SHARE, MEMORY_MIB = 1.10, 8
DESCRIPTORS = 4  # at rest, after the last client
LATENESS_MS = 100  # p99, one batch of the subscribers' stream


def grid(cells, seed):
    """An OBJ of a square of triangles; each seed is another file."""
    rows = [f"# {seed}"]
    rows += [f"v {x} {y} {(x * y + seed) % 7}" for y in range(cells + 1) for x in range(cells + 1)]
    for y in range(cells):
        for x in range(cells):
            a = y * (cells + 1) + x + 1
            rows += [f"f {a} {a + 1} {a + cells + 2}", f"f {a} {a + cells + 2} {a + cells + 1}"]
    return "\n".join(rows).encode()


class Wrong(Exception):
    pass


class Rest:
    """A kept connection for requests."""

    def __init__(self, port):
        self.port, self.connection = port, None

    def ask(self, method, path, body=None, kind="application/json", status=None):
        if isinstance(body, (dict, list)):
            body = json.dumps(body).encode()
        for attempt in range(2):
            self.connection = self.connection or http.client.HTTPConnection("127.0.0.1", self.port, timeout=120)
            try:
                self.connection.request(method, path, body, {"Content-Type": kind} if body is not None else {})
                answer = self.connection.getresponse()
                content = answer.read()
                break
            except (http.client.HTTPException, OSError):
                # A kept connection may have been closed as idle.
                self.close()
                if attempt:
                    raise
        if status is not None and answer.status != status:
            raise Wrong(f"{method} {path}: {answer.status}, not {status}: {content[:300]!r}")
        return answer.status, content

    def json(self, *arguments, **more):
        return json.loads(self.ask(*arguments, **more)[1])

    def close(self):
        if self.connection:
            self.connection.close()
        self.connection = None


class Soak:
    def __init__(self, port, rate):
        self.port, self.rate = port, rate
        self.stopping = threading.Event()
        self.lock = threading.Lock()
        self.counts, self.faults, self.threads = {}, [], []

    def count(self, what, number=1):
        with self.lock:
            self.counts[what] = self.counts.get(what, 0) + number

    def act(self, deed, name, pause):
        def run():
            rest, chance = Rest(self.port), random.Random(name)
            while not self.stopping.is_set():
                try:
                    deed(rest, chance)
                    self.count(name)
                except (Wrong, Closed, OSError, http.client.HTTPException, AssertionError, ValueError, KeyError) as fault:
                    with self.lock:
                        self.faults.append(f"{name}: {type(fault).__name__}: {fault}")
                    rest.close()
                self.stopping.wait(pause * chance.uniform(0.5, 1.5) / self.rate)
            rest.close()

        self.threads.append(threading.Thread(target=run, name=name))
        self.threads[-1].start()

    # ---- what clients do

    def job_end(self, rest, job, wanted):
        while True:
            state = rest.json("GET", f"/v1/jobs/{job}", status=200)
            if state["state"] in ("done", "failed", "cancelled"):
                if state["state"] not in wanted:
                    raise Wrong(f"job {job} ended as {state['state']}: {state['problem']}")
                return state
            time.sleep(0.1)

    def upload(self, rest, chance):
        """A model is uploaded, imported, looked at, downloaded and deleted."""
        made = rest.json("POST", "/v1/models?filename=grid.obj", grid(chance.randrange(10, 60), chance.randrange(10**6)),
                         kind="model/obj", status=202)
        model = made["model"]["id"]
        self.job_end(rest, made["job"]["id"], ("done",))
        for path in ("", "/report.json", "/preview.glb", "/source"):
            status, _ = rest.ask("GET", f"/v1/models/{model}{path}")
            if status not in (200, 404):
                raise Wrong(f"GET {path}: {status}")
        rest.ask("DELETE", f"/v1/models/{model}", status=204)

    def damaged(self, rest, chance):
        """A damaged file: its job fails with words, and the model goes."""
        content = bytearray(grid(20, 1))
        content[chance.randrange(10, 4000):] = b"f 1 2 99999\nf nan\n"
        made = rest.json("POST", "/v1/models?filename=bad.obj", bytes(content), kind="model/obj", status=202)
        self.job_end(rest, made["job"]["id"], ("failed", "done"))
        rest.ask("DELETE", f"/v1/models/{made['model']['id']}", status=204)

    def cancel(self, rest, chance):
        """A job is cancelled while it runs, or its model is deleted under it."""
        made = rest.json("POST", "/v1/models?filename=big.obj", grid(200, chance.randrange(10**6)), kind="model/obj", status=202)
        time.sleep(chance.uniform(0, 0.3))
        if chance.random() < 0.5:
            rest.ask("DELETE", f"/v1/jobs/{made['job']['id']}")
            self.job_end(rest, made["job"]["id"], ("done", "cancelled"))
        rest.ask("DELETE", f"/v1/models/{made['model']['id']}", status=204)

    def record(self, rest, chance):
        """The demo is recorded for a while, exported in a format, and the recording deleted."""
        recording = rest.json("POST", "/v1/streams/demo/recordings", {}, status=201)["id"]
        self.stopping.wait(chance.uniform(0.5, 3))
        rest.ask("POST", f"/v1/recordings/{recording}/stop", {}, status=200)
        kind = chance.choice(["performance", "fap", "arkit-csv", "frames-json", "recording"])
        status, content = rest.ask("GET", f"/v1/recordings/{recording}/content?format={kind}")
        if status not in (200, 429) or (status == 200 and not content):
            raise Wrong(f"export as {kind}: {status}")
        rest.ask("DELETE", f"/v1/recordings/{recording}", status=204)

    def stream(self, rest, chance):
        """A stream is made, fed by requests, and deleted."""
        made = rest.json("POST", "/v1/streams", {"title": "churn"}, status=201)["id"]
        for step in range(5):
            rest.ask("POST", f"/v1/streams/{made}/frames", {"frames": [{"time": 40 * step, "faps": {"3": 8 * step}}]}, status=202)
        rest.ask("DELETE", f"/v1/streams/{made}", status=204)

    def subscribe(self, _, chance):
        """A subscriber comes, hears some messages, and leaves or vanishes."""
        client = StreamClient(self.port, "demo", as_json=chance.random() < 0.3, timeout=120)
        try:
            client.say("hello", role="subscribe", version=1)
            for _ in range(chance.randrange(1, 40)):
                if client.hear()["type"] == "error":
                    raise Wrong("an error to a subscriber")
                self.count("messages heard")
        finally:
            client.close()

    def knock(self, rest, chance):
        """Connections that ask little, ask nothing, or ask nonsense."""
        import socket
        with socket.create_connection(("127.0.0.1", self.port), 60) as connection:
            connection.sendall(chance.choice([b"", b"GET / HT", b"NONSENSE\r\n\r\n", b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n"]))
            if chance.random() < 0.5:
                connection.settimeout(0.2)
                try:
                    connection.recv(1000)
                except socket.timeout:
                    pass
        rest.ask("GET", "/healthz", status=200)

    def begin(self):
        for name, pause in (("upload", 0.5), ("damaged", 2), ("cancel", 3), ("record", 0.5), ("stream", 0.3)):
            self.act(getattr(self, name), name, pause)
        for number in range(4):
            self.act(self.subscribe, f"subscribe {number}", 0.1)
            self.act(self.knock, f"knock {number}", 0.1)

    def end(self):
        self.stopping.set()
        for thread in self.threads:
            thread.join()


def samples_of(text, name):
    """{labels: value} of a metric of /metrics."""
    found = {}
    for line in text.splitlines():
        if line.startswith(name) and line[len(name)] in " {":
            labels, value = line[len(name):].rsplit(" ", 1)
            found[labels] = float(value)
    return found


def lateness_p99(before, now):
    """ms: the bound of the histogram's bucket that 99 of 100 deliveries between two scrapes are in."""
    name = "semblante_stream_lateness_seconds_bucket"
    old, new = samples_of(before, name), samples_of(now, name)
    counts = sorted((float(labels.split('"')[1].replace("+Inf", "inf")), new[labels] - old.get(labels, 0)) for labels in new)
    total = counts[-1][1]
    if not total:
        return None
    return next(1000 * bound for bound, count in counts if count >= 0.99 * total)


def state_of(pid, data):
    status = dict(line.split(":", 1) for line in pathlib.Path(f"/proc/{pid}/status").read_text().splitlines())
    temporary = data / "tmp"
    return {"memory": int(status["VmRSS"].split()[0]) / 1024, "threads": int(status["Threads"]),
            "descriptors": len(list(pathlib.Path(f"/proc/{pid}/fd").iterdir())),
            "temporary": len(list(temporary.iterdir())) if temporary.exists() else 0}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("semblante")
    parser.add_argument("--minutes", type=float, default=60)
    parser.add_argument("--rate", type=float, default=1, help="how fast clients come, as a multiple")
    parser.add_argument("--every", type=float, default=5, help="seconds between samples")
    parser.add_argument("--json", help="file for all samples")
    parser.add_argument("--smoke", action="store_true", help="a short run that does not judge memory and lateness")
    options = parser.parse_args()
    if options.smoke:
        options.minutes, options.every = 0.15, 1
    with tempfile.TemporaryDirectory() as folder:
        return run(options, pathlib.Path(folder) / "data")


def run(options, data):
    log = open(data.parent / "log", "w+b")
    server = subprocess.Popen([options.semblante, "serve", "--port", "0", "--data", str(data), "--demo", "--trash-grace", "0"],
                              stdout=subprocess.PIPE, stderr=log)
    line = server.stdout.readline().decode()
    if "listening on" not in line:
        print("the server does not start:", pathlib.Path(log.name).read_text()[-1000:], file=sys.stderr)
        return 2
    port = int(line.rsplit(":", 1)[1])
    rest = Rest(port)
    rest.ask("GET", "/healthz", status=200)
    at_rest = state_of(server.pid, data)
    soak = Soak(port, options.rate)
    soak.begin()
    begin, samples = time.monotonic(), []
    metrics = rest.ask("GET", "/metrics")[1].decode()
    print(f"{'min':>6} {'MiB':>7} {'files':>6} {'threads':>8} {'late p99 ms':>12}")
    while time.monotonic() - begin < 60 * options.minutes and server.poll() is None:
        time.sleep(options.every)
        now = rest.ask("GET", "/metrics")[1].decode()
        sample = {"minute": (time.monotonic() - begin) / 60, **state_of(server.pid, data), "late": lateness_p99(metrics, now)}
        metrics = now
        samples.append(sample)
        if len(samples) % max(1, round(60 / options.every)) == 0:
            late = "-" if sample["late"] is None else f"{sample['late']:.0f}"
            print(f"{sample['minute']:6.1f} {sample['memory']:7.1f} {sample['descriptors']:6} {sample['threads']:8} {late:>12}", flush=True)
    soak.end()
    faults = list(soak.faults)
    if server.poll() is not None:
        print(f"the server ended with {server.returncode}", file=sys.stderr)
        return 1

    # Everything that was made is gone again: what is left was forgotten.
    for _ in range(300):
        after = state_of(server.pid, data)
        if after["descriptors"] <= at_rest["descriptors"] + DESCRIPTORS and not after["temporary"]:
            break
        time.sleep(0.1)
    left = {name: len(rest.json("GET", f"/v1/{name}", status=200)[name]) for name in ("models", "recordings")}
    server.send_signal(signal.SIGTERM)
    status = server.wait(60)
    blobs = sum(1 for path in (data / "blobs").rglob("*") if path.is_file())
    if options.json:
        pathlib.Path(options.json).write_text(json.dumps({"samples": samples, "counts": soak.counts, "faults": faults}))

    failed = []

    def judge(what, figure, is_good):
        print(f"{'ok  ' if is_good else 'BAD '} {what}: {figure}")
        if not is_good:
            failed.append(what)

    def third(of, name):
        kept = samples[len(samples) // 10:]
        size = max(1, len(kept) // 3)
        values = [s[name] for s in (kept[:size] if of == "first" else kept[-size:]) if s[name] is not None]
        return statistics.median(values) if values else 0.0

    print("\n" + ", ".join(f"{count} x {name}" for name, count in sorted(soak.counts.items())))
    first, last = third("first", "memory"), third("last", "memory")
    judge("memory, median MiB of the first and the last third", f"{first:.1f}, {last:.1f}", options.smoke or last <= first * MEMORY_SHARE + MEMORY_MIB)
    judge("descriptors, medians", f"{third('first', 'descriptors'):.0f}, {third('last', 'descriptors'):.0f}",
          options.smoke or third("last", "descriptors") <= third("first", "descriptors") * 1.25 + 8)
    judge("descriptors at rest, before and after", f"{at_rest['descriptors']}, {after['descriptors']}",
          after["descriptors"] <= at_rest["descriptors"] + DESCRIPTORS)
    judge("lateness, median of p99s in ms", f"{third('first', 'late'):.0f}, {third('last', 'late'):.0f}",
          options.smoke or third("last", "late") <= max(LATENESS_MS, third("first", "late")))
    judge("temporary files left", after["temporary"], after["temporary"] == 0)
    judge("models, recordings, blobs left", f"{left['models']}, {left['recordings']}, {blobs}", not any(left.values()) and not blobs)
    judge("end of the server", status, status == 0)
    judge("answers that were wrong", len(faults), not faults)
    for fault in faults[:10]:
        print("    ", fault)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

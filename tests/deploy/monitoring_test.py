"""deploy/monitoring: every metric, label and value named there is one that a running server has; the alerts fire.

Needs PyYAML; promtool (Debian's package prometheus) judges the rules where it is installed."""

import json
import re
import shutil
import unittest

import support
from support import TOP, run

try:
    import yaml
except ImportError:
    yaml = None

MONITORING = TOP / "deploy/monitoring"
BOARD = json.loads((MONITORING / "grafana.json").read_text())
# Prometheus adds these to what it reads.
OF_PROMETHEUS = {"up": {"job": None, "instance": None}}
ADDED_LABELS = {"job", "instance"}
WORDS = set("by without on ignoring group_left group_right and or unless offset bool sum min max avg count rate increase changes "
            "histogram_quantile label_values".split())


def samples(text):
    """{name of a sample: {label: values}} of /metrics."""
    found = {}
    for name, labels in re.findall(r"^([a-zA-Z_:][\w:]*)(?:\{(.*)\})? \S+$", text, re.MULTILINE):
        known = found.setdefault(name, {})
        for label, value in re.findall(r'(\w+)="((?:[^"\\]|\\.)*)"', labels):
            known.setdefault(label, set()).add(value)
    return found


def references(expression):
    """(name, {label: value}, labels it is grouped by) of each metric of a PromQL expression."""
    grouped = {label.strip() for group in re.findall(r"\b(?:by|without) \(([^)]*)\)", expression) for label in group.split(",")}
    bare = re.sub(r"\b(?:by|without) \([^)]*\)", "", expression)
    for name, selector in re.findall(r"\b([a-zA-Z_:][\w:]*)\b(?:\{([^}]*)\})?(?!\()", re.sub(r"\[[^]]*\]", "", bare)):
        if name in WORDS or re.search(rf'"{name}', bare) or re.search(rf"\b{name}\s*[=]\s*\"", bare):
            continue
        yield name, dict(re.findall(r'(\w+)="([^"]*)"', selector)), grouped


def alerts():
    return [rule for group in yaml.safe_load((MONITORING / "alerts.yml").read_text())["groups"] for rule in group["rules"]]


def board_expressions():
    for panel in BOARD["panels"]:
        for target in panel.get("targets", []):
            yield target["expr"]
    yield from (annotation["expr"] for annotation in BOARD["annotations"]["list"])
    for variable in BOARD["templating"]["list"]:
        if variable["type"] == "query":
            yield re.fullmatch(r"label_values\((\w+), instance\)", variable["query"]["query"]).group(1)


class Metrics(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with support.temporary_folder() as folder, support.Server(folder / "data", "--demo") as server:
            # Series of requests appear with the first one of their kind.
            support.get(server.url + "/v1/streams")
            support.get(server.url + "/v1/streams/none")
            cls.samples = {**samples(support.get(server.url + "/metrics")[2].decode()), **OF_PROMETHEUS}

    def check(self, expression):
        found = list(references(expression))
        self.assertNotEqual(found, [], expression)
        for name, selectors, grouped in found:
            self.assertIn(name, self.samples, f"no such metric: {expression}")
            known = self.samples[name]
            for label in (set(selectors) | grouped) - ADDED_LABELS:
                self.assertIn(label, known, f"{name} has no label {label}: {expression}")
            for label, value in selectors.items():
                # That a request failed cannot be made to happen; the server's code gives these five classes.
                classes = {"1xx", "2xx", "3xx", "4xx", "5xx"} if label == "status" else set()
                if label not in ADDED_LABELS:
                    self.assertIn(value, known[label] | classes, f"{name} has no {label} {value}: {expression}")

    @unittest.skipIf(yaml is None, "PyYAML is not installed (python3-yaml)")
    def test_alerts(self):
        for rule in alerts():
            with self.subTest(rule["alert"]):
                self.check(rule["expr"])
                self.assertIn(rule["labels"]["severity"], ("critical", "warning"))
                self.assertIn("$labels.instance", rule["annotations"]["summary"])
        self.assertEqual(len({rule["alert"] for rule in alerts()}), len(alerts()))

    def test_board(self):
        for expression in board_expressions():
            with self.subTest(expression):
                self.check(expression)

    def test_faulty_expressions_are_noticed(self):
        for expression in ("rate(semblante_request_total[5m])", 'semblante_jobs{state="resting"}', "sum by (code) (semblante_http_requests_total)",
                           'semblante_models{kind="x"}', "1 > 0"):
            with self.assertRaises(AssertionError, msg=expression):
                self.check(expression)

    def test_board_is_laid_out(self):
        panels = BOARD["panels"]
        self.assertEqual(len({panel["id"] for panel in panels}), len(panels))
        cells = [(x, y) for panel in panels for at in [panel["gridPos"]] for x in range(at["x"], at["x"] + at["w"])
                 for y in range(at["y"], at["y"] + at["h"])]
        self.assertEqual(len(set(cells)), len(cells), "panels overlap")
        self.assertLess(max(x for x, _ in cells), 24)
        variables = {variable["name"] for variable in BOARD["templating"]["list"]}
        used = set(re.findall(r"\$\{?([a-z]\w*)", json.dumps(BOARD)))
        self.assertEqual(used, variables)
        # Every metric of the server is on the board, or it is known why not.
        shown = {name for expression in board_expressions() for name, _, _ in references(expression)}
        families = {re.sub(r"_(bucket|sum|count)$", "", name) for name in self.samples} - set(OF_PROMETHEUS)
        hidden = {"process_virtual_memory_bytes", "semblante_stream_batches_total", "semblante_stream_messages_sent_total",
                  "semblante_stream_encode_seconds_total", "semblante_stream_connections_refused_total", "semblante_trash_files",
                  "semblante_worker_isolation", "semblante_stream_sound_packets_total", "semblante_stream_sound_messages_sent_total",
                  "semblante_stream_texts_sent_total", "semblante_stream_words_reached_total"}
        self.assertEqual(families - {re.sub(r"_bucket$", "", name) for name in shown}, hidden)

    @unittest.skipUnless(shutil.which("promtool"), "not installed: promtool (Debian's package prometheus)")
    @unittest.skipIf(yaml is None, "PyYAML is not installed (python3-yaml)")
    def test_promtool(self):
        result = run("promtool", "check", "config", MONITORING / "prometheus.yml")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        cases = yaml.safe_load((TOP / "tests/deploy/alerts.promtest.yml").read_text())
        quiet = {case["alertname"] for case in cases["tests"][0]["alert_rule_test"]}
        self.assertEqual(quiet, {rule["alert"] for rule in alerts()})
        healthy = cases["tests"][0]["input_series"]
        for alert, (replaced, minute) in self.FIRING.items():
            series = {one["series"]: one["values"] for one in healthy}
            for name, values in replaced.items():
                self.assertIn(name, series)
                series[name] = values
            expected = [rule for rule in alerts() if rule["alert"] == alert]
            cases["tests"].append({"name": alert, "interval": "1m", "input_series": [{"series": s, "values": v} for s, v in series.items()],
                                   "promql_expr_test": [{"expr": f'count(ALERTS{{alertname="{alert}", alertstate="firing", severity="'
                                                         + expected[0]["labels"]["severity"] + '"})', "eval_time": f"{minute}m",
                                                         "exp_samples": [{"labels": "{}", "value": 1}]}]})
        self.assertEqual(set(self.FIRING), quiet)
        with support.temporary_folder() as folder:
            cases["rule_files"] = [str(MONITORING / "alerts.yml")]
            (folder / "test.yml").write_text(yaml.safe_dump(cases))
            result = run("promtool", "test", "rules", folder / "test.yml")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)

    # What of a healthy server changes, and the minute at which the alert must fire.
    FIRING = {
        "SemblanteDown": ({'up{job="semblante", instance="a"}': "1x9 0x50"}, 20),
        "SemblanteRestarts": ({'process_start_time_seconds{job="semblante", instance="a"}': "1 2 3 4 5 5x50"}, 8),
        "SemblanteNotWritable": ({'semblante_store_writable{instance="a"}': "0x60"}, 5),
        "SemblanteDiskFull": ({'semblante_store_disk_full{instance="a"}': "1x60"}, 5),
        "SemblanteWritesPending": ({'semblante_store_pending_writes{instance="a"}': "2x60"}, 20),
        "SemblanteErrors": ({'semblante_http_requests_total{instance="a", status="5xx"}': "0+20x60"}, 30),
        "SemblanteSlowAnswers": ({'semblante_http_request_duration_seconds_bucket{instance="a", method="GET", le="0.01"}': "0+900x60"}, 30),
        "SemblanteLateFrames": ({'semblante_stream_lateness_seconds_bucket{instance="a", le="0.05"}': "0+980x60"}, 30),
        "SemblanteSlowSubscribers": ({'semblante_stream_connections_closed_total{instance="a", reason="slow"}': "0+5x60"}, 30),
        "SemblanteConnectionsRefused": ({'semblante_stream_connections_refused_total{instance="a"}': "0+2x60"}, 30),
        "SemblanteOpenFiles": ({'process_open_fds{job="semblante", instance="a"}': "19000x60"}, 30),
        "SemblanteJobsWait": ({'semblante_jobs{instance="a", state="waiting"}': "40x60"}, 30),
        "SemblanteJobsFail": ({'semblante_jobs_ended_total{instance="a", kind="import", state="failed"}': "0+2x60"}, 30),
        "SemblanteRecordingsFail": ({'semblante_recordings_dropped_frames_total{instance="a"}': "0+5x60"}, 30),
        "SemblanteFilesInTrash": ({'semblante_trash_files{instance="a"}': "3x99"}, 65),
    }


support.main()

"""`semblante serve --config`: precedence, what --print-config tells, and what a faulty file is told."""

import re
import unittest

import support
from support import PROGRAM, clean_environment, run


def printed(text):
    """{key: (value, source)} of --print-config."""
    lines = [re.fullmatch(r"([a-z-]+) = (.*)  # (.*)", line) for line in text.splitlines()]
    assert all(lines), text
    return {line.group(1): (line.group(2), line.group(3)) for line in lines}


class Configuration(unittest.TestCase):
    def setUp(self):
        folder = support.temporary_folder()
        self.folder = folder.__enter__()
        self.addCleanup(folder.__exit__, None, None, None)
        self.file = self.folder / "semblante.toml"

    def print_config(self, text, *options, **environment):
        self.file.write_text(text, encoding="utf-8")
        result = run(PROGRAM, "serve", "--config", self.file, "--print-config", *options, environment=clean_environment(**environment))
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return printed(result.stdout)

    def refused(self, text):
        self.file.write_text(text, encoding="utf-8")
        result = run(PROGRAM, "serve", "--config", self.file, "--print-config")
        self.assertEqual((result.returncode, result.stdout), (2, ""), text)
        self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
        return result.stderr.rstrip("\n").removeprefix(f"semblante: serve: {self.file}:")

    def test_option_then_environment_then_file_then_default(self):
        text = "threads = 3\nworkers = 4\nport = 5\nmax-models = 6\n"
        values = self.print_config(text, "--threads", "7", "--workers", "8", SEMBLANTE_WORKERS=9, SEMBLANTE_PORT=10)
        self.assertEqual(values["threads"], ("7", "option"))
        self.assertEqual(values["workers"], ("8", "option"))
        self.assertEqual(values["port"], ("10", "environment SEMBLANTE_PORT"))
        self.assertEqual(values["max-models"], ("6", f"{self.file}:4"))
        self.assertEqual(values["max-streams"], ("256", "default"))

    def test_limits_of_the_readme_are_options_with_their_defaults(self):
        values = self.print_config("")
        text = (support.TOP / "server/README.md").read_text(encoding="utf-8")
        rows = re.findall(r"^\| (.+?) \| (.+?) \| `--([a-z-]+)` \|", text[text.index("## Limits"):text.index("## What one token may have")], re.MULTILINE)
        units = {"": 1, " KiB": 1 << 10, " MiB": 1 << 20, " GiB": 1 << 30, " s": 1, " days": 86400}
        seen = set()
        for what, value, option in rows:
            with self.subTest(what):
                self.assertIn(option, values)
                seen.add(option)
                plain = re.fullmatch(r"(\d+)( [KMG]iB| s| days|)", value)
                if plain:
                    self.assertEqual(values[option][0], str(int(plain.group(1)) * units[plain.group(2)]))
        limits = {name for name in values if name.startswith(("max-", "token-", "client-"))}
        self.assertEqual(limits - seen, set(), "limits without a row")
        self.assertGreater(len(seen), 20)

    def test_environment_alike_the_option_and_with_a_unit(self):
        values = self.print_config("", "--port", "5", SEMBLANTE_PORT=5, SEMBLANTE_WORKER_MEMORY="2GB", SEMBLANTE_DEMO=1, SEMBLANTE_DATA="")
        self.assertEqual(values["port"], ("5", "option"))
        self.assertEqual(values["worker-memory"], (str(2 << 30), "environment SEMBLANTE_WORKER_MEMORY"))
        self.assertEqual(values["demo"], ("true", "environment SEMBLANTE_DEMO"))
        self.assertEqual(values["data"], ('"data"', "default"), "an empty variable is none")

    def test_a_variable_that_is_refused(self):
        result = run(PROGRAM, "serve", "--print-config", environment=clean_environment(SEMBLANTE_PORT="x"))
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertTrue(result.stderr.startswith("semblante: serve: SEMBLANTE_PORT: "), result.stderr)

    def test_file_named_by_the_environment(self):
        self.file.write_text("port = 5\n", encoding="utf-8")
        result = run(PROGRAM, "serve", "--print-config", environment=clean_environment(SEMBLANTE_CONFIG=self.file))
        self.assertEqual(printed(result.stdout)["port"], ("5", f"{self.file}:1"))

    def test_every_form_of_value(self):
        values = self.print_config(
            "\ufeff# comment\r\n\r\ndemo = true # on\r\n  data='a\\b'  \n"
            'web-root = ""\nmax-models = 1_000\nmax-upload-bytes = "2MB"\ntrash-grace = "36h"\n'
            'allow-host = ["a.example", # one\n  \'b.example\',\n]\nallow-origin = []\nlog-level = "\\"\\\\\\t"')
        self.assertEqual(values["demo"], ("true", f"{self.file}:3"))
        self.assertEqual(values["data"], (r'"a\\b"', f"{self.file}:4"))
        self.assertEqual(values["web-root"], ('""', f"{self.file}:5"))
        self.assertEqual(values["max-models"][0], "1000")
        self.assertEqual(values["max-upload-bytes"][0], str(2 << 20))
        self.assertEqual(values["trash-grace"][0], str(36 * 3600))
        self.assertEqual(values["allow-host"], ('["a.example", "b.example"]', f"{self.file}:9"))
        self.assertEqual(values["log-level"][0], r'"\"\\\t"')

    def test_what_is_printed_is_a_configuration_with_the_same_values(self):
        first = run(PROGRAM, "serve", "--print-config", "--demo", "--allow-host", "a", "--allow-host", "b", "--data", 'x"y\\z').stdout
        second = self.print_config(first)
        self.assertEqual({key: value for key, (value, _) in printed(first).items()}, {key: value for key, (value, _) in second.items()})

    def test_every_option_of_the_help_is_printed(self):
        self.assertNotIn(None, [re.search(r"\(Env:SEMBLANTE_[A-Z_]+\)", line) for line in run(PROGRAM, "serve", "--help").stdout.splitlines()
                                if line.startswith("  --") and not line.startswith("  --print-config")])
        options = set(re.findall(r"^  --([a-z-]+)", run(PROGRAM, "serve", "--help").stdout, re.MULTILINE))
        self.assertEqual(set(self.print_config("")), options - {"config", "print-config"})

    def test_faults_are_told_with_their_line(self):
        for text, expected in {
            "# one\n\nprot = 1": "3: unknown key prot ",
            "config = 'x'": "1: unknown key config ",
            "print-config = true": "1: unknown key print-config ",
            "port = 70000": "1: --port: Value 70000 not in range",
            "port = 'x'": "1: --port: Value x not in range",
            "port = -1": "1: --port: Value -1 not in range",
            "port = [1]": "1: port takes one value",
            "demo = 1": "1: demo is true or false",
            "port = 1\nport = 2": "2: the key port is there a second time; the first is in line 1",
            "[serve]": "1: tables are not supported",
            "allow-host = [\n['x']]": "2: an array within an array",
            "allow-host = ['x' 'y']": '1: "," or "]" is expected',
            "allow-host = ['x'": '1: "," or "]" is expected',
            "data = 'x": "1: the text has no closing quote",
            'data = "x\ny"': "1: the text has no closing quote",
            'data = """x"""': "1: strings over several lines",
            'data = "\\x"': "1: an escape",
            'data = "\x01"': "1: a control character",
            "data = x": "1: a value is expected",
            "port = 1.2.3": "1: a value is expected",
            "port = 1__0": "1: a value is expected",
            "port =": "1: a value is expected",
            "port 80": '1: "=" is expected after the key port',
            "= 80": "1: a key is expected",
            "port = 1 2": "1: the line goes on after the value of port",
        }.items():
            with self.subTest(text):
                self.assertTrue(self.refused(text).startswith(expected), self.refused(text))

    def test_every_prefix_of_a_file_is_read_or_refused(self):
        whole = 'port = 1 # x\ndata = "a\\n"\nallow-host = ["a", \'b\', 1.5]\ndemo = true\n'
        for length in range(len(whole)):
            self.file.write_text(whole[:length], encoding="utf-8")
            self.assertIn(run(PROGRAM, "serve", "--config", self.file, "--print-config").returncode, (0, 2), whole[:length])

    def test_a_file_that_cannot_be_read(self):
        for file in (self.folder / "none", self.folder):
            result = run(PROGRAM, "serve", "--config", file, "--print-config")
            self.assertEqual((result.returncode, result.stdout), (2, ""))
            self.assertIn(str(file), result.stderr)

    def test_a_server_takes_its_settings_from_the_file(self):
        self.file.write_text(f"max-models = 0\n", encoding="utf-8")
        self.assertEqual(run(PROGRAM, "serve", "--config", self.file, "--data", self.folder / "data").returncode, 2)
        self.file.write_text("demo = true\n", encoding="utf-8")
        with support.Server(self.folder / "data", "--config", self.file) as server:
            streams = support.get_json(server.url + "/v1/streams")
        self.assertIn("demo", [stream["id"] for stream in streams["streams"]])


support.main()

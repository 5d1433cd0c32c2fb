"""The package for Python on golden files and beside a real server."""

import array
import copy
import ctypes
import enum
import gc
import inspect
import json
import math
import os
import pathlib
import pickle
import re
import resource
import socket
import subprocess
import sys
import tempfile
import typing
import unittest
import urllib.error
import weakref

TOP = pathlib.Path(__file__).resolve().parents[3]
BUILD = pathlib.Path(os.environ.get("SEMBLANTE_BUILD", TOP / "build"))
sys.path[:0] = [str(TOP / "clients/python"), str(TOP / "tests/deploy")]

import semblante  # noqa: E402
from support import Server, eventually, get, get_json, temporary_folder  # noqa: E402

VECTORS = TOP / "protocol/vectors"


def golden_head(folder="face"):
    return semblante.Head(*((VECTORS / folder / name).read_bytes() for name in ("mesh.drc", "weights", "rig.json")))


def colors_of_places(positions):
    """The colours of face_colored: see protocol/vectors/README.md."""
    axes = [(min(axis), max(axis)) for axis in zip(*positions)]
    return [[round(255 * (x - low) / (high - low)) for x, (low, high) in zip(place, axes)] for place in positions]


def golden_frame(values):
    frame = semblante.frame({int(n): v for n, v in values.get("faps", {}).items()})
    if "viseme" in values:
        frame.viseme1, frame.viseme2, frame.viseme_blend = (values["viseme"][k] for k in ("select1", "select2", "blend"))
    if "expression" in values:
        expression = values["expression"]
        frame.expression1, frame.intensity1 = expression["select1"], expression["intensity1"]
        frame.expression2, frame.intensity2 = expression["select2"], expression["intensity2"]
    return frame


class Types(unittest.TestCase):
    def test_every_public_function_declares_its_types(self):
        functions = []
        for name in semblante.__all__:
            thing = getattr(semblante, name)
            if inspect.isfunction(thing):
                functions.append((name, thing))
            elif inspect.isclass(thing) and not issubclass(thing, (ctypes.Structure, enum.Enum)):
                functions += [(f"{name}.{member}", getattr(value, "fget", None) or getattr(value, "__func__", value))
                              for member, value in vars(thing).items()
                              if member == "__init__" or not member.startswith("_")]
        functions = [(name, function) for name, function in functions if inspect.isfunction(function)]
        self.assertGreater(len(functions), 60)
        for name, function in functions:
            with self.subTest(name):
                declared = typing.get_type_hints(function)
                self.assertIn("return", declared)
                self.assertEqual([one for one in inspect.signature(function).parameters if one not in ("self", "_")],
                                 [one for one in declared if one not in ("return", "_")])


class Listeners(unittest.TestCase):
    def test_hears_a_step_for_each_ten_ms_of_any_blocks(self):
        tone = array.array("f", (0.3 * math.sin(0.3 * i) * (i % 100 < 5) for i in range(16000)))
        whole = semblante.Listener(16000).push(tone)
        with semblante.Listener(16000) as listener:
            parts = [heard for i in range(0, 16000, 77) for heard in listener.push(list(tone[i:i + 77]))]
        self.assertEqual([list(one.weights) for one in whole], [list(one.weights) for one in parts])
        self.assertEqual([one.time for one in whole[:3]], [5.0, 15.0, 25.0])
        self.assertEqual(len(whole), 95)
        self.assertAlmostEqual(sum(whole[50].weights), 1.0, places=5)
        self.assertEqual(semblante.from_oculus(list(whole[50].weights)).viseme_blend <= 63, True)

    def test_a_rate_that_is_none_is_refused(self):
        with self.assertRaises(semblante.SemblanteError) as caught:
            semblante.Listener(4000)
        self.assertEqual(caught.exception.where, "options.sample_rate")


class Speakers(unittest.TestCase):
    SCORE = bytes.fromhex("ab1119b3")  # "Am pe"

    def test_the_mouth_follows_the_voice(self):
        with semblante.Speaker() as speaker:
            self.assertIsNone(speaker.show(0))
            speaker.say(self.SCORE, 1000)
            speaker.reach(0, 1000)
            self.assertEqual(speaker.show(1060).viseme1, 10)
            speaker.reach(1, 1180)
            self.assertEqual(speaker.show(1200).viseme1, 1)
            speaker.end(1400)
            self.assertIsNone(speaker.show(2000))

    def test_bytes_that_are_no_score_are_refused(self):
        with self.assertRaises(semblante.SemblanteError):
            semblante.Speaker().say(b"\xf7", 0)

    def test_a_message_of_text_is_an_event_and_is_answered(self):
        with semblante.Stream(text=True, ping_interval=-1) as stream:
            stream.start(0)
            stream.opened(0)
            self.assertEqual(stream.take_bytes(), bytes([1, 1, 0, 0, 0, 0, 1]))
            header = bytes.fromhex("02010464656d6f10412064656d6f20e2809420636166c3a90673616d706c6580d095ffbc3129e80c0084e656febc78420000000000003940280000")
            stream.receive(header, 10)
            list(stream.events())
            stream.receive(bytes.fromhex("0b03e80c02656e05416d20706504") + self.SCORE, 20)
            event = stream.next_event()
            self.assertEqual(event.type, semblante.EventType.TEXT)
            self.assertEqual((event.sequence, event.media_time, event.duration), (3, 1640, 360))
            self.assertEqual(stream.text(event), ("Am pe", "en", self.SCORE))
            self.assertEqual(stream.word_times(event), [0, 180])
            stream.spoken(semblante.VoiceState.ENDED, 30, speech=3, character=5)
            self.assertEqual(stream.take_bytes()[:4], bytes([12, 1, 3, 5]))


class Heads(unittest.TestCase):
    def test_the_neutral_face_is_that_of_the_mesh(self):
        head = golden_head()
        self.assertEqual(head.positions().tolist(), head.neutral.tolist())
        self.assertGreater(head.vertex_count, 0)
        self.assertLess(max(max(row) for row in head.triangles.tolist()), head.vertex_count)

    def test_the_jaw_moves_its_point_by_the_unit_times_the_value(self):
        head = golden_head()
        head.set_frame(semblante.frame({3: 100}))
        self.assertAlmostEqual(head.pose.fp[1], -100 * head.fapu["MNS"], places=5)
        self.assertNotEqual(head.positions().tolist(), head.neutral.tolist())
        head.set_frame(semblante.frame())
        self.assertEqual(head.positions().tolist(), head.neutral.tolist())

    def test_colors_are_a_view_of_those_of_the_mesh(self):
        self.assertIsNone(golden_head().colors)
        head = golden_head("face_colored")
        colors = head.colors
        self.assertEqual(colors.tolist(), colors_of_places(head.neutral.tolist()))
        self.assertEqual(ctypes.addressof(ctypes.c_uint8.from_buffer(colors)), semblante.head.library.semblante_head_colors(head._handle))
        del head
        gc.collect()
        self.assertEqual(colors.tolist(), golden_head("face_colored").colors.tolist())

    def test_arrays_are_views_that_keep_their_head(self):
        neutral = golden_head().neutral  # the head itself is gone
        gc.collect()
        self.assertEqual(neutral.tolist(), golden_head().neutral.tolist())
        positions = golden_head().positions()
        gc.collect()
        self.assertEqual(positions.tolist(), neutral.tolist())

    def test_views_outlive_their_head_and_a_closed_head_says_that_it_is(self):
        head = golden_head("face_colored")
        frame = semblante.frame({3: 100})
        head.set_frame(frame)
        views = [head.neutral, head.triangles, head.colors]
        pose, copied = head.pose, copy.deepcopy(head.pose)
        contents = [view.tolist() for view in views], list(pose.fp)
        memory = weakref.ref(head._memory)
        head.close()
        head.close()
        others = [golden_head() for _ in range(20)]  # would take the memory
        self.assertEqual(([view.tolist() for view in views], list(pose.fp)), contents)
        for use in (lambda: head.triangles, lambda: head.neutral, lambda: head.pose, lambda: head.colors, head.positions, head.normals,
                    lambda: head.set_frame(frame), lambda: semblante.Player().show(head)):
            with self.assertRaisesRegex(ValueError, "this Head is closed"):
                use()
        points = pose.fp
        del views, pose, others
        gc.collect()
        self.assertIsNotNone(memory())
        del points
        gc.collect()
        self.assertIsNone(memory())
        self.assertEqual(list(copied.fp), contents[1])

    def test_arrays_are_numpys_where_it_is_installed(self):
        try:
            import numpy
        except ImportError:
            self.skipTest("numpy is not installed")
        head = golden_head()
        self.assertIsInstance(head.positions(), numpy.ndarray)
        self.assertFalse(head.positions().flags.owndata)
        self.assertIs(head.positions(), head.positions())

    def test_a_copy_is_refused_as_it_would_free_the_memory_again(self):
        for owner in (golden_head(), semblante.Player(), semblante.Stream()):
            for make in (copy.copy, copy.deepcopy, pickle.dumps):
                with self.assertRaisesRegex(TypeError, "cannot be copied"):
                    make(owner)

    def test_normals_have_length_one(self):
        head = golden_head()
        head.set_frame(semblante.frame({3: 200}))
        for x, y, z in head.normals().tolist():
            self.assertAlmostEqual(x * x + y * y + z * z, 1.0, places=4)

    def test_parts_that_do_not_belong_together_are_refused(self):
        parts = [(VECTORS / "face" / name).read_bytes() for name in ("mesh.drc", "weights", "rig.json")]
        broken = bytearray(parts[0])
        broken[-1] ^= 1
        with self.assertRaises(semblante.SemblanteError) as caught:
            semblante.Head(bytes(broken), *parts[1:])
        self.assertEqual(caught.exception.code, "mismatch")
        for i in range(3):
            with self.assertRaises(semblante.SemblanteError):
                semblante.Head(*parts[:i], b"", *parts[i + 1:])

    def test_frames_out_of_range_are_refused(self):
        for wrong in (lambda: semblante.frame({2: 1}), lambda: semblante.frame({69: 1}),
                      lambda: semblante.frame(expression=(1, 1.5)), lambda: semblante.frame(viseme=(1, 2, -0.1)),
                      lambda: semblante.frame(viseme=15), lambda: semblante.frame(viseme=(0, -1, 0.5)),
                      lambda: semblante.frame(viseme=257), lambda: semblante.frame(expression=(7, 1.0))):
            with self.assertRaises(ValueError):
                wrong()
        with self.assertRaises(semblante.SemblanteError):
            golden_head().set_frame(semblante.frame({3: float("nan")}))

    def test_frames_by_names_are_refused_in_words(self):
        for wrong, words in ((lambda: semblante.frame({"open_jaw": 1}), "FAP 'open_jaw' is not one of 3 to 68"),
                             (lambda: semblante.frame(viseme="aa"), "viseme 'aa' is neither"),
                             (lambda: semblante.frame(viseme=(1, 2)), "viseme (1, 2) is neither"),
                             (lambda: semblante.frame(expression="joy"), "expression 'joy' is neither"),
                             (lambda: semblante.frame(expression=("joy", 1.0)), "expression ('joy', 1.0) is neither"),
                             (lambda: semblante.frame(expression=1), "expression 1 is neither"),
                             (lambda: semblante.frame(expression=[]), "expression [] is neither"),
                             (lambda: semblante.frame(expression=[(1, 0.5)] * 3), "is neither")):
            with self.assertRaises(ValueError) as caught:
                wrong()
            self.assertIn(words, str(caught.exception))
        two = semblante.frame(expression=[(1, 0.5), (4, 1.0)])
        self.assertEqual((two.expression1, two.expression2, two.intensity2), (1, 4, 63))


class Documents(unittest.TestCase):
    def test_performances_give_the_golden_frames(self):
        for name in ("corners",):
            performance = semblante.Performance((VECTORS / f"performance/{name}.json").read_text())
            for golden in json.loads((VECTORS / f"performance/{name}.frames.json").read_text())["frames"]:
                expected = golden_frame(golden)
                frame = performance.frame_at(golden["time"], golden.get("idle_time", golden["time"]))
                for n in range(3, 69):
                    self.assertAlmostEqual(frame.fap[n], expected.fap[n], delta=0.01, msg=f"{name} {golden['time']} FAP {n}")
                self.assertEqual((frame.viseme1, frame.viseme_blend, frame.expression1, frame.intensity1),
                                 (expected.viseme1, expected.viseme_blend, expected.expression1, expected.intensity1))

    def test_documents_are_accepted_and_refused_as_everywhere(self):
        documents = json.loads((VECTORS / "performance/documents.json").read_text())
        for good in documents["good"]:
            if good.get("cues") or "idle" in good:
                semblante.Performance(json.dumps(good))
            else:  # a document, but nothing to play
                with self.assertRaisesRegex(semblante.SemblanteError, "no cues and no idle life"):
                    semblante.Performance(json.dumps(good))
        refused = documents["refused"]
        self.assertGreater(len(refused), 20)
        for bad in refused:
            with self.assertRaises(semblante.SemblanteError) as caught:
                semblante.Performance(json.dumps(bad["document"]))
            if bad["where"]:
                self.assertEqual(caught.exception.where, bad["where"])

    def test_a_take_written_is_read_again(self):
        frames = [semblante.TimedFrame(40.0 * i, semblante.frame({3: 10.0 * i, 48: 100.0 * i})) for i in range(25)]
        text = semblante.write_take(frames, rate=25)
        take = semblante.Take(text)
        self.assertEqual(take.frame_rate, 25)
        self.assertEqual([f.frame.fap[3] for f in take.frames], [10.0 * i for i in range(25)])
        with self.assertRaises(semblante.SemblanteError):
            semblante.Take("this is no FAP file")

    def test_bridges_read_names_and_numbers(self):
        frame = semblante.from_arkit({"jawOpen": 0.5})
        self.assertGreater(frame.fap[3], 0)
        self.assertAlmostEqual(semblante.to_arkit(frame)["jawOpen"], 0.5, places=3)
        self.assertEqual(semblante.from_oculus({"aa": 1.0}).viseme1, 10)
        self.assertAlmostEqual(sum(semblante.to_oculus(frame).values()), 1.0, places=5)
        with self.assertRaisesRegex(ValueError, "jawOpne"):
            semblante.from_arkit({"jawOpne": 1})
        with self.assertRaisesRegex(semblante.SemblanteError, "jawOpen"):
            semblante.from_arkit({"jawOpen": float("nan")})


class Streams(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = temporary_folder()
        folder = cls.folder.__enter__()
        subprocess.run([BUILD / "bin/semblante-sample-head", folder], check=True, stdout=subprocess.DEVNULL)
        cls.server = Server(folder / "data", "--sample", folder / "sample-head.glb", "--demo").__enter__()

    @classmethod
    def tearDownClass(cls):
        cls.server.__exit__()
        cls.folder.__exit__(None, None, None)

    def head(self):
        def fetched():
            try:
                return semblante.fetch_head(self.server.url, "sample")
            except OSError:  # the sample is being imported
                return None

        return eventually(fetched, "the sample head")

    def test_a_stream_is_followed_and_moves_the_face(self):
        head = self.head()
        times, faces = [], set()
        for player in semblante.follow(self.server.url, "demo", head=head, rate=50):
            times.append(player.time)
            faces.add(tuple(head.pose.fp))
            if len(faces) == 10:
                break
        self.assertEqual(times, sorted(times))
        self.assertNotEqual(head.positions().tolist(), head.neutral.tolist())

    def test_the_programs_of_the_readme_run_as_they_are_printed(self):
        self.head()
        text = (TOP / "clients/python/README.md").read_text().replace("http://127.0.0.1:8080", self.server.url)
        shows, publishes = re.findall(r"^```python\n(.*?)^```", text, re.DOTALL | re.MULTILINE)
        drawn = []

        def draw(vertices, triangles):
            drawn.append((len(vertices), len(triangles)))
            if len(drawn) == 5:
                raise KeyboardInterrupt

        names = {"draw": draw}
        with self.assertRaises(KeyboardInterrupt):
            exec(shows, names)
        self.assertEqual(drawn[4], (names["head"].vertex_count, len(names["head"].triangles.tolist())))
        self.assertEqual(get(f"{self.server.url}/v1/streams", data=b'{"name":"hello"}', headers={"content-type": "application/json"})[0], 201)
        exec(publishes, names)
        self.assertGreater(get_json(f"{self.server.url}/v1/streams/hello")["sequence"], 0)

    def test_an_address_that_is_none_of_a_server_is_said(self):
        for server in ("127.0.0.1:8080", "localhost", "ftp://faces.example", "http://", "http://faces.example:99999", ""):
            for call in (semblante.fetch_head, semblante.Connection):
                with self.assertRaisesRegex(ValueError, "is no address such as http://127.0.0.1:8080"):
                    call(server, "sample")

    def test_a_rate_of_pictures_that_is_none_is_refused(self):
        for rate in (0, -1, math.nan, math.inf):
            with self.assertRaisesRegex(ValueError, "rate"):
                next(semblante.follow(self.server.url, "demo", rate=rate))

    def test_a_model_that_is_not_there_is_an_error_with_the_servers_words(self):
        with self.assertRaisesRegex(urllib.error.HTTPError, "404: there is no model nobody"):
            semblante.fetch_head(self.server.url, "nobody")

    def test_what_is_published_arrives(self):
        request = json.dumps({"name": "python"}).encode()
        self.assertEqual(get(f"{self.server.url}/v1/streams", data=request, headers={"content-type": "application/json"})[0], 201)
        with semblante.Connection(self.server.url, "python") as reader, \
                semblante.Connection(self.server.url, "python", publish=True) as writer:
            eventually(lambda: [reader.poll(0.05), writer.poll(0.05)] and reader.stream.state == writer.stream.state ==
                       semblante.State.OPEN, "both connections")
            got = []

            def arrived():
                writer.stream.publish(semblante.frame({3: 200}), semblante.now())
                writer.poll()
                for event in reader.poll(0.05):
                    if event.type in (semblante.EventType.FRAMES, semblante.EventType.KEYFRAME):
                        got.extend(reader.stream.frames())
                return any(f.frame.fap[3] == 200 for f in got)

            eventually(arrived, "the published frame")

    def test_a_stream_that_does_not_exist_is_said(self):
        with self.assertRaises(semblante.WebSocketError) as caught:
            semblante.Connection(self.server.url, "no-such-stream").poll()
        self.assertEqual(caught.exception.status, 404)

    def test_a_server_that_was_never_there_is_said_and_may_come(self):
        with socket.socket() as taken:
            taken.bind(("127.0.0.1", 0))  # nobody listens on it
            nowhere = f"http://127.0.0.1:{taken.getsockname()[1]}"
            with semblante.Connection(nowhere, "demo") as connection:
                for _ in range(2):
                    with self.assertRaises(ConnectionRefusedError):
                        eventually(lambda: connection.poll(0.05) and None, "an error")
        with socket.socket() as silent:
            silent.bind(("127.0.0.1", 0))
            silent.listen()
            url = f"http://127.0.0.1:{silent.getsockname()[1]}"
            with self.assertRaises(socket.timeout):
                next(semblante.follow(url, "demo", connect_timeout=0.2))

    def test_a_server_of_another_name_is_said(self):
        with self.assertRaises(semblante.WebSocketError) as caught:
            semblante.Connection(self.server.url.replace("127.0.0.1", "127.1"), "demo").poll()
        self.assertEqual(caught.exception.status, 421)

    def test_the_examples_run(self):
        self.head()
        environment = {**os.environ, "PYTHONPATH": str(TOP / "clients/python")}
        examples = TOP / "clients/python/examples"
        shown = subprocess.run([sys.executable, "-B", examples / "follow.py", self.server.url, "demo", "sample", "5"],
                               env=environment, capture_output=True, text=True, timeout=60, check=True).stdout
        self.assertEqual(shown.count("jaw"), 5, shown)
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder, "face.obj")
            subprocess.run([sys.executable, "-B", examples / "hello_face.py", VECTORS / "face", out], env=environment,
                           timeout=60, check=True, capture_output=True)
            self.assertEqual(out.read_text().count("v "), golden_head().vertex_count)


class Sockets(unittest.TestCase):
    """What a server sends that is no WebSocket is refused in words."""

    def answer(self, text):
        import socket
        import threading
        listener = socket.create_server(("127.0.0.1", 0))

        def serve():
            connection, _ = listener.accept()
            request = connection.recv(65536).decode()
            key = next((line[19:] for line in request.split("\r\n") if line.startswith("Sec-WebSocket-Key: ")), "")
            import base64
            import hashlib
            accept = base64.b64encode(hashlib.sha1((key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11").encode()).digest()).decode()
            connection.sendall(text.replace(b"ACCEPT", accept.encode()))
            connection.close()
            listener.close()

        threading.Thread(target=serve, daemon=True).start()
        made = semblante.WebSocket(f"ws://127.0.0.1:{listener.getsockname()[1]}/", timeout=10)
        self.addCleanup(made.close)
        return made

    UPGRADE = b"HTTP/1.1 101 Switching\r\nSec-WebSocket-Accept: ACCEPT\r\n\r\n"

    def test_no_http(self):
        with self.assertRaises(semblante.WebSocketError):
            self.answer(b"hello\r\n\r\n")
        with self.assertRaisesRegex(semblante.WebSocketError, "does not speak HTTP"):
            self.answer("HTTP/1.1 10\u00b9 Switching\r\n\r\n".encode("latin-1"))

    def test_another_key(self):
        with self.assertRaisesRegex(semblante.WebSocketError, "another request"):
            self.answer(b"HTTP/1.1 101 Switching\r\nSec-WebSocket-Accept: abc\r\n\r\n")

    def test_frames_that_are_too_long_masked_or_reserved(self):
        for frame in (b"\x82\x7f\xff\xff\xff\xff\xff\xff\xff\xff", b"\x82\x81abcdx", b"\xf2\x01x", b"\x83\x01x", b"\x80\x01x"):
            with self.assertRaises(semblante.WebSocketError, msg=frame):
                self.answer(self.UPGRADE + frame).receive(10)

    def test_text_that_is_not_utf_8(self):
        with self.assertRaisesRegex(semblante.WebSocketError, "not UTF-8"):
            self.answer(self.UPGRADE + b"\x81\x01\xff").receive(10)

    def test_in_a_program_with_many_open_files(self):
        before = resource.getrlimit(resource.RLIMIT_NOFILE)
        many = 1100  # more than `select` can name
        if before[1] != resource.RLIM_INFINITY and before[1] < 2 * many:
            self.skipTest(f"a process may have no more than {before[1]} files open")
        self.addCleanup(resource.setrlimit, resource.RLIMIT_NOFILE, before)
        resource.setrlimit(resource.RLIMIT_NOFILE, (max(before[0], 2 * many), before[1]))
        for _ in range(many):
            self.addCleanup(os.close, os.open(os.devnull, os.O_RDONLY))
        with self.assertRaises(semblante.Closed):  # it waits, and hears of the end
            self.answer(self.UPGRADE).receive(10)

    def test_messages_in_parts_pings_and_the_end(self):
        frames = b"\x02\x01a\x89\x01p\x00\x01b\x80\x01c" + b"\x81\x02hi" + b"\x88\x05\x03\xe8bye"
        socket = self.answer(self.UPGRADE + frames)
        self.assertEqual(socket.receive(10), b"abc")
        self.assertEqual(socket.receive(10), "hi")
        with self.assertRaises(semblante.Closed) as caught:
            socket.receive(10)
        self.assertEqual((caught.exception.code, caught.exception.reason), (1000, "bye"))


if __name__ == "__main__":
    unittest.main(verbosity=2)

"""What the server tells systemd (Type=notify), and that a stop ends in time."""

import os
import pathlib
import re
import socket
import time
import unittest

import support
from support import clean_environment

UNIT = (support.TOP / "deploy/package/semblante.service.in").read_text()


class ServiceManager(unittest.TestCase):
    def check(self, address, name):
        with support.temporary_folder() as folder, socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as manager:
            manager.bind(address(folder))
            manager.settimeout(support.HANG)
            with support.Server(folder / "data", environment=clean_environment(NOTIFY_SOCKET=name(folder))) as server:
                self.assertEqual(manager.recv(1000), b"READY=1")
                self.assertEqual(support.get(server.url + "/healthz")[0], 200)
                self.assertEqual(server.stop(), 0)
                self.assertEqual(manager.recv(1000), b"STOPPING=1")

    def test_socket_of_a_path(self):
        self.check(lambda folder: str(folder / "notify"), lambda folder: folder / "notify")

    def test_abstract_socket(self):
        abstract = f"semblante-test-{os.getpid()}"
        self.check(lambda _: "\0" + abstract, lambda _: "@" + abstract)

    def test_a_socket_that_is_not_there_stops_nothing(self):
        for name in ("/nowhere/notify", "relative", "/" + 200 * "x"):
            with support.temporary_folder() as folder, support.Server(folder / "data", environment=clean_environment(NOTIFY_SOCKET=name)) as server:
                self.assertEqual(support.get(server.url + "/healthz")[0], 200)

    def test_systemd_waits_longer_than_the_server_drains(self):
        patience = int(re.search(r"^TimeoutStopSec=(\d+)$", UNIT, re.MULTILINE).group(1))
        printed = support.run(support.PROGRAM, "serve", "--print-config", environment=clean_environment())
        drain = int(re.search(r"^drain-seconds = (\d+)", printed.stdout, re.MULTILINE).group(1))
        self.assertGreater(patience, 2 * drain)

    def test_a_stop_beside_an_unfinished_request_ends_before_systemd_kills(self):
        patience = int(re.search(r"^TimeoutStopSec=(\d+)$", UNIT, re.MULTILINE).group(1))
        with support.temporary_folder() as folder, support.Server(folder / "data", "--demo") as server:
            with socket.create_connection(("127.0.0.1", server.port)) as upload, socket.create_connection(("127.0.0.1", server.port)) as stream:
                upload.sendall(b"POST /v1/models?filename=a.obj HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000000\r\n\r\nv 1 2 3")
                stream.sendall(b"GET /v1/streams/demo HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                               b"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n")
                self.assertIn(b" 101 ", stream.recv(100))
                begin = time.monotonic()
                self.assertEqual(server.stop(), 0)
                self.assertLess(time.monotonic() - begin, patience / 2)


support.main()

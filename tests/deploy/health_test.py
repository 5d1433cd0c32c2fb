"""`semblante health`: the health check of a container tells a ready server from all else."""

import socket
import threading
import unittest

import support
from support import PROGRAM, clean_environment, run


def health(port, *options, **environment):
    return run(PROGRAM, "health", "--port", port, *options, environment=clean_environment(**environment))


class Health(unittest.TestCase):
    def answered(self, answer):
        """The outcome where something answers these bytes and closes."""
        with socket.create_server(("127.0.0.1", 0)) as listener:
            def serve():
                connection, _ = listener.accept()
                with connection:
                    connection.recv(1000)
                    for byte in answer:
                        connection.sendall(bytes([byte]))
            thread = threading.Thread(target=serve)
            thread.start()
            outcome = health(listener.getsockname()[1])
            thread.join()
        return outcome.returncode, outcome.stderr

    def test_a_running_server(self):
        with support.temporary_folder() as folder, support.Server(folder / "data") as server:
            self.assertEqual((health(server.port).returncode, health(server.port).stdout), (0, "ready\n"))
            self.assertEqual(health(server.port, "--path", "/healthz").stdout, "alive\n")
            self.assertEqual(run(PROGRAM, "health", environment=clean_environment(SEMBLANTE_PORT=server.port)).returncode, 0)
            server.stop()
            self.assertEqual(health(server.port).returncode, 1)

    def test_other_answers(self):
        self.assertEqual(self.answered(b"HTTP/1.1 200 OK\r\nContent-Length: 0\r\n\r\n")[0], 0)
        self.assertEqual(self.answered(b"HTTP/1.1 503 Service Unavailable\r\nContent-Length: 0\r\n\r\n"),
                         (1, "semblante: health: the server answers 503 Service Unavailable\n"))
        self.assertEqual(self.answered(b"HTTP/1.1 200 OK\r\n")[0], 1)
        self.assertEqual(self.answered(b"HTTP/1.1 200")[0], 1)
        self.assertEqual(self.answered(b"\x16\x03\x01\r\n")[0], 1)
        self.assertEqual(self.answered(b"")[0], 1)

    def test_silence(self):
        with socket.create_server(("127.0.0.1", 0)) as silent:
            self.assertEqual(health(silent.getsockname()[1], "--timeout", "1").returncode, 1)

    def test_faulty_options(self):
        self.assertEqual(health(1, "--address", "localhost").returncode, 2)
        self.assertEqual(health(1, "--path", "/metrics").returncode, 2)
        self.assertEqual(health(70000).returncode, 2)


support.main()

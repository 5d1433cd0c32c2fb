"""The examples of deploy/proxy run: REST, uploads, events and WebSockets pass through Debian's nginx and Caddy with TLS, and the
server knows the addresses of the proxy's clients.

Only ports, the paths of the certificate and (Caddy) where it comes from differ from the files in the tree."""

import base64
import json
import os
import re
import socket
import ssl
import struct
import subprocess
import unittest

import support
from support import TOP

NAME = "faces.example"
PROXY = TOP / "deploy/proxy"


def free_ports(count):
    """Ports that are free now. Another process may take one before it is used; the proxies then end with a message."""
    listeners = [socket.create_server(("127.0.0.1", 0)) for _ in range(count)]
    ports = [listener.getsockname()[1] for listener in listeners]
    for listener in listeners:
        listener.close()
    return ports


def replaced(text, old, new):
    assert text.count(old) == 1, f"{text.count(old)} times in the example: {old}"
    return text.replace(old, new)


class Connection:
    """A TLS connection to the proxy by the name of the site. HTTP is written by hand, to see what really passes."""

    def __init__(self, port, certificate, token=None, address="127.0.0.1"):
        context = ssl.create_default_context(cafile=certificate)
        context.minimum_version = ssl.TLSVersion.TLSv1_2
        plain = socket.create_connection(("127.0.0.1", port), timeout=support.HANG, source_address=(address, 0))
        self.token = token
        self.socket = context.wrap_socket(plain, server_hostname=NAME)
        self.file = self.socket.makefile("rb")
        self.host = f"{NAME}:{port}"

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.file.close()
        self.socket.close()

    def send(self, method, path, body=b"", **headers):
        lines = {"Host": self.host, **({"Content-Length": len(body)} if body else {}),
                 **({"Authorization": f"Bearer {self.token}"} if self.token else {}), **{k.replace("_", "-"): v for k, v in headers.items()}}
        head = f"{method} {path} HTTP/1.1\r\n" + "".join(f"{name}: {value}\r\n" for name, value in lines.items()) + "\r\n"
        self.socket.sendall(head.encode() + body)

    def head(self):
        status = int(self.file.readline().split()[1])
        headers = {}
        while (line := self.file.readline().strip()):
            name, value = line.decode().split(":", 1)
            headers[name.lower()] = value.strip()
        return status, headers

    def chunks(self):
        while (size := int(self.file.readline(), 16)):
            yield self.file.read(size)
            self.file.readline()
        self.file.readline()

    def request(self, method, path, body=b"", **headers):
        self.send(method, path, body, **headers)
        status, fields = self.head()
        length = fields.get("content-length")
        content = b"".join(self.chunks()) if fields.get("transfer-encoding") == "chunked" else self.file.read(int(length or 0))
        return status, fields, content

    def frame(self, text):
        """Sends a text message of at most 125 bytes (RFC 6455)."""
        mask = os.urandom(4)
        data = bytes(byte ^ mask[i % 4] for i, byte in enumerate(text.encode()))
        self.socket.sendall(bytes([0x81, 0x80 | len(data)]) + mask + data)

    def message(self):
        opcode, length = self.file.read(2)
        if length == 126:
            length, = struct.unpack(">H", self.file.read(2))
        elif length == 127:
            length, = struct.unpack(">Q", self.file.read(8))
        return opcode & 15, self.file.read(length)


class Proxies(unittest.TestCase):
    def setUp(self):
        support.need("openssl")
        folder = support.temporary_folder()
        self.folder = folder.__enter__()
        self.addCleanup(folder.__exit__, None, None, None)
        self.certificate, self.key = self.folder / "fullchain.pem", self.folder / "privkey.pem"
        made = support.run("openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-subj", f"/CN={NAME}",
                           "-addext", f"subjectAltName=DNS:{NAME}", "-days", "2", "-keyout", self.key, "-out", self.certificate)
        self.assertEqual(made.returncode, 0, made.stderr)
        self.http, self.https = free_ports(2)

    def serve(self):
        (self.folder / "data").mkdir()
        made = support.run(support.PROGRAM, "token", "create", "--data", self.folder / "data", "--scope", "admin")
        self.assertEqual(made.returncode, 0, made.stderr)
        self.token = made.stdout.split()[0]
        return support.Server(self.folder / "data", "--demo", "--allow-host", NAME, "--allow-origin", f"https://{NAME}:{self.https}",
                              "--trusted-proxy", "127.0.0.1", "--client-failures", 3)

    def connect(self, **options):
        return Connection(self.https, self.certificate, **{"token": self.token, **options})

    def run_proxy(self, *command):
        log = open(self.folder / "proxy.log", "w+", encoding="utf-8")
        self.addCleanup(log.close)
        process = subprocess.Popen([str(part) for part in command], stdout=log, stderr=log,
                                   env=support.clean_environment(HOME=self.folder, XDG_DATA_HOME=self.folder, XDG_CONFIG_HOME=self.folder))

        def stop():
            process.terminate()
            process.wait(support.HANG)
        self.addCleanup(stop)

        def listens():
            log.seek(0)
            self.assertIsNone(process.poll(), log.read())
            try:
                with self.connect():
                    return True
            except OSError:
                return False
        support.eventually(listens, "the proxy")

    def test_nginx(self):
        support.need("nginx")
        with self.serve() as server:
            text = (PROXY / "nginx.conf").read_text()
            text = replaced(text, "server 127.0.0.1:8080;", f"server 127.0.0.1:{server.port};")
            text = replaced(text, "listen 80;", f"listen 127.0.0.1:{self.http};")
            text = replaced(text, "listen 443 ssl http2;", f"listen 127.0.0.1:{self.https} ssl http2;")
            text = replaced(text, "/etc/ssl/faces.example/fullchain.pem", str(self.certificate))
            text = replaced(text, "/etc/ssl/faces.example/privkey.pem", str(self.key))
            temporary = "".join(f"{kind}_temp_path {self.folder}/{kind};" for kind in ("client_body", "proxy", "fastcgi", "uwsgi", "scgi"))
            config = self.folder / "nginx.conf"
            config.write_text(f"daemon off; pid {self.folder}/pid; error_log stderr; worker_processes 1;\n"
                              + (f"user root;\n" if os.geteuid() == 0 else "") +
                              f"events {{}} http {{ access_log off; {temporary}\n{text}}}\n")
            self.run_proxy(support.find_program("nginx"), "-e", "stderr", "-p", self.folder, "-c", config)
            self.check_site(server)

    def test_caddy(self):
        support.need("caddy")
        with self.serve() as server:
            text = (PROXY / "Caddyfile").read_text()
            text = replaced(text, "127.0.0.1:8080", f"127.0.0.1:{server.port}")
            text = replaced(text, "\n{$SEMBLANTE_SITE:faces.example} {\n", f"\n{{$SEMBLANTE_SITE:faces.example}} {{\n\tbind 127.0.0.1\n\ttls {self.certificate} {self.key}\n")
            config = self.folder / "Caddyfile"
            config.write_text(f"{{\n\tadmin off\n\thttp_port {self.http}\n\thttps_port {self.https}\n}}\n" + text)
            self.run_proxy(support.find_program("caddy"), "run", "--adapter", "caddyfile", "--config", config)
            self.check_site(server)

    def check_site(self, server):
        self.check_redirect()
        with self.connect() as connection:
            status, headers, body = connection.request("GET", "/healthz")
            self.assertEqual(status, 200, body)
            self.assertIn("max-age=", headers["strict-transport-security"])
            self.assertEqual(connection.request("GET", "/metrics")[0], 404)
            # Requests on one connection, a change with the page's origin, and one with a foreign one.
            status, _, body = connection.request("POST", "/v1/streams", b'{"name":"hello"}', Content_Type="application/json",
                                                 Origin=f"https://{NAME}:{self.https}")
            self.assertEqual(status, 201, body)
            status, _, body = connection.request("POST", "/v1/streams", b'{"name":"other"}', Content_Type="application/json",
                                                 Origin="https://evil.example")
            self.assertEqual(status, 403, body)
        self.check_upload_and_events()
        self.check_websocket()
        self.check_addresses()
        # The server was reached through the proxy only: its own address answers to its own names only.
        self.assertEqual(support.get(server.url + "/healthz", headers={"Host": "evil.example"})[0], 421)

    def check_redirect(self):
        with socket.create_connection(("127.0.0.1", self.http), timeout=support.HANG) as plain:
            plain.sendall(f"GET /v1/models?a=b HTTP/1.1\r\nHost: {NAME}\r\nConnection: close\r\n\r\n".encode())
            answer = plain.makefile("rb").read().decode()
        self.assertRegex(answer, r"^HTTP/1.1 308 ")
        self.assertRegex(answer, rf"(?i)\r\nLocation: https://{re.escape(NAME)}(:{self.https})?/v1/models\?a=b\r\n")

    def check_upload_and_events(self):
        # Larger than what proxies take by default and hold in memory.
        model = (TOP / "tests/deploy/tetrahedron.obj").read_bytes() + b"# filling\n" * 400_000
        with self.connect() as connection:
            status, _, body = connection.request("POST", "/v1/models?filename=a.obj", model, Content_Type="model/obj")
            self.assertEqual(status, 202, body)
            job = json.loads(body)["job"]["id"]
            connection.send("GET", f"/v1/jobs/{job}/events")
            status, headers = connection.head()
            self.assertEqual((status, headers["content-type"].split(";")[0]), (200, "text/event-stream"))
            text = b"".join(connection.chunks()).decode()
        events = [json.loads(line[len("data: "):]) for line in text.splitlines() if line.startswith("data: ")]
        self.assertIn(events[-1]["state"], ("done", "failed"), text)

    def check_websocket(self):
        with self.connect() as connection:
            key = base64.b64encode(os.urandom(16)).decode()
            connection.send("GET", "/v1/streams/demo", Upgrade="websocket", Connection="Upgrade", Origin=f"https://{NAME}:{self.https}",
                            Sec_WebSocket_Version=13, Sec_WebSocket_Key=key, Sec_WebSocket_Protocol="semblante.v1.json")
            status, headers = connection.head()
            self.assertEqual((status, headers.get("sec-websocket-protocol")), (101, "semblante.v1.json"))
            connection.frame('{"type":"hello","version":1,"role":"subscribe"}')
            kinds = []
            while kinds.count("frames") < 3:
                opcode, data = connection.message()
                self.assertEqual(opcode, 1, data)
                kinds.append(json.loads(data)["type"])
                self.assertLess(len(kinds), 100, kinds)
            self.assertEqual(kinds[0], "header")


    def check_addresses(self):
        """Tokens that are not accepted count for the client, not for the proxy, whatever the client says that it is."""
        def refusal(address, **headers):
            with self.connect(token="sem_wrong", address=address) as connection:
                return connection.request("GET", "/v1/models", **headers)[0]

        for number in range(20):
            status = refusal("127.0.0.2", X_Forwarded_For=f"192.0.2.{number}", Forwarded=f"for=192.0.2.{number}", X_Real_IP=f"192.0.2.{number}")
            if status != 401:
                break
        self.assertEqual(status, 429)
        self.assertEqual(refusal("127.0.0.3"), 401)
        with self.connect() as connection:
            self.assertEqual(connection.request("GET", "/v1/models")[0], 200)
        with self.connect(token=None) as connection:
            self.assertEqual(connection.request("GET", "/v1/models")[0], 401)
        # The scheme that the client used: only with TLS may a token stay in a cookie.
        with self.connect() as connection:
            status, headers, body = connection.request("POST", "/v1/session", json.dumps({"token": self.token}).encode(), Content_Type="application/json",
                                                       Origin=f"https://{NAME}:{self.https}")
            self.assertLess(status, 300, body)
            self.assertIn("; Secure", headers["set-cookie"])


support.main()

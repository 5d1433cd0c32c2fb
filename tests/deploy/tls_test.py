"""A server with TLS and tokens: the programs speak to it, and trust only what they should; a renewed certificate is used."""

import json
import signal
import socket
import ssl
import subprocess
import unittest

import support
from support import BUILD, PROGRAM, clean_environment, run

CLIENT = BUILD / "bin/semblante-client"
VMC = BUILD / "bin/semblante-vmc"
LIVELINK = BUILD / "bin/semblante-livelink"


class Tls(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        support.need("openssl")
        cls.context = support.temporary_folder()
        cls.folder = cls.context.__enter__()
        cls.certify("127.0.0.1", "localhost")
        (cls.folder / "data").mkdir()
        cls.token = cls.make_token("edit")
        cls.server = support.Server(cls.folder / "data", "--demo", "--listen", "127.0.0.1:0", "--tls-cert", cls.folder / "cert.pem", "--tls-key",
                                    cls.folder / "key.pem", "--require-tokens")

    @classmethod
    def tearDownClass(cls):
        cls.server.stop()
        cls.context.__exit__(None, None, None)

    @classmethod
    def certify(cls, *names):
        """A certificate for these names, signed by an authority of its own in ca.pem."""
        folder = cls.folder
        kinds = ("IP:" if name[0].isdigit() else "DNS:" for name in names)
        (folder / "names").write_text("subjectAltName=" + ",".join(kind + name for kind, name in zip(kinds, names)))
        new = ("-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes")
        steps = []
        if not (folder / "ca.pem").exists():
            steps.append(("req", "-x509", *new, "-subj", "/CN=An authority", "-days", "10", "-keyout", "ca.key", "-out", "ca.pem"))
        steps.append(("req", *new, "-subj", "/CN=x", "-keyout", "new.key", "-out", "request"))
        steps.append(("x509", "-req", "-in", "request", "-CA", "ca.pem", "-CAkey", "ca.key", "-days", "10", "-extfile", "names", "-out", "new.pem"))
        for step in steps:
            made = run("openssl", *step, cwd=folder)
            assert made.returncode == 0, made.stderr
        (folder / "new.key").rename(folder / "key.pem")
        (folder / "new.pem").rename(folder / "cert.pem")

    @classmethod
    def make_token(cls, scope):
        made = run(PROGRAM, "token", "create", "--data", cls.folder / "data", "--scope", scope)
        assert made.returncode == 0, made.stderr
        return made.stdout.split()[0]

    @property
    def trusted(self):
        return ("--ca", self.folder / "ca.pem")

    def test_health(self):
        def health(*options):
            return run(PROGRAM, "health", "--server", self.server.url, *options)
        self.assertEqual(health(*self.trusted).stdout, "ready\n")
        self.assertEqual(health("--insecure").stdout, "ready\n")
        unknown = health()
        self.assertEqual(unknown.returncode, 1)
        self.assertIn("the certificate is not trusted: unable to get local issuer certificate", unknown.stderr)
        self.assertIn("--ca", unknown.stderr)
        self.assertEqual(health("--ca", self.folder / "nowhere.pem").returncode, 1)
        plain = run(PROGRAM, "health", "--server", self.server.url.replace("https", "http"))
        self.assertEqual(plain.returncode, 1)

    def test_name_of_another_host(self):
        """127.0.0.2 is this server too, and not what its certificate is for."""
        wrong = run(PROGRAM, "health", "--server", f"https://127.0.0.2:{self.server.port}", *self.trusted)
        self.assertEqual(wrong.returncode, 1)

    def test_play(self):
        frames = self.folder / "frames.json"
        frames.write_text('{"frames":[{"faps":{"3":100}},{"t":200,"faps":{"3":0}}]}')
        def play(*options, **environment):
            return run(PROGRAM, "play", frames, "--server", self.server.url, "--stream", "played", "--create", "--quiet", *options,
                       environment=clean_environment(**environment))
        played = play(*self.trusted, "--token", self.token)
        self.assertEqual(played.returncode, 0, played.stderr)
        variables = play(SEMBLANTE_TOKEN=self.token, SEMBLANTE_CA=self.folder / "ca.pem")
        self.assertEqual(variables.returncode, 0, variables.stderr)
        self.assertIn("needs a token", play(*self.trusted).stderr)
        self.assertIn("not trusted", play("--token", self.token).stderr)
        self.assertIn("the scope edit", play(*self.trusted, "--token", self.make_and_wait("read")).stderr)

    def make_and_wait(self, scope):
        token = self.make_token(scope)
        context = ssl.create_default_context(cafile=self.folder / "ca.pem")
        support.eventually(lambda: support.get(self.server.url + "/v1/streams", headers={"Authorization": "Bearer " + token}, context=context)[0] == 200,
                           "the new token")
        return token

    def test_native_client(self):
        taken = self.folder / "taken.json"
        client = run(CLIENT, self.server.url, "--stream", "demo", "--record", taken, "--frames", "5", *self.trusted, "--token", self.token)
        self.assertEqual(client.returncode, 0, client.stderr)
        self.assertEqual(len(json.loads(taken.read_text())["frames"]), 5)
        unknown = run(CLIENT, self.server.url, "--stream", "private", "--record", taken, *self.trusted, "--token", "smb_aaaaaaaaaaaa_" + 43 * "a")
        self.assertNotEqual(unknown.returncode, 0)
        self.assertIn("does not accept the token", unknown.stderr)
        self.assertIn("not trusted", run(CLIENT, self.server.url, "--record", taken, "--token", self.token).stderr)

    def test_vmc_out(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as marionette:
            marionette.bind(("127.0.0.1", 0))
            marionette.settimeout(support.HANG)
            with subprocess.Popen([VMC, "out", "--server", self.server.url, "--stream", "demo", "--to", f"127.0.0.1:{marionette.getsockname()[1]}",
                                   "--ca", self.folder / "ca.pem"], env=clean_environment(SEMBLANTE_TOKEN=self.token), stdout=subprocess.DEVNULL) as gateway:
                self.assertIn(b"/VMC/", marionette.recv(65536))
                gateway.send_signal(signal.SIGINT)
                self.assertEqual(gateway.wait(support.HANG), 0)

    def test_livelink(self):
        command = [LIVELINK, "--server", self.server.url, "--stream", "phone", "--create", "--listen", "127.0.0.1:0", *self.trusted]
        with subprocess.Popen(command + ["--token", self.token], env=clean_environment(), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as gateway:
            self.assertIn("publishing to phone", gateway.stderr.readline())
            gateway.send_signal(signal.SIGINT)
            self.assertEqual(gateway.wait(support.HANG), 0)
        refused = run(*command, "--token", "smb_aaaaaaaaaaaa_" + 43 * "a")
        self.assertNotEqual(refused.returncode, 0)
        self.assertIn("does not accept the token", refused.stderr)

    def test_lan_tells_by_what_urls_phones_reach_it(self):
        with support.temporary_folder() as folder:
            try:
                server = support.Server(folder / "data", "--lan")
            except AssertionError as fault:
                if "this machine has no address in a network" in str(fault):
                    self.skipTest("this machine is in no network")
                raise
            with server:
                token = next(line for line in server.process.stdout if "#token=" in line).strip().rsplit("=", 1)[1]
                context = ssl._create_unverified_context()
                def session(host, **headers):
                    return json.loads(support.get(f"https://{host}:{server.port}/v1/session", headers=headers, context=context)[2])
                urls = session("127.0.0.1", Authorization=f"Bearer {token}")["network_urls"]
                self.assertTrue(urls)
                for url in urls:
                    self.assertRegex(url, rf"^https://\S+:{server.port}$")
                    self.assertNotRegex(url, r"//(localhost|127\.|0\.0\.0\.0)")
                    self.assertEqual(support.get(url + "/healthz", context=context)[0], 200, url)
                self.assertEqual(session("127.0.0.1")["network_urls"], [], "only for whoever may enter")
        local = json.loads(support.get(self.server.url + "/v1/session", headers={"Authorization": f"Bearer {self.token}"},
                                       context=ssl.create_default_context(cafile=self.folder / "ca.pem"))[2])
        self.assertEqual(local["network_urls"], [], "it listens to its own machine only")

    def test_z_renewed_certificate_with_another_name(self):
        context = ssl.create_default_context(cafile=self.folder / "ca.pem")
        def status(host):
            return support.get(self.server.url + "/healthz", headers={"Host": host}, context=context)[0]
        self.assertEqual(status("new.example"), 421)
        self.certify("127.0.0.1", "new.example")
        self.server.process.send_signal(signal.SIGHUP)
        support.eventually(lambda: status("new.example") == 200, "the names of the new certificate")
        self.assertEqual(status("other.example"), 421)


support.main()
